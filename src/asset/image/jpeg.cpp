// Decoding and encoding of JPEG files with libjpeg-turbo.
//
// libjpeg calls error_exit() for an error, which must not return: fail_jpeg() jumps over the frames of its
// callers. Functions that call setjmp() therefore have no object with a destructor, and none is created between
// them and libjpeg.

#include "asset/image/codecs.hpp"

#include <array>
#include <csetjmp>
#include <cstddef>
#include <cstdio>  // jpeglib.h needs it
#include <cstdlib>
#include <new>
#include <string>

#include <jpeglib.h>

#include <jerror.h>

#include "asset/image/image_size.hpp"
#include "faqem/error.hpp"

namespace faqem::detail {
namespace {

/// From this quality on, the chroma of colours has the full resolution: then more bytes for chroma reduce the
/// error more than a higher quality with half the resolution (docs/libraries.md).
constexpr std::uint32_t full_chroma_quality = 90;

/// How libjpeg reports errors; `base` is first, so that a pointer to it is one to this structure.
struct JpegErrors {
    jpeg_error_mgr base;
    std::jmp_buf jump;
    std::array<char, JMSG_LENGTH_MAX> message;
};

[[noreturn]] void fail_jpeg(j_common_ptr state) {
    auto* const errors = reinterpret_cast<JpegErrors*>(state->err);
    state->err->format_message(state, errors->message.data());
    std::longjmp(errors->jump, 1);
}

/// A message at a negative level is a warning of damage, after which libjpeg would invent pixels.
void check_jpeg_message(j_common_ptr state, int level) {
    if (level < 0) fail_jpeg(state);
}

/// The message of an error.
/// \throws std::bad_alloc  if memory is exhausted
std::string jpeg_error(const JpegErrors& errors) {
    if (errors.base.msg_code == JERR_OUT_OF_MEMORY) throw std::bad_alloc();
    return errors.message.data();
}

/// A decoder or encoder of libjpeg.
template <class State>
struct JpegCodec {
    JpegCodec() {
        jpeg_std_error(&errors.base);
        errors.base.error_exit = fail_jpeg;
        errors.base.emit_message = check_jpeg_message;
        state.err = &errors.base;
    }
    ~JpegCodec() { jpeg_destroy(reinterpret_cast<j_common_ptr>(&state)); }
    JpegCodec(const JpegCodec&) = delete;
    JpegCodec& operator=(const JpegCodec&) = delete;

    State state = {};
    JpegErrors errors = {};
};

/// Reads the segments before the pixels. Returns false on errors.
bool read_jpeg_header(jpeg_decompress_struct& state, JpegErrors& errors, const std::uint8_t* bytes,
                      std::size_t size) {
    if (setjmp(errors.jump)) return false;
    jpeg_create_decompress(&state);
    jpeg_mem_src(&state, bytes, static_cast<unsigned long>(size));
    jpeg_read_header(&state, TRUE);
    state.out_color_space = state.num_components == 4 ? JCS_CMYK : JCS_EXT_RGBA;
    return true;
}

/// Reads all rows, with four bytes per pixel. Returns false on errors.
bool read_jpeg_rows(jpeg_decompress_struct& state, JpegErrors& errors, std::uint8_t* pixels) {
    if (setjmp(errors.jump)) return false;
    jpeg_start_decompress(&state);
    while (state.output_scanline < state.output_height) {
        JSAMPROW row = pixels + std::size_t{4} * state.output_width * state.output_scanline;
        jpeg_read_scanlines(&state, &row, 1);
    }
    return true;  // what follows the pixels is not read
}

/// Converts inverted CMYK to RGBA in place, without a colour profile.
void cmyk_to_rgba(Pixels& pixels) {
    for (std::size_t i = 0; i < pixels.rgba.size(); i += 4) {
        std::uint8_t* const p = &pixels.rgba[i];
        const int black = p[3];
        for (int c = 0; c < 3; ++c) p[c] = static_cast<std::uint8_t>((p[c] * black + 127) / 255);
        p[3] = 255;
    }
}

struct JpegEncoder : JpegCodec<jpeg_compress_struct> {
    ~JpegEncoder() { std::free(output.bytes); }

    /// The bytes written so far, from malloc(); `base` is first, as above. libjpeg's own output to memory loses
    /// its buffer if it fails.
    struct Output {
        jpeg_destination_mgr base;
        std::uint8_t* bytes;
        std::size_t capacity;
    };
    Output output = {};
};

/// Doubles the buffer, all of which has been written.
boolean grow_jpeg_output(j_compress_ptr state) {
    auto* const output = reinterpret_cast<JpegEncoder::Output*>(state->dest);
    const std::size_t used = output->capacity, larger = used ? 2 * used : std::size_t{1} << 16;
    void* const bytes = std::realloc(output->bytes, larger);
    if (!bytes) ERREXIT1(state, JERR_OUT_OF_MEMORY, 0);
    output->bytes = static_cast<std::uint8_t*>(bytes);
    output->capacity = larger;
    output->base.next_output_byte = output->bytes + used;
    output->base.free_in_buffer = larger - used;
    return TRUE;
}

/// Sets the coding of an encoder whose defaults have been set. It calls libjpeg, so it has no objects with destructors.
struct JpegCoding {
    int quality;  ///< of the usual tables; 0: the next one instead
    JpegRounding rounding;
};

void set_jpeg_coding(jpeg_compress_struct& state, const JpegCoding& coding) {
    const int chroma_step = coding.rounding.chroma == Chroma::half ? 2 : 1;
    state.comp_info[0].h_samp_factor = state.comp_info[0].v_samp_factor = chroma_step;
    state.optimize_coding = TRUE;
    if (coding.quality > 0) return jpeg_set_quality(&state, coding.quality, TRUE);
    unsigned steps[DCTSIZE2];
    for (unsigned i = 0; i < DCTSIZE2; ++i)
        steps[i] = (coding.rounding.step * (10 + i / DCTSIZE + i % DCTSIZE) + 5) / 10;
    for (int table = 0; table < 2; ++table) jpeg_add_quant_table(&state, table, steps, 100, TRUE);
}

/// Writes the whole file. Returns false on errors.
bool write_jpeg_file(JpegEncoder& encoder, const Pixels& pixels, const JpegCoding& coding) {
    jpeg_compress_struct& state = encoder.state;
    if (setjmp(encoder.errors.jump)) return false;
    jpeg_create_compress(&state);
    encoder.output.base.init_destination = [](j_compress_ptr own) { grow_jpeg_output(own); };
    encoder.output.base.empty_output_buffer = grow_jpeg_output;
    encoder.output.base.term_destination = [](j_compress_ptr) {};
    state.dest = &encoder.output.base;
    state.image_width = pixels.width;
    state.image_height = pixels.height;
    state.input_components = 4;
    state.in_color_space = JCS_EXT_RGBX;
    jpeg_set_defaults(&state);
    set_jpeg_coding(state, coding);
    jpeg_start_compress(&state, TRUE);
    while (state.next_scanline < state.image_height) {
        const std::uint8_t* const row = &pixels.rgba[std::size_t{4} * pixels.width * state.next_scanline];
        JSAMPROW rows = const_cast<JSAMPROW>(row);  // libjpeg does not write to it
        jpeg_write_scanlines(&state, &rows, 1);
    }
    jpeg_finish_compress(&state);
    return true;
}

Image coded_jpeg(const Pixels& pixels, const std::string& name, const JpegCoding& coding) {
    JpegEncoder encoder;
    if (!write_jpeg_file(encoder, pixels, coding))
        throw WriteError("image '" + name + "': cannot encode: " + jpeg_error(encoder.errors));
    const std::size_t size = encoder.output.capacity - encoder.output.base.free_in_buffer;
    return {name, "image/jpeg", {encoder.output.bytes, encoder.output.bytes + size}, {}};
}

}  // namespace

Pixels read_jpeg(const Image& image) {
    JpegCodec<jpeg_decompress_struct> decoder;
    const auto fail = [&] { fail_image(image, "is damaged: " + jpeg_error(decoder.errors)); };
    if (!read_jpeg_header(decoder.state, decoder.errors, image.encoded.data(), image.encoded.size())) fail();
    Pixels pixels = pixels_for(image, {decoder.state.image_width, decoder.state.image_height});
    if (!read_jpeg_rows(decoder.state, decoder.errors, pixels.rgba.data())) fail();
    if (decoder.state.out_color_space == JCS_CMYK) cmyk_to_rgba(pixels);
    return pixels;
}

Image write_jpeg(const Pixels& pixels, const std::string& name, const JpegRounding& rounding) {
    return coded_jpeg(pixels, name, {.quality = 0, .rounding = rounding});
}

}  // namespace faqem::detail

faqem::Image faqem::encode_jpeg(const Pixels& pixels, const std::string& name, std::uint32_t quality,
                                Content content) {
    detail::check_pixel_count(pixels, name);
    const bool halves = content == Content::color && quality < detail::full_chroma_quality;
    return detail::coded_jpeg(pixels, name,
                              {.quality = static_cast<int>(quality),
                               .rounding = {.chroma = halves ? detail::Chroma::half : detail::Chroma::full}});
}

// Decoding of PNG files with libpng.
//
// libpng reports an error by a jump over the frames of its callers. Functions that call setjmp() therefore have
// no object with a destructor, and none is created between them and libpng.

#include "asset/image/codecs.hpp"

#include <png.h>

#include <array>
#include <csetjmp>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <new>
#include <string>
#include <string_view>

#include "asset/image/image_size.hpp"

namespace faqem::detail {
namespace {

/// The bytes that libpng has not read yet, and the message of its error.
struct PngSource {
    const std::uint8_t* next;
    std::size_t left;
    std::array<char, 128> error;
};

void read_png_bytes(png_structp png, png_bytep to, png_size_t size) {
    auto* const source = static_cast<PngSource*>(png_get_io_ptr(png));
    if (size > source->left) png_error(png, "it is cut short");
    std::memcpy(to, source->next, size);
    source->next += size;
    source->left -= size;
}

[[noreturn]] void keep_png_error(png_structp png, png_const_charp message) {
    auto* const source = static_cast<PngSource*>(png_get_error_ptr(png));
    std::snprintf(source->error.data(), source->error.size(), "%s", message);
    png_longjmp(png, 1);
}

/// libpng drops transparency with a wrong checksum and warns; other warnings are about metadata.
void check_png_warning(png_structp png, png_const_charp message) {
    if (std::string_view(message).starts_with("tRNS: CRC")) png_error(png, message);
}

/// The state of libpng; a null pointer in it means that memory is exhausted.
struct PngDecoder {
    explicit PngDecoder(PngSource& source)
        : png(png_create_read_struct(PNG_LIBPNG_VER_STRING, &source, keep_png_error, check_png_warning)),
          info(png ? png_create_info_struct(png) : nullptr) {}
    ~PngDecoder() { png_destroy_read_struct(&png, &info, nullptr); }
    PngDecoder(const PngDecoder&) = delete;
    PngDecoder& operator=(const PngDecoder&) = delete;

    png_structp png;
    png_infop info;
};

/// Reads the chunks before the pixels. Returns false on errors.
bool read_png_header(png_structp png, png_infop info, PngSource* source) {
    if (setjmp(png_jmpbuf(png))) return false;
    png_set_read_fn(png, source, read_png_bytes);
    // All chunks but those that define the pixels: libpng would expand a compressed text to up to 8 MB, and
    // reject an image with longer ones.
    png_set_keep_unknown_chunks(png, PNG_HANDLE_CHUNK_NEVER, nullptr, -1);
    png_set_chunk_malloc_max(png, 0);
    png_read_info(png, info);
    return true;
}

/// Reads all rows as RGBA with 8 bits per channel. Returns false on errors.
bool read_png_rows(png_structp png, png_infop info, std::uint8_t* rgba) {
    if (setjmp(png_jmpbuf(png))) return false;
    const std::size_t row_bytes = std::size_t{4} * png_get_image_width(png, info);
    const png_uint_32 rows = png_get_image_height(png, info);
    png_set_expand(png);
    png_set_scale_16(png);
    png_set_gray_to_rgb(png);
    png_set_add_alpha(png, 255, PNG_FILLER_AFTER);
    const int passes = png_set_interlace_handling(png);
    png_read_update_info(png, info);
    if (png_get_rowbytes(png, info) != row_bytes) png_error(png, "its rows have an unknown format");
    for (int pass = 0; pass < passes; ++pass)
        for (png_uint_32 y = 0; y < rows; ++y) png_read_row(png, rgba + y * row_bytes, nullptr);
    return true;
}

/// Checks that the compressed bytes can hold the pixels: deflate expands one byte to at most 1032 bytes (zlib,
/// "Technical Details").
void check_png_length(const Image& image, const ImageSize& size, png_structp png, png_infop info) {
    const std::uint64_t bits = std::uint64_t{png_get_bit_depth(png, info)} * png_get_channels(png, info);
    if (size.pixels() * bits / 8 / 1032 > image.encoded.size()) fail_truncated_image(image, size);
}

}  // namespace

Pixels read_png(const Image& image) {
    PngSource source{image.encoded.data(), image.encoded.size(), {}};
    const PngDecoder decoder(source);
    if (!decoder.png || !decoder.info) throw std::bad_alloc();
    const auto fail = [&] { fail_image(image, std::string("is damaged: ") + source.error.data()); };
    if (!read_png_header(decoder.png, decoder.info, &source)) fail();
    const ImageSize size{png_get_image_width(decoder.png, decoder.info),
                         png_get_image_height(decoder.png, decoder.info)};
    check_png_length(image, size, decoder.png, decoder.info);
    Pixels pixels = pixels_for(image, size);
    if (!read_png_rows(decoder.png, decoder.info, pixels.rgba.data())) fail();
    pixels.has_alpha = has_transparent_pixel(pixels);
    return pixels;
}

}  // namespace faqem::detail

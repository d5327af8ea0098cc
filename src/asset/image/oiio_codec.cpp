// The image codec that uses OpenImageIO: the only file that does.

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <memory>

#include "asset/image/image_checks.hpp"
#include "asset/image/image_codec.hpp"
#include "faqem/error.hpp"

namespace faqem::detail {
namespace {

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

/// Checks the image that the decoder is about to produce.
void check_spec(const Image& image, const OIIO::ImageSpec& spec) {
    if (spec.width <= 0 || spec.height <= 0 || spec.depth != 1 || spec.nchannels <= 0)
        fail_image(image, "is not a two-dimensional image");
    check_image_size(image,
                     {static_cast<std::uint64_t>(spec.width), static_cast<std::uint64_t>(spec.height)});
}

/// Calls work(begin, end) for bands of rows and checks for cancellation before each band. A band takes a few
/// milliseconds. OpenImageIO has its own progress callback, but calls it only once per 64 MB of pixels.
/// \param work  returns false on failure, which ends the loop
/// \return whether all calls succeeded
template <class Work>
bool for_each_row_band(const Pixels& pixels, engine::CancellationCheck check_cancelled, Work&& work) {
    constexpr std::uint32_t pixels_per_band = 16384;
    const std::uint32_t rows = std::max(1u, pixels_per_band / pixels.width);
    for (std::uint32_t y = 0, end; y < pixels.height; y = end) {
        end = y + std::min(rows, pixels.height - y);
        check_cancelled.now();
        if (!work(y, end)) return false;
    }
    return true;
}

/// Expands 1 to 4 channels (grey, grey and alpha, RGB, RGBA) to RGBA.
void expand_to_rgba(const std::uint8_t* from, std::size_t pixels, std::size_t channels, std::uint8_t* to) {
    const bool grey = channels < 3;
    const bool alpha = channels == 2 || channels == 4;
    for (std::size_t i = 0; i < pixels; ++i) {
        std::array<std::uint8_t, 4> pixel = {};
        std::memcpy(pixel.data(), from + i * channels, channels);
        to[4 * i] = pixel[0];
        to[4 * i + 1] = grey ? pixel[0] : pixel[1];
        to[4 * i + 2] = grey ? pixel[0] : pixel[2];
        to[4 * i + 3] = alpha ? pixel[channels - 1] : std::uint8_t{255};
    }
}

OIIO::ImageSpec spec_of(const Pixels& pixels, const std::string& name, int channels) {
    check_pixel_count(pixels, name);
    return OIIO::ImageSpec(static_cast<int>(pixels.width), static_cast<int>(pixels.height), channels,
                           OIIO::TypeDesc::UINT8);
}

Image encode(const Pixels& pixels, const std::string& name, const OIIO::ImageSpec& spec,
             const std::string& format, engine::CancellationCheck check_cancelled) {
    Image image;
    image.name = name;
    image.mime_type = "image/" + format;
    OIIO::Filesystem::IOVecOutput bytes(image.encoded);
    const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(format);
    if (!output) throw Error("OpenImageIO has no writer for " + format + ": " + OIIO::geterror());
    output->set_ioproxy(&bytes);
    const bool opened = output->open("memory." + format, spec);
    const auto channels = static_cast<OIIO::stride_t>(spec.nchannels);
    std::vector<std::uint8_t> rgb;
    const bool written =
        opened && for_each_row_band(pixels, check_cancelled, [&](std::uint32_t begin, std::uint32_t end) {
            const std::size_t first = std::size_t{begin} * pixels.width;
            const std::size_t count = std::size_t{end - begin} * pixels.width;
            const std::uint8_t* rows = &pixels.rgba[4 * first];
            if (channels == 3) {
                rgb.resize(3 * count);
                for (std::size_t i = 0; i < count; ++i) std::memcpy(&rgb[3 * i], rows + 4 * i, 3);
                rows = rgb.data();
            }
            return output->write_scanlines(static_cast<int>(begin), static_cast<int>(end), 0,
                                           OIIO::TypeDesc::UINT8, rows);
        });
    const bool closed = opened && output->close();
    // OpenImageIO 2.4 reports some failures only through geterror().
    const std::string error = output->geterror();
    if (!written || !closed || !error.empty())
        throw WriteError("image '" + name + "': cannot encode: " + error);
    return image;
}

bool reads_webp() {
    static const bool has_reader = [] {
        const auto input = OIIO::ImageInput::create("webp");
        if (!input) OIIO::geterror();  // clears the global error message
        return input && input->supports("ioproxy");
    }();
    return has_reader;
}

Pixels decode_as(const Image& image, const std::string& format, engine::CancellationCheck check_cancelled) {
    OIIO::Filesystem::IOMemReader bytes(image.encoded.data(), image.encoded.size());
    const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::create(format);
    if (!input) throw Error("OpenImageIO has no reader for " + format + ": " + OIIO::geterror());
    input->set_ioproxy(&bytes);
    OIIO::ImageSpec spec, config;
    config.attribute("oiio:UnassociatedAlpha", 1);
    if (!input->open("memory." + format, spec, config)) fail_image(image, first_line(input->geterror()));
    check_spec(image, spec);

    Pixels pixels;
    pixels.width = static_cast<std::uint32_t>(spec.width);
    pixels.height = static_cast<std::uint32_t>(spec.height);
    const int channels = std::min(spec.nchannels, 4);
    pixels.rgba.resize(std::size_t{pixels.width} * pixels.height * 4);
    std::vector<std::uint8_t> band;
    const bool read = for_each_row_band(pixels, check_cancelled, [&](std::uint32_t begin, std::uint32_t end) {
        const std::size_t count = std::size_t{end - begin} * pixels.width;
        band.resize(count * static_cast<std::size_t>(channels));
        if (!input->read_scanlines(0, 0, static_cast<int>(begin), static_cast<int>(end), 0, 0, channels,
                                   OIIO::TypeDesc::UINT8, band.data()))
            return false;
        std::uint8_t* rgba = &pixels.rgba[std::size_t{begin} * pixels.width * 4];
        expand_to_rgba(band.data(), count, static_cast<std::size_t>(channels), rgba);
        for (std::size_t i = 0; i < count && !pixels.has_alpha; ++i)
            pixels.has_alpha = rgba[4 * i + 3] != 255;
        return true;
    });
    const bool closed = input->close();
    const std::string error = input->geterror();
    if (!read || !closed || !error.empty())
        fail_image(image, error.empty() ? "is damaged" : "is damaged: " + first_line(error));
    return pixels;
}

Image encode_as_jpeg(const Pixels& pixels, const std::string& name, std::uint32_t quality, Content content,
                     engine::CancellationCheck check_cancelled) {
    OIIO::ImageSpec spec = spec_of(pixels, name, 3);
    spec.attribute("CompressionQuality", static_cast<int>(quality));
    if (content == Content::data) spec.attribute("jpeg:subsampling", "4:4:4");
    return encode(pixels, name, spec, "jpeg", check_cancelled);
}

}  // namespace

const ImageCodec& oiio_image_codec() {
    static constexpr ImageCodec codec = {FAQEM_VERSION, reads_webp, decode_as, encode_as_jpeg};
    return codec;
}

}  // namespace faqem::detail

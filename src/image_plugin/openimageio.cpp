// The image plugin, the only file that uses OpenImageIO.

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <memory>
#include <vector>

#include "asset/image/image_checks.hpp"
#include "asset/image/image_plugin.hpp"
#include "faqem/error.hpp"
#include "faqem/export.hpp"

namespace faqem::detail {
namespace {

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

/// No format that is read expands a byte to more pixels: TGA packs at most 128 pixels into two bytes.
constexpr std::uint64_t max_pixels_per_byte = 64;

/// Checks the image that the decoder is about to produce, before memory is allocated.
void check_spec(const Image& image, const OIIO::ImageSpec& spec) {
    if (spec.width <= 0 || spec.height <= 0 || spec.depth != 1 || spec.nchannels <= 0)
        fail_image(image, "is not a two-dimensional image");
    const ImageSize size{static_cast<std::uint64_t>(spec.width), static_cast<std::uint64_t>(spec.height)};
    check_image_size(image, size);
    if (size.pixels() / max_pixels_per_byte > image.encoded.size()) fail_truncated_image(image, size);
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

Pixels decode_as(const Image& image, const std::string& format) {
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
    const std::size_t count = std::size_t{pixels.width} * pixels.height;
    const int channels = std::min(spec.nchannels, 4);
    std::vector<std::uint8_t> stored(count * static_cast<std::size_t>(channels));
    const bool read =
        input->read_scanlines(0, 0, 0, spec.height, 0, 0, channels, OIIO::TypeDesc::UINT8, stored.data());
    const bool closed = input->close();
    const std::string error = input->geterror();
    if (!read || !closed || !error.empty())
        fail_image(image, error.empty() ? "is damaged" : "is damaged: " + first_line(error));
    pixels.rgba.resize(count * 4);
    expand_to_rgba(stored.data(), count, static_cast<std::size_t>(channels), pixels.rgba.data());
    pixels.has_alpha = has_transparent_pixel(pixels);
    return pixels;
}

constexpr ImagePlugin plugin = {FAQEM_VERSION, decode_as};

}  // namespace

}  // namespace faqem::detail

/// What image_plugin() looks up.
extern "C" FAQEM_EXPORT const faqem::detail::ImagePlugin* faqem_image_plugin() {
    return &faqem::detail::plugin;
}

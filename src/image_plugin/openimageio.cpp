// The image plugin, the only file that uses OpenImageIO.

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <memory>
#include <vector>

#include "asset/image/codecs.hpp"
#include "asset/image/image_size.hpp"
#include "faqem/error.hpp"
#include "faqem/export.hpp"

namespace faqem::detail {
namespace {

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

/// Checks the image that the decoder is about to produce, before memory is allocated: the header may describe
/// it otherwise than the decoder understands it.
void check_spec(const Image& image, const OIIO::ImageSpec& spec) {
    constexpr int max_channels = 8;
    constexpr std::size_t max_channel_bytes = 4;
    if (spec.width <= 0 || spec.height <= 0 || spec.depth != 1 || spec.nchannels <= 0)
        fail_image(image, "is not a two-dimensional image");
    constexpr auto max_tile_side = static_cast<int>(max_image_side);
    if (spec.nchannels > max_channels || spec.format.size() > max_channel_bytes ||
        spec.tile_width > max_tile_side || spec.tile_height > max_tile_side || spec.tile_depth > 1)
        throw UnsupportedError(image.uri, image_title(image),
                               "has more than 8 channels, more than 32 bits per channel, or too large tiles");
}

/// Whether the last of 2 or 4 channels is alpha. Of TGA it always is.
bool has_alpha_channel(const OIIO::ImageSpec& spec, int channels, const std::string& format) {
    if (channels != 2 && channels != 4) return false;
    return format == "targa" || spec.alpha_channel == channels - 1;
}

/// BMP and TGA files whose fourth channel is not used have zeros there.
void show_unused_alpha(Pixels& pixels) {
    for (std::size_t i = 3; i < pixels.rgba.size(); i += 4)
        if (pixels.rgba[i] != 0) return;
    for (std::size_t i = 3; i < pixels.rgba.size(); i += 4) pixels.rgba[i] = 255;
}

/// Expands 1 to 4 channels (grey, grey and alpha, RGB, RGBA) to RGBA.
/// \param alpha  whether the last channel is alpha; otherwise a second or fourth channel is ignored
void expand_to_rgba(const std::uint8_t* from, std::size_t pixels, std::size_t channels, bool alpha,
                    std::uint8_t* to) {
    const bool grey = channels < 3;
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

    Pixels pixels =
        pixels_for(image, {static_cast<std::uint64_t>(spec.width), static_cast<std::uint64_t>(spec.height)});
    const std::size_t count = pixels.rgba.size() / 4;
    const int channels = std::min(spec.nchannels, 4);
    std::vector<std::uint8_t> stored(count * static_cast<std::size_t>(channels));
    const bool read = input->read_image(0, 0, 0, channels, OIIO::TypeDesc::UINT8, stored.data());
    const bool closed = input->close();
    const std::string error = input->geterror();
    if (!read || !closed || !error.empty())
        fail_image(image, error.empty() ? "is damaged" : "is damaged: " + first_line(error));
    expand_to_rgba(stored.data(), count, static_cast<std::size_t>(channels),
                   has_alpha_channel(spec, channels, format), pixels.rgba.data());
    if (format == "targa" || format == "bmp") show_unused_alpha(pixels);
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

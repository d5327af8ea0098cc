// Decoding and encoding of WebP files with libwebp.

#include "asset/image/codecs.hpp"

#include <webp/decode.h>
#include <webp/demux.h>
#include <webp/encode.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <new>
#include <string>

#include "asset/image/image_size.hpp"
#include "faqem/error.hpp"

namespace faqem::detail {
namespace {

/// Copies the first picture of an animation, on its canvas. Returns false if it is damaged.
bool read_first_picture(const Image& image, std::uint8_t* rgba, std::size_t size) {
    WebPAnimDecoderOptions options;
    if (!WebPAnimDecoderOptionsInit(&options)) return false;
    options.color_mode = MODE_RGBA;
    const WebPData data{image.encoded.data(), image.encoded.size()};
    const std::unique_ptr<WebPAnimDecoder, decltype(&WebPAnimDecoderDelete)> decoder(
        WebPAnimDecoderNew(&data, &options), WebPAnimDecoderDelete);
    std::uint8_t* canvas = nullptr;
    int time = 0;
    if (!decoder || !WebPAnimDecoderGetNext(decoder.get(), &canvas, &time)) return false;
    std::memcpy(rgba, canvas, size);
    return true;
}

WebPConfig webp_config(const WebpOptions& options) {
    WebPConfig config;
    // It fails only if the library is another version than its header.
    if (!WebPConfigInit(&config)) throw Error("libwebp is older than the version that faqem was built with");
    config.method = options.effort;
    config.exact = options.mode != WebpMode::near_lossless;  // libwebp would change nothing otherwise
    config.lossless = options.mode != WebpMode::lossy;
    if (options.mode == WebpMode::lossy) config.quality = static_cast<float>(options.level);
    if (options.mode == WebpMode::near_lossless) config.near_lossless = options.level;
    if (options.level < 0 || options.level > 100 || !WebPValidateConfig(&config))
        throw OptionError("WebpOptions: the level must be in [0, 100] and the effort in [0, 6]");
    return config;
}

/// A picture of libwebp and its encoded bytes, with the memory of both.
struct WebpEncoder {
    WebpEncoder() {
        if (!WebPPictureInit(&picture))
            throw Error("libwebp is older than the version that faqem was built with");
        WebPMemoryWriterInit(&output);
        picture.writer = WebPMemoryWrite;
        picture.custom_ptr = &output;
    }
    ~WebpEncoder() {
        WebPPictureFree(&picture);
        WebPMemoryWriterClear(&output);
    }
    WebpEncoder(const WebpEncoder&) = delete;
    WebpEncoder& operator=(const WebpEncoder&) = delete;

    WebPPicture picture;
    WebPMemoryWriter output;
};

}  // namespace

Pixels read_webp(const Image& image) {
    WebPBitstreamFeatures features;
    if (WebPGetFeatures(image.encoded.data(), image.encoded.size(), &features) != VP8_STATUS_OK)
        fail_image(image, "is damaged");
    Pixels pixels = pixels_for(
        image, {static_cast<std::uint64_t>(features.width), static_cast<std::uint64_t>(features.height)});
    const bool decoded =
        features.has_animation
            ? read_first_picture(image, pixels.rgba.data(), pixels.rgba.size())
            : WebPDecodeRGBAInto(image.encoded.data(), image.encoded.size(), pixels.rgba.data(),
                                 pixels.rgba.size(), 4 * features.width) != nullptr;
    if (!decoded) fail_image(image, "is damaged");
    pixels.has_alpha = has_transparent_pixel(pixels);
    return pixels;
}

}  // namespace faqem::detail

faqem::Image faqem::encode_webp(const Pixels& pixels, const std::string& name, const WebpOptions& options) {
    detail::check_pixel_count(pixels, name);
    const WebPConfig config = detail::webp_config(options);
    if (pixels.width > WEBP_MAX_DIMENSION || pixels.height > WEBP_MAX_DIMENSION)
        throw WriteError("image '" + name + "': " + detail::image_size_text({pixels.width, pixels.height}) +
                         " pixels are too many for WebP, at most 16383 x 16383 are possible");
    detail::WebpEncoder encoder;
    encoder.picture.use_argb = config.lossless;
    encoder.picture.width = static_cast<int>(pixels.width);
    encoder.picture.height = static_cast<int>(pixels.height);
    const int stride = 4 * encoder.picture.width;
    const bool imported = pixels.has_alpha
                              ? WebPPictureImportRGBA(&encoder.picture, pixels.rgba.data(), stride)
                              : WebPPictureImportRGBX(&encoder.picture, pixels.rgba.data(), stride);
    if (!imported || !WebPEncode(&config, &encoder.picture)) {
        const WebPEncodingError error = encoder.picture.error_code;
        if (error == VP8_ENC_ERROR_OUT_OF_MEMORY || error == VP8_ENC_ERROR_BITSTREAM_OUT_OF_MEMORY)
            throw std::bad_alloc();
        // Left are the limits of the format for the bytes of its partitions.
        throw WriteError("image '" + name + "': too large for WebP (error " + std::to_string(error) + ")");
    }
    return {name, "image/webp", {encoder.output.mem, encoder.output.mem + encoder.output.size}, {}};
}

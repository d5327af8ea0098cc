/// \file
/// The images of WebAssembly: pixels, which JavaScript decodes before a call and encodes after it (package/glb.js). They
/// follow the header of a PNG in place of its compressed data, so that all else reads their size as usual.

#include <algorithm>
#include <array>

#include "asset/image/codecs.hpp"
#include "asset/image/image_size.hpp"

namespace faqem {
namespace detail {
namespace {

/// Signature and header of a PNG with 8 bits per channel, and the header's checksum, which nothing reads.
constexpr std::size_t header_size = 33;
constexpr std::array<std::uint8_t, header_size> header = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n', 0, 0,
                                                          0,    13,  'I', 'H', 'D',  'R',  0,    0,    0, 0,
                                                          0,    0,   0,   0,   8,    6,    0,    0,    0};

[[noreturn]] void fail_kind(const std::string& name, const char* kind) {
    throw UnsupportedError("", "image '" + name + "'", std::string(kind) + " is a matter of JavaScript");
}

}  // namespace

Pixels read_png(const Image& image) {
    Pixels pixels = pixels_for(image, declared_size(image).value_or(ImageSize{}));
    if (image.encoded.size() != header_size + pixels.rgba.size()) fail_image(image, "has not been decoded");
    std::copy(image.encoded.begin() + header_size, image.encoded.end(), pixels.rgba.begin());
    pixels.has_alpha = has_transparent_pixel(pixels);
    return pixels;
}

Image write_png(const Pixels& pixels, const std::string& name, int) {
    Image image{name, "image/png", {header.begin(), header.end()}, {}};
    for (std::size_t i = 0; i < 4; ++i) {
        image.encoded[16 + i] = static_cast<std::uint8_t>(pixels.width >> (24 - 8 * i));
        image.encoded[20 + i] = static_cast<std::uint8_t>(pixels.height >> (24 - 8 * i));
    }
    image.encoded.insert(image.encoded.end(), pixels.rgba.begin(), pixels.rgba.end());
    for (std::size_t i = header_size + 3; !pixels.has_alpha && i < image.encoded.size(); i += 4)
        image.encoded[i] = 255;
    return image;
}

Pixels read_jpeg(const Image& image) { fail_kind(image.name, "JPEG"); }
Pixels read_webp(const Image& image) { fail_kind(image.name, "WebP"); }
Image write_jpeg(const Pixels&, const std::string& name, const JpegRounding&) { fail_kind(name, "JPEG"); }

}  // namespace detail

Image encode_jpeg(const Pixels&, const std::string& name, std::uint32_t, Content) {
    detail::fail_kind(name, "JPEG");
}
Image encode_webp(const Pixels&, const std::string& name, const WebpOptions&) {
    detail::fail_kind(name, "WebP");
}

}  // namespace faqem

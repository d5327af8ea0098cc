#include "asset/image/image_size.hpp"

#include <string>
#include <string_view>

#include "asset/image/image.hpp"

namespace faqem::detail {
namespace {

using Bytes = std::span<const std::uint8_t>;

constexpr std::uint64_t max_jpeg_pixels_per_byte = 512;  // one bit per block of 8 x 8 pixels
constexpr std::uint64_t max_webp_pixels_per_byte = 4096, max_unchecked_webp_pixels = 1 << 24;

/// An unsigned integer of `size` bytes at the position `at`.
/// \pre at + size <= bytes.size()
std::uint64_t big_endian(Bytes bytes, std::size_t at, std::size_t size) {
    std::uint64_t value = 0;
    for (const std::uint8_t byte : bytes.subspan(at, size)) value = value << 8 | byte;
    return value;
}

std::uint64_t little_endian(Bytes bytes, std::size_t at, std::size_t size) {
    std::uint64_t value = 0;
    for (std::size_t i = size; i-- > 0;) value = value << 8 | bytes[at + i];
    return value;
}

std::optional<ImageSize> png_size(Bytes bytes) {
    if (bytes.size() < 24) return {};
    return ImageSize{big_endian(bytes, 16, 4), big_endian(bytes, 20, 4)};
}

bool is_frame_header(std::uint8_t marker) {
    return marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC;
}

/// Position of the first marker segment, from `at` on, whose marker is accepted; the size of the file if there
/// is none. Bytes between markers are skipped, as in libjpeg.
template <class Accept>
std::size_t find_jpeg_segment(Bytes bytes, std::size_t at, Accept&& accept) {
    while (at + 9 < bytes.size()) {
        if (bytes[at] != 0xFF || bytes[at + 1] == 0xFF || bytes[at + 1] == 0) {
            ++at;
            continue;
        }
        const std::uint8_t marker = bytes[at + 1];
        if (accept(marker)) return at;
        const bool is_standalone = marker == 0x01 || (marker >= 0xD0 && marker <= 0xD8);
        at += is_standalone ? 2 : 2 + big_endian(bytes, at + 2, 2);
    }
    return bytes.size();
}

/// Size in the first frame header.
std::optional<ImageSize> jpeg_size(Bytes bytes) {
    const std::size_t at = find_jpeg_segment(bytes, 2, is_frame_header);
    if (at == bytes.size()) return {};
    return ImageSize{big_endian(bytes, at + 7, 2), big_endian(bytes, at + 5, 2)};
}

/// Bytes per pixel of the coefficients that libjpeg keeps if the components of the image are in several scans,
/// as in progressive files: 16 bits per component.
std::uint64_t jpeg_coefficient_bytes(Bytes bytes) {
    constexpr std::uint8_t progressive = 0xC2, start_of_scan = 0xDA;
    const std::size_t frame = find_jpeg_segment(bytes, 2, is_frame_header);
    if (frame == bytes.size()) return 0;
    const std::uint64_t components = bytes[frame + 9];
    const std::size_t scan =
        find_jpeg_segment(bytes, frame, [](std::uint8_t m) { return m == start_of_scan; });
    const bool is_single_scan =
        bytes[frame + 1] != progressive && scan != bytes.size() && bytes[scan + 4] == components;
    return is_single_scan ? 0 : 2 * components;
}

/// Size in the first chunk, which must be VP8X, VP8L or VP8 (RFC 9649).
std::optional<ImageSize> webp_size(Bytes bytes) {
    if (bytes.size() < 30) return {};
    const std::string_view chunk(reinterpret_cast<const char*>(bytes.data()) + 12, 4);
    if (chunk == "VP8X") return ImageSize{little_endian(bytes, 24, 3) + 1, little_endian(bytes, 27, 3) + 1};
    if (chunk == "VP8L") {
        const std::uint64_t bits = little_endian(bytes, 21, 4);
        return ImageSize{(bits & 0x3FFF) + 1, (bits >> 14 & 0x3FFF) + 1};
    }
    if (chunk == "VP8 ")
        return ImageSize{little_endian(bytes, 26, 2) & 0x3FFF, little_endian(bytes, 28, 2) & 0x3FFF};
    return {};
}

}  // namespace

std::optional<ImageSize> declared_size(Bytes bytes) {
    const std::string type = sniff_mime_type(bytes);
    if (type == "image/png") return png_size(bytes);
    if (type == "image/jpeg") return jpeg_size(bytes);
    if (type == "image/webp") return webp_size(bytes);
    return {};
}

std::uint64_t decoding_memory(Bytes bytes) {
    const std::optional<ImageSize> size = declared_size(bytes);
    if (!size || size->width > max_image_side || size->height > max_image_side) return 0;
    const std::string type = sniff_mime_type(bytes);
    // Of an animation libwebp keeps the canvas, a frame and its own copy of the pixels.
    std::uint64_t per_pixel = 16;
    if (type == "image/png") per_pixel = 0;  // libpng keeps single rows
    if (type == "image/jpeg") per_pixel = jpeg_coefficient_bytes(bytes);
    return bytes.size() + per_pixel * size->pixels();
}

bool is_plausible_size(Bytes bytes, const ImageSize& size) {
    const std::string type = sniff_mime_type(bytes);
    if (type == "image/jpeg") return size.pixels() / max_jpeg_pixels_per_byte <= bytes.size();
    if (type != "image/webp" || size.pixels() <= max_unchecked_webp_pixels) return true;
    return size.pixels() / max_webp_pixels_per_byte <= bytes.size();
}

}  // namespace faqem::detail

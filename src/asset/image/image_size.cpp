#include "asset/image/image_size.hpp"

#include <span>
#include <string_view>

#include "asset/image/codecs.hpp"
#include "asset/image/image.hpp"

namespace faqem::detail {
namespace {

using Bytes = std::span<const std::uint8_t>;

constexpr std::uint64_t max_jpeg_pixels_per_byte = 512;  // one bit per block of 8 x 8 pixels
constexpr std::uint64_t max_tga_pixels_per_byte = 64, max_bmp_pixels_per_byte = 128;
constexpr std::uint64_t max_other_pixels_per_byte = 4096, max_unchecked_pixels = 1 << 24;

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

/// Only headers of the types that exist, since TGA has no signature.
std::optional<ImageSize> tga_size(Bytes bytes) {
    if (bytes.size() < 18) return {};
    const std::uint8_t color_map = bytes[1], type = bytes[2] & ~8,
                       depth = bytes[16];  // 8: run-length encoded
    const bool is_known = color_map <= 1 && type >= 1 && type <= 3 &&
                          (depth == 8 || depth == 15 || depth == 16 || depth == 24 || depth == 32);
    if (!is_known) return {};
    return ImageSize{little_endian(bytes, 12, 2), little_endian(bytes, 14, 2)};
}

/// A negative height is that of rows from top to bottom.
std::optional<ImageSize> bmp_size(Bytes bytes) {
    if (bytes.size() < 26) return {};
    constexpr std::uint64_t core_header_bytes = 12;
    if (little_endian(bytes, 14, 4) == core_header_bytes)
        return ImageSize{little_endian(bytes, 18, 2), little_endian(bytes, 20, 2)};
    const std::uint64_t height = little_endian(bytes, 22, 4);
    return ImageSize{little_endian(bytes, 18, 4), height < 0x80000000u ? height : 0x100000000u - height};
}

std::optional<ImageSize> gif_size(Bytes bytes) {
    if (bytes.size() < 10) return {};
    return ImageSize{little_endian(bytes, 6, 2), little_endian(bytes, 8, 2)};
}

/// The tags ImageWidth and ImageLength of the first directory (TIFF 6.0, section 2).
std::optional<ImageSize> tiff_size(Bytes bytes) {
    const bool is_little = bytes[0] == 'I';
    const auto number = [&](std::uint64_t at, std::size_t size) {
        return is_little ? little_endian(bytes, at, size) : big_endian(bytes, at, size);
    };
    constexpr std::size_t entry_bytes = 12;
    constexpr std::uint64_t width_tag = 256, height_tag = 257, short_type = 3;
    if (bytes.size() < 8) return {};
    const std::uint64_t directory = number(4, 4);
    if (directory + 2 > bytes.size()) return {};
    const std::uint64_t entries = number(directory, 2);
    if (entries > (bytes.size() - directory - 2) / entry_bytes) return {};
    ImageSize size;
    for (std::uint64_t i = 0; i < entries; ++i) {
        const std::uint64_t at = directory + 2 + i * entry_bytes;
        const std::uint64_t tag = number(at, 2),
                            value = number(at + 8, number(at + 2, 2) == short_type ? 2 : 4);
        if (tag == width_tag) size.width = value;
        if (tag == height_tag) size.height = value;
    }
    return size;
}

/// Of images that are not decoded there is no size.
std::optional<ImageSize> ktx2_size(Bytes bytes) {
    if (bytes.size() < 28 || !reads_ktx2()) return {};
    return ImageSize{little_endian(bytes, 20, 4), little_endian(bytes, 24, 4)};
}

}  // namespace

std::optional<ImageSize> declared_size(const Image& image) {
    const Bytes bytes = image.encoded;
    const std::string type = media_type(image);
    if (type == "image/png") return png_size(bytes);
    if (type == "image/jpeg") return jpeg_size(bytes);
    if (type == "image/webp") return webp_size(bytes);
    if (type == "image/bmp") return bmp_size(bytes);
    if (type == "image/gif") return gif_size(bytes);
    if (type == "image/tiff") return tiff_size(bytes);
    if (type == tga_media_type) return tga_size(bytes);
    if (type == ktx2_media_type) return ktx2_size(bytes);
    return {};
}

std::uint64_t readable_pixels(const Image& image) {
    const std::optional<ImageSize> size = declared_size(image);
    const bool is_read = size && size->width <= max_image_side && size->height <= max_image_side;
    return is_read ? size->pixels() : 0;
}

std::uint64_t decoding_memory(const Image& image) {
    const Bytes bytes = image.encoded;
    const std::optional<ImageSize> size = declared_size(image);
    if (!size || size->width > max_image_side || size->height > max_image_side) return 0;
    const std::string type = media_type(image);
    // Of an animation libwebp keeps the canvas, a frame and its own copy of the pixels.
    std::uint64_t per_pixel = 16;
    if (type == "image/png") per_pixel = 0;  // libpng keeps single rows
    if (type == "image/jpeg") per_pixel = jpeg_coefficient_bytes(bytes);
    if (type == ktx2_media_type) per_pixel = 1;  // blocks of 4 x 4 pixels have 16 bytes
    return bytes.size() + per_pixel * size->pixels();
}

bool is_plausible_size(const Image& image, const ImageSize& size) {
    const std::string type = media_type(image);
    const auto is_at_most = [&](std::uint64_t pixels_per_byte) {
        return size.pixels() / pixels_per_byte <= image.encoded.size();
    };
    if (type == "image/png") return true;
    if (type == "image/jpeg") return is_at_most(max_jpeg_pixels_per_byte);
    if (type == "image/bmp") return is_at_most(max_bmp_pixels_per_byte);
    if (type == tga_media_type) return is_at_most(max_tga_pixels_per_byte);
    return size.pixels() <= max_unchecked_pixels || is_at_most(max_other_pixels_per_byte);
}

}  // namespace faqem::detail

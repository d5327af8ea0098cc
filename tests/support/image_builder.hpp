#pragma once
// Image files for tests, byte by byte.

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "support/format_support.hpp"

namespace faqem::testing {

using Bytes = std::vector<std::uint8_t>;

inline Image image_x(const std::string& bytes) { return image_of(bytes, "x"); }

inline std::string bytes_of_hex(const std::string& hex) {
    std::string bytes;
    for (std::size_t i = 0; i + 1 < hex.size(); i += 2)
        bytes.push_back(static_cast<char>(std::stoi(hex.substr(i, 2), nullptr, 16)));
    return bytes;
}

/// CRC-32 of PNG chunks (ISO 3309).
inline std::uint32_t png_crc(const std::string& bytes) {
    std::uint32_t sum = 0xffffffff;
    for (const char c : bytes) {
        sum ^= static_cast<unsigned char>(c);
        for (int k = 0; k < 8; ++k) sum = sum & 1 ? 0xedb88320u ^ (sum >> 1) : sum >> 1;
    }
    return ~sum;
}

inline std::string big_endian(std::uint32_t value) {
    std::string bytes;
    for (int shift = 24; shift >= 0; shift -= 8) bytes.push_back(static_cast<char>(value >> shift));
    return bytes;
}

inline std::string png_chunk(const std::string& type, const std::string& data) {
    return big_endian(static_cast<std::uint32_t>(data.size())) + type + data +
           big_endian(png_crc(type + data));
}

/// A zlib stream of one stored, uncompressed block (RFC 1950 and 1951).
inline std::string zlib_stored(const std::string& data) {
    std::uint32_t a = 1, b = 0;
    for (const char c : data) {
        a = (a + static_cast<unsigned char>(c)) % 65521;
        b = (b + a) % 65521;
    }
    const auto size = static_cast<std::uint16_t>(data.size());
    std::string out = bytes_of_hex("780101");
    for (const std::uint16_t word : {size, static_cast<std::uint16_t>(~size)}) {
        out.push_back(static_cast<char>(word & 255));
        out.push_back(static_cast<char>(word >> 8));
    }
    return out + data + big_endian(b << 16 | a);
}

/// A PNG with the given rows, each of which starts with its filter byte; if it is interlaced, those of all passes.
inline std::string png_file(std::uint32_t width, std::uint32_t height, int bits, int color_type,
                            const std::string& rows, const std::string& extra_chunks = "",
                            bool interlaced = false) {
    const std::string header = big_endian(width) + big_endian(height) + static_cast<char>(bits) +
                               static_cast<char>(color_type) + std::string(2, '\0') +
                               static_cast<char>(interlaced);
    return std::string("\x89PNG\r\n\x1a\n") + png_chunk("IHDR", header) + extra_chunks +
           png_chunk("IDAT", zlib_stored(rows)) + png_chunk("IEND", "");
}

/// Waves with a period of at least 8 pixels, and a different one in each channel.
inline Pixels waves(std::uint32_t width, std::uint32_t height) {
    Pixels pixels{width, height, {}, false};
    for (std::uint32_t y = 0; y < height; ++y)
        for (std::uint32_t x = 0; x < width; ++x) {
            for (const double period : {40.0, 13.0, 8.0})
                pixels.rgba.push_back(
                    static_cast<std::uint8_t>(128 + 60 * std::sin(x / period) + 60 * std::cos(y / period)));
            pixels.rgba.push_back(255);
        }
    return pixels;
}

/// The peak signal-to-noise ratio of all channels, in dB.
inline double psnr(const Pixels& a, const Pixels& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.rgba.size(); ++i) sum += std::pow(double(a.rgba[i]) - b.rgba[i], 2);
    return 10 * std::log10(255.0 * 255 * static_cast<double>(a.rgba.size()) / sum);
}

}  // namespace faqem::testing

// Decoding and encoding of WebP.

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include "support/catch.hpp"
#include "support/format_support.hpp"
#include "support/image_builder.hpp"

using namespace faqem;
using namespace faqem::testing;

namespace {

/// waves() with an alpha that is 0 in places.
Pixels transparent_waves() {
    Pixels pixels = waves(61, 47);
    pixels.has_alpha = true;
    for (std::size_t i = 0; i < pixels.rgba.size(); i += 4)
        pixels.rgba[i + 3] = static_cast<std::uint8_t>(i / 4 % 61 < 20 ? 0 : i * 7 % 256);
    return pixels;
}

int largest_difference(const Pixels& a, const Pixels& b) {
    int largest = 0;
    for (std::size_t i = 0; i < a.rgba.size(); ++i)
        largest = std::max(largest, std::abs(a.rgba[i] - b.rgba[i]));
    return largest;
}

std::string little_endian(std::size_t value, int bytes) {
    std::string text;
    for (int i = 0; i < bytes; ++i) text.push_back(static_cast<char>(value >> 8 * i & 255));
    return text;
}

std::string riff_chunk(const std::string& type, const std::string& data) {
    return type + little_endian(data.size(), 4) + data + std::string(data.size() % 2, '\0');
}

/// An animated WebP (RFC 9649) of lossless pictures, each with the position of its upper left corner on both
/// axes, which is even.
std::string animation(std::size_t width, std::size_t height,
                      const std::vector<std::pair<Pixels, std::size_t>>& pictures) {
    std::string chunks = riff_chunk("VP8X", bytes_of_hex("12000000") + little_endian(width - 1, 3) +
                                                little_endian(height - 1, 3)) +
                         riff_chunk("ANIM", std::string(6, '\0'));
    for (const auto& [pixels, corner] : pictures) {
        const Image still = encode_webp(pixels, "", {WebpMode::lossless, 0, 4});
        const std::string place = little_endian(corner / 2, 3) + little_endian(corner / 2, 3) +
                                  little_endian(pixels.width - 1, 3) + little_endian(pixels.height - 1, 3);
        chunks += riff_chunk("ANMF", place + little_endian(100, 3) + std::string(1, '\0') +
                                         std::string(still.encoded.begin() + 12, still.encoded.end()));
    }
    return riff_chunk("RIFF", "WEBP" + chunks);
}

}  // namespace

TEST_CASE("lossless WebP keeps all values, also colours with zero alpha") {
    for (const int effort : {0, 4, 6}) {
        const WebpOptions options{WebpMode::lossless, 0, effort};
        for (const Pixels& pixels : {transparent_waves(), waves(16, 1), waves(1, 1)}) {
            const Image image = encode_webp(pixels, "name", options);
            CHECK(image.name == "name");
            CHECK(image.mime_type == "image/webp");
            const Pixels back = decode(image);
            CHECK(back.width == pixels.width);
            CHECK(back.height == pixels.height);
            CHECK(back.has_alpha == pixels.has_alpha);
            CHECK(back.rgba == pixels.rgba);
            CHECK(encode_webp(pixels, "name", options).encoded == image.encoded);
        }
    }
}

TEST_CASE("near-lossless WebP changes values by little, and less at a higher level") {
    Pixels pixels = waves(120, 90);  // smooth places would not be changed
    for (std::uint32_t i = 0; i < pixels.rgba.size(); ++i)
        if (i % 4 != 3)
            pixels.rgba[i] = static_cast<std::uint8_t>(pixels.rgba[i] + (i * 2654435761u >> 28) / 2);
    int previous = 33;
    std::size_t bytes = 0;
    for (const int level : {40, 60, 80, 100}) {
        const Image image = encode_webp(pixels, "", {WebpMode::near_lossless, level, 4});
        const int largest = largest_difference(pixels, decode(image));
        CHECK(largest < previous);
        CHECK(image.encoded.size() >= bytes);
        previous = largest + 1;
        bytes = image.encoded.size();
    }
    CHECK(previous == 1);
    CHECK(encode_webp(pixels, "", {WebpMode::near_lossless, 40, 4}).encoded.size() < bytes * 3 / 4);
}

TEST_CASE("lossy WebP is close to the pixels, and closer with higher quality; alpha is exact") {
    const Pixels pixels = transparent_waves();
    double previous = 25;
    for (const int quality : {10, 50, 85, 100}) {
        const Pixels back = decode(encode_webp(pixels, "", {WebpMode::lossy, quality, 4}));
        REQUIRE(back.rgba.size() == pixels.rgba.size());
        const double quality_db = psnr(pixels, back);
        CHECK(quality_db > previous);
        previous = quality_db;
        for (std::size_t i = 3; i < pixels.rgba.size(); i += 4) REQUIRE(back.rgba[i] == pixels.rgba[i]);
    }
    CHECK(previous > 38);
}

TEST_CASE("WebP encoding without alpha ignores alpha values") {
    Pixels pixels = transparent_waves();
    pixels.has_alpha = false;
    for (const WebpMode mode : {WebpMode::lossy, WebpMode::near_lossless, WebpMode::lossless}) {
        const Pixels back = decode(encode_webp(pixels, "", {mode, 90, 4}));
        CHECK_FALSE(back.has_alpha);
        if (mode == WebpMode::lossless) CHECK(back.rgba[0] == pixels.rgba[0]);
    }
}

TEST_CASE("WebP options out of range and images that are too large are refused") {
    const Pixels pixels = waves(2, 2);
    CHECK_THROWS_AS(encode_webp(pixels, "a", {WebpMode::lossy, 101, 4}), OptionError);
    CHECK_THROWS_AS(encode_webp(pixels, "a", {WebpMode::near_lossless, -1, 4}), OptionError);
    CHECK_THROWS_AS(encode_webp(pixels, "a", {WebpMode::lossless, 0, 7}), OptionError);
    CHECK_THROWS_AS(encode_webp(Pixels{2, 2, Bytes(12), false}, "a", {}), InputError);
    CHECK(contains(message_of<WriteError>([] {
                       encode_webp(Pixels{16384, 1, Bytes(65536), false}, "a", {});
                   }),
                   "image 'a': 16384 x 1 pixels are too many"));
}

TEST_CASE("a WebP that is cut anywhere is rejected, and the message names the image") {
    for (const WebpMode mode : {WebpMode::lossy, WebpMode::lossless}) {
        const Image whole = encode_webp(transparent_waves(), "x", {mode, 80, 4});
        for (std::size_t size = 0; size < whole.encoded.size(); size += size < 100 ? 1 : 37) {
            Image cut = whole;
            cut.encoded.resize(size);
            INFO(size);
            CHECK_THROWS_AS(decode(cut), InputError);
        }
        Image half = whole;
        half.encoded.resize(half.encoded.size() / 2);
        CHECK(contains(message_of<InputError>([&] { decode(half); }), "image 'x': is damaged"));
    }
}

TEST_CASE("of an animated WebP the first picture is decoded, on its canvas") {
    const Pixels first = waves(20, 10), second = waves(16, 8);
    const std::string bytes = animation(24, 12, {{first, 2}, {second, 0}});
    const Pixels back = decode(image_x(bytes));
    REQUIRE(back.width == 24);
    REQUIRE(back.height == 12);
    CHECK(back.has_alpha);
    for (std::size_t y = 0; y < 12; ++y)
        for (std::size_t x = 0; x < 24; ++x) {
            const bool inside = x >= 2 && x < 22 && y >= 2;
            for (std::size_t c = 0; c < 4; ++c)
                REQUIRE(back.rgba[4 * (24 * y + x) + c] ==
                        (inside ? first.rgba[4 * (20 * (y - 2) + x - 2) + c] : 0));
        }
    CHECK_THROWS_AS(decode(image_x(bytes.substr(0, bytes.size() / 3))), InputError);
}

// Decoding and encoding of PNG.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <string>
#include <utility>

#include "asset/image/codecs.hpp"
#include "support/catch.hpp"
#include "support/format_support.hpp"
#include "support/image_builder.hpp"

using namespace faqem;
using namespace faqem::testing;

namespace {

/// How the samples of a PNG are stored.
struct PngKind {
    int color_type, bits, channels;
};

constexpr PngKind all_kinds[] = {{0, 1, 1}, {0, 2, 1},  {0, 4, 1},  {0, 8, 1}, {0, 16, 1},
                                 {2, 8, 3}, {2, 16, 3}, {3, 1, 1},  {3, 2, 1}, {3, 4, 1},
                                 {3, 8, 1}, {4, 8, 2},  {4, 16, 2}, {6, 8, 4}, {6, 16, 4}};

/// An arbitrary sample.
std::uint32_t sample(const PngKind& kind, std::uint32_t x, std::uint32_t y, int channel) {
    const std::uint32_t mixed =
        (x * 40503u + y * 30011u + static_cast<std::uint32_t>(channel) * 7919u) * 2654435761u;
    return (mixed >> 8) & ((1u << kind.bits) - 1);
}

/// A palette with one colour for each index.
std::string palette_of(const PngKind& kind) {
    std::string colors;
    for (int i = 0; i < 1 << kind.bits; ++i)
        for (const int value : {i, 255 - i, 7 * i}) colors.push_back(static_cast<char>(value));
    return png_chunk("PLTE", colors);
}

/// The unfiltered rows of the pixels (x0 + i dx, y0 + j dy).
std::string rows_of(const PngKind& kind, std::uint32_t width, std::uint32_t height, std::uint32_t x0,
                    std::uint32_t y0, std::uint32_t dx, std::uint32_t dy) {
    std::string rows;
    for (std::uint32_t y = y0; y < height && x0 < width; y += dy) {
        std::string bits(8, '0');  // no filter
        for (std::uint32_t x = x0; x < width; x += dx)
            for (int channel = 0; channel < kind.channels; ++channel)
                for (int bit = kind.bits; bit-- > 0;)
                    bits.push_back((sample(kind, x, y, channel) >> bit & 1) ? '1' : '0');
        bits.resize((bits.size() + 7) / 8 * 8, '0');
        for (std::size_t i = 0; i < bits.size(); i += 8)
            rows.push_back(static_cast<char>(std::stoi(bits.substr(i, 8), nullptr, 2)));
    }
    return rows;
}

/// A PNG with the samples of sample(); interlaced as Adam7.
std::string sampled_png(const PngKind& kind, std::uint32_t width, std::uint32_t height, bool interlaced) {
    std::string rows;
    if (interlaced) {
        constexpr std::uint32_t passes[7][4] = {{0, 0, 8, 8}, {4, 0, 8, 8}, {0, 4, 4, 8}, {2, 0, 4, 4},
                                                {0, 2, 2, 4}, {1, 0, 2, 2}, {0, 1, 1, 2}};
        for (const auto& pass : passes)
            rows += rows_of(kind, width, height, pass[0], pass[1], pass[2], pass[3]);
    } else {
        rows = rows_of(kind, width, height, 0, 0, 1, 1);
    }
    return png_file(width, height, kind.bits, kind.color_type, rows,
                    kind.color_type == 3 ? palette_of(kind) : "", interlaced);
}

/// The pixel of sampled_png() in RGBA with 8 bits.
Bytes expected_pixel(const PngKind& kind, std::uint32_t x, std::uint32_t y) {
    const auto value = [&](int channel) {
        const double top = (1 << kind.bits) - 1;
        return static_cast<std::uint8_t>(std::floor(sample(kind, x, y, channel) / top * 255 + 0.5));
    };
    if (kind.color_type == 3) {
        const auto index = sample(kind, x, y, 0);
        return {static_cast<std::uint8_t>(index), static_cast<std::uint8_t>(255 - index),
                static_cast<std::uint8_t>(7 * index), 255};
    }
    if (kind.channels < 3)
        return {value(0), value(0), value(0), kind.channels == 2 ? value(1) : std::uint8_t{255}};
    return {value(0), value(1), value(2), kind.channels == 4 ? value(3) : std::uint8_t{255}};
}

/// An arbitrary number.
std::uint32_t noise(std::uint32_t x, std::uint32_t y) {
    std::uint32_t mixed = (x + 1000 * y + 1) * 2654435761u;
    mixed = (mixed ^ mixed >> 15) * 2246822519u;
    return mixed >> 13;
}

/// The chunk types of a PNG, separated by spaces.
std::string chunk_types(const Image& image) {
    std::string types;
    for (std::size_t at = 8; at + 12 <= image.encoded.size();) {
        const std::uint8_t* const p = &image.encoded[at];
        types += std::string(types.empty() ? "" : " ") + std::string(p + 4, p + 8);
        at += std::size_t{12} + (std::size_t{p[0]} << 24 | p[1] << 16 | p[2] << 8 | p[3]);
    }
    return types;
}

int color_type(const Image& image) { return image.encoded.at(25); }

/// Checks that decoding gives the encoded pixels again. Returns the PNG.
Image checked_png(const Pixels& pixels) {
    const Image image = encode_png(pixels, "x");
    CHECK(image.name == "x");
    CHECK(image.mime_type == "image/png");
    const Pixels back = decode(image);
    CHECK(back.width == pixels.width);
    CHECK(back.height == pixels.height);
    CHECK(back.rgba == pixels.rgba);
    CHECK(encode_png(pixels, "x").encoded == image.encoded);
    return image;
}

/// Pixels whose channels are functions of the position.
Pixels drawn(std::uint32_t width, std::uint32_t height,
             const std::function<std::array<std::uint32_t, 4>(std::uint32_t, std::uint32_t)>& pixel) {
    Pixels pixels{width, height, {}, true};
    for (std::uint32_t y = 0; y < height; ++y)
        for (std::uint32_t x = 0; x < width; ++x)
            for (const std::uint32_t value : pixel(x, y))
                pixels.rgba.push_back(static_cast<std::uint8_t>(value));
    return pixels;
}

}  // namespace

TEST_CASE("PNG encoding keeps all 8-bit values with and without alpha") {
    Pixels pixels{256, 1, {}, true};
    for (int i = 0; i < 256; ++i)
        for (const int value : {i, 255 - i, i, i}) pixels.rgba.push_back(static_cast<std::uint8_t>(value));
    CHECK(decode(encode_png(pixels, "")).rgba == pixels.rgba);
    for (std::size_t i = 3; i < pixels.rgba.size(); i += 4) pixels.rgba[i] = 255;
    pixels.has_alpha = false;
    const Pixels back = decode(encode_png(pixels, ""));
    CHECK(back.rgba == pixels.rgba);
    CHECK_FALSE(back.has_alpha);
}

TEST_CASE("PNG of all colour types and depths, interlaced or not, are decoded to 8-bit RGBA") {
    for (const PngKind& kind : all_kinds)
        for (const bool interlaced : {false, true})
            for (const auto& [width, height] : {std::pair{1u, 1u}, {3u, 5u}, {19u, 11u}}) {
                INFO(kind.color_type << " " << kind.bits << " " << interlaced << " " << width);
                const Pixels pixels = decode(image_x(sampled_png(kind, width, height, interlaced)));
                Bytes expected;
                for (std::uint32_t y = 0; y < height; ++y)
                    for (std::uint32_t x = 0; x < width; ++x)
                        for (const std::uint8_t value : expected_pixel(kind, x, y)) expected.push_back(value);
                REQUIRE(pixels.width == width);
                REQUIRE(pixels.height == height);
                CHECK(pixels.rgba == expected);
            }
}

TEST_CASE("a transparent colour of a PNG is compared with all bits") {
    const std::string rows = bytes_of_hex("00123412351234");
    const Pixels pixels =
        decode(image_x(png_file(3, 1, 16, 0, rows, png_chunk("tRNS", bytes_of_hex("1234")))));
    CHECK(pixels.rgba == Bytes{18, 18, 18, 0, 18, 18, 18, 255, 18, 18, 18, 0});
    CHECK(pixels.has_alpha);
    const std::string rgb = bytes_of_hex("00010203010204");
    CHECK(decode(image_x(png_file(2, 1, 8, 2, rgb, png_chunk("tRNS", bytes_of_hex("000100020003"))))).rgba ==
          Bytes{1, 2, 3, 0, 1, 2, 4, 255});
}

TEST_CASE("metadata of a PNG is skipped, whatever its size, and gamma") {
    const std::string pixels = bytes_of_hex("0064c8fa80");
    const std::string text = png_chunk("zTXt", std::string("a\0\0", 3) + zlib_stored(std::string(1000, 'x')));
    const std::string metadata = text + png_chunk("tEXt", "a") + png_chunk("iTXt", "b") +
                                 png_chunk("iCCP", "c") + png_chunk("eXIf", std::string(9'000'000, 'M')) +
                                 png_chunk("prVt", std::string(9'000'000, 'p')) +
                                 png_chunk("gAMA", big_endian(100000));
    CHECK(decode(image_x(png_file(1, 1, 8, 6, pixels, metadata))).rgba == Bytes{0x64, 0xc8, 0xfa, 0x80});
    const std::string cut = png_file(1, 1, 8, 6, pixels, text);
    CHECK_THROWS_AS(decode(image_x(cut.substr(0, cut.find("zTXt") + 100))), InputError);
}

TEST_CASE("a PNG with damaged transparency is rejected") {
    std::string bad = png_file(1, 1, 8, 0, bytes_of_hex("0040"), png_chunk("tRNS", bytes_of_hex("0040")));
    bad[bad.find("tRNS") + 5] ^= 1;
    CHECK(contains(message_of<InputError>([&] { decode(image_x(bad)); }), "image 'x': is damaged: tRNS"));
}

TEST_CASE("the message of a damaged PNG names the image and the damage") {
    const std::string good = png_file(1, 1, 8, 6, bytes_of_hex("0064c8fa80"));
    std::string bad = good;
    bad[good.find("IDAT") + 8] ^= 1;
    CHECK(contains(message_of<InputError>([&] { decode(image_x(bad)); }), "image 'x': is damaged: IDAT"));
    CHECK(contains(message_of<InputError>([&] { decode(image_x(good.substr(0, good.size() - 20))); }),
                   "image 'x': is damaged: it is cut short"));
    for (std::size_t size = 0; size < good.size() - 16; ++size)
        CHECK_THROWS_AS(decode(image_x(good.substr(0, size))), InputError);
}

TEST_CASE("PNG encoding stores the channels that are needed, and nothing else") {
    const Image grey = checked_png(drawn(40, 30, [&](auto x, auto y) {
        return std::array{noise(x, y), noise(x, y), noise(x, y), 255u};
    }));
    CHECK(color_type(grey) == 0);
    CHECK(color_type(checked_png(drawn(40, 30, [&](auto x, auto y) {
              return std::array{noise(x, y), noise(x, y), noise(x, y), noise(y, x)};
          }))) == 4);
    CHECK(color_type(checked_png(drawn(40, 30, [&](auto x, auto y) {
              return std::array{noise(x, y), noise(y, x), x, 255u};
          }))) == 2);
    CHECK(color_type(checked_png(drawn(40, 30, [&](auto x, auto y) {
              return std::array{noise(x, y), noise(y, x), x, noise(x, x)};
          }))) == 6);
    CHECK(chunk_types(grey) == "IHDR IDAT IEND");
}

TEST_CASE("PNG encoding without alpha ignores alpha values") {
    const Pixels pixels{1, 2, {1, 2, 3, 0, 4, 5, 6, 128}, false};
    CHECK(decode(encode_png(pixels, "")).rgba == Bytes{1, 2, 3, 255, 4, 5, 6, 255});
}

TEST_CASE("PNG encoding uses a palette where it is smaller") {
    const auto colors = [&](std::uint32_t count, std::uint32_t opaque) {
        return checked_png(drawn(64, 64, [&](auto x, auto y) {
            const std::uint32_t i = y == 0 && x < count ? x : noise(x, y) % count;
            return std::array{i * 91, i * 57, i * 43 + i / 256 * 7, i < opaque ? 255u : i};
        }));
    };
    CHECK(chunk_types(colors(256, 256)) == "IHDR PLTE IDAT IEND");
    CHECK(chunk_types(colors(256, 100)) == "IHDR PLTE tRNS IDAT IEND");
    CHECK(chunk_types(colors(257, 257)) == "IHDR IDAT IEND");
    // A slope of 250 colours: filtered, all rows are equal but for the first.
    const Image slope = checked_png(drawn(64, 64, [](auto x, auto y) {
        return std::array{x + y, 2 * x + y, y, 255u};
    }));
    CHECK(color_type(slope) == 2);
}

TEST_CASE("PNG encoding chooses the filter of each row") {
    // Each row of the upper half is the one above plus 1, each column of the lower half the one before plus 1.
    const Image image = checked_png(drawn(200, 200, [](auto x, auto y) {
        const std::uint32_t along = y < 100 ? x : y, across = y < 100 ? y : x;
        return std::array{noise(along, 1) + across, noise(along, 2) + across, noise(along, 3) + across, 255u};
    }));
    CHECK(image.encoded.size() < 3000);
    for (const std::uint32_t width : {1u, 2u, 3u, 255u})
        for (const std::uint32_t height : {1u, 2u, 7u})
            checked_png(drawn(width, height, [](auto x, auto y) {
                return std::array{x * y, x * x, y * y + noise(x, y) % 4, 255 - x};
            }));
}

TEST_CASE("a PNG whose header exceeds the size limit is rejected before memory is allocated") {
    const std::string message =
        message_of<InputError>([] { decode(image_x(png_file(100000, 100000, 8, 6, ""))); });
    CHECK(contains(message, "image 'x'"));
    CHECK(contains(message, "16384"));
    CHECK(
        contains(message_of<InputError>([] { decode(image_x(png_file(16385, 1, 8, 0, ""))); }), "16385 x 1"));
}

TEST_CASE("a PNG too short for its pixels is rejected before memory is allocated") {
    const std::string message =
        message_of<InputError>([] { decode(image_x(png_file(16384, 16384, 8, 6, std::string(1000, 'x')))); });
    CHECK(contains(message, "image 'x'"));
    CHECK(contains(message, "cannot hold 16384 x 16384 pixels"));
}

TEST_CASE("values of a near-lossless PNG differ by at most the given difference, alpha by nothing") {
    for (const bool is_grey : {false, true}) {
        for (const bool has_alpha : {false, true}) {
            Pixels pixels{40, 30, {}, has_alpha};
            for (std::uint32_t i = 0; i < 1200; ++i) {
                const auto a = static_cast<std::uint8_t>(i * i * 2654435761u >> 24);
                const auto b = is_grey ? a : static_cast<std::uint8_t>(i / 40 * 8);
                const auto alpha = static_cast<std::uint8_t>(has_alpha ? 255 - i % 7 * 40 : 255);
                pixels.rgba.insert(pixels.rgba.end(), {a, b, a, alpha});
            }
            std::size_t last = detail::write_png(pixels, "page").encoded.size();
            for (const int difference : {1, 4, 20, 127}) {
                const Image image = detail::write_png(pixels, "page", difference);
                const Pixels decoded = decode(image);
                REQUIRE(decoded.rgba.size() == pixels.rgba.size());
                int largest = 0;
                for (std::size_t i = 0; i < pixels.rgba.size(); ++i) {
                    const int changed = std::abs(decoded.rgba[i] - pixels.rgba[i]);
                    if (i % 4 == 3) REQUIRE(changed == 0);
                    largest = std::max(largest, changed);
                }
                CHECK(largest <= difference);
                CHECK(largest > 0);
                CHECK(image.encoded.size() < last);
                last = image.encoded.size();
            }
        }
    }
}

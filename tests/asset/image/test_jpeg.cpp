// Decoding and encoding of JPEG.

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include "asset/image/codecs.hpp"
#include "support/catch.hpp"
#include "support/format_support.hpp"
#include "support/image_builder.hpp"

using namespace faqem;
using namespace faqem::testing;

namespace {

/// The bytes of a JPEG of one 8 x 8 block per component, all of whose coefficients are 0 but those of degree 0,
/// which are 8 * (value - 128) of each component.
std::string flat_jpeg(const std::vector<int>& values, const std::string& adobe_transform, bool progressive) {
    const auto count = static_cast<char>(values.size());
    std::string jpeg = bytes_of_hex("ffd8");
    if (!adobe_transform.empty())
        jpeg += bytes_of_hex(
            "ffee000e41646f62650064000000"
            "00" +
            adobe_transform);
    jpeg += bytes_of_hex("ffdb004300") + std::string(64, '\1');
    jpeg += progressive ? bytes_of_hex("ffc2") : bytes_of_hex("ffc0");
    jpeg += std::string("\0", 1) + static_cast<char>(8 + 3 * count) + bytes_of_hex("0800080008") + count;
    for (char i = 1; i <= count; ++i) jpeg += i + bytes_of_hex("1100");
    // The number of bits of a coefficient of degree 0 is written in 4 bits; 0 is the end of a block.
    jpeg += bytes_of_hex(
        "ffc4001f00"
        "0000000c" +
        std::string(24, '0') + "000102030405060708090a0b");
    jpeg += bytes_of_hex("ffc400141001" + std::string(32, '0'));
    jpeg += bytes_of_hex("ffda") + std::string("\0", 1) + static_cast<char>(6 + 2 * count) + count;
    for (char i = 1; i <= count; ++i) jpeg += i + bytes_of_hex("00");
    jpeg += progressive ? bytes_of_hex("000000") : bytes_of_hex("003f00");
    std::string bits;
    const auto append = [&](int number, int count_of_bits) {
        for (int bit = count_of_bits; bit-- > 0;) bits += (number >> bit & 1) ? '1' : '0';
    };
    for (const int value : values) {
        const int coefficient = 8 * (value - 128);
        const int size = std::bit_width(static_cast<unsigned>(std::abs(coefficient)));
        append(size, 4);
        append(coefficient < 0 ? coefficient + (1 << size) - 1 : coefficient, size);
        if (!progressive) bits += "0";
    }
    bits.resize((bits.size() + 7) / 8 * 8, '1');
    for (std::size_t i = 0; i < bits.size(); i += 8) {
        jpeg.push_back(static_cast<char>(std::stoi(bits.substr(i, 8), nullptr, 2)));
        if (jpeg.back() == '\xff') jpeg.push_back('\0');
    }
    return jpeg + bytes_of_hex("ffd9");
}

/// The colour of all pixels of an image of 8 x 8.
Bytes flat_color(const std::string& jpeg) {
    const Pixels pixels = decode(image_x(jpeg));
    REQUIRE(pixels.rgba.size() == 256);
    CHECK_FALSE(pixels.has_alpha);
    for (std::size_t i = 4; i < 256; ++i) REQUIRE(pixels.rgba[i] == pixels.rgba[i - 4]);
    return {pixels.rgba.begin(), pixels.rgba.begin() + 4};
}

}  // namespace

TEST_CASE("grey, colour, CMYK and YCCK JPEG are decoded, baseline and progressive") {
    for (const bool progressive : {false, true}) {
        INFO(progressive);
        CHECK(flat_color(flat_jpeg({77}, "", progressive)) == Bytes{77, 77, 77, 255});
        CHECK(flat_color(flat_jpeg({100, 128, 228}, "", progressive)) == Bytes{240, 29, 100, 255});
        CHECK(flat_color(flat_jpeg({10, 20, 200}, "00", progressive)) == Bytes{10, 20, 200, 255});
        // Inverted CMYK, and the same with the first three as YCbCr of the inverse.
        CHECK(flat_color(flat_jpeg({200, 100, 51, 204}, "00", progressive)) == Bytes{160, 80, 41, 255});
        CHECK(flat_color(flat_jpeg({155, 128, 128, 204}, "02", progressive)) == Bytes{80, 80, 80, 255});
    }
    CHECK_THROWS_AS(decode(image_x(flat_jpeg({1, 2}, "", false))), InputError);
}

TEST_CASE("a JPEG that is cut anywhere is rejected, and the message names the image") {
    const Image whole = encode_jpeg(waves(40, 24), "x", 80, Content::color);
    for (std::size_t size = 0; size < whole.encoded.size(); ++size) {
        Image cut = whole;
        cut.encoded.resize(size);
        INFO(size);
        CHECK_THROWS_AS(decode(cut), InputError);
    }
    const std::string flat = flat_jpeg({100, 128, 228}, "", true);
    CHECK(contains(message_of<InputError>([&] { decode(image_x(flat.substr(0, flat.size() - 2))); }),
                   "image 'x': is damaged: Premature end of JPEG file"));
}

TEST_CASE("JPEG encoding is close to the pixels, and closer with higher quality") {
    const Pixels pixels = waves(83, 61);
    double previous = 20;
    for (const std::uint32_t quality : {30u, 60u, 90u, 100u}) {
        const Image image = encode_jpeg(pixels, "name", quality, Content::data);
        CHECK(image.name == "name");
        CHECK(image.mime_type == "image/jpeg");
        const Pixels back = decode(image);
        CHECK(back.width == 83);
        CHECK(back.height == 61);
        const double quality_db = psnr(pixels, back);
        CHECK(quality_db > previous);
        previous = quality_db;
        CHECK(encode_jpeg(pixels, "name", quality, Content::data).encoded == image.encoded);
    }
    CHECK(previous > 48);
    CHECK(psnr(pixels, decode(encode_jpeg(pixels, "", 90, Content::color))) > 30);
}

TEST_CASE("JPEG encoding subsamples the chroma of colours below quality 90 only") {
    // Columns of red and green with the same luma, so that a chroma of half the resolution is constant.
    Pixels pixels{16, 16, {}, false};
    for (int i = 0; i < 256; ++i)
        for (const int value : {i % 2 ? 200 : 40, i % 2 ? 40 : 121, 40, 255})
            pixels.rgba.push_back(static_cast<std::uint8_t>(value));
    CHECK(psnr(pixels, decode(encode_jpeg(pixels, "", 89, Content::data))) > 30);
    CHECK(psnr(pixels, decode(encode_jpeg(pixels, "", 89, Content::color))) < 20);
    CHECK(psnr(pixels, decode(encode_jpeg(pixels, "", 90, Content::color))) > 30);
}

TEST_CASE("a JPEG of more than 65500 columns is refused") {
    CHECK(contains(message_of<WriteError>([] {
                       encode_jpeg(Pixels{65536, 1, Bytes(65536 * 4), false}, "a", 90, Content::color);
                   }),
                   "image 'a': cannot encode"));
}

TEST_CASE("JPEGs with given steps have them in both tables, rising to 2.4 times at the highest frequency") {
    const Pixels pixels{8, 8, std::vector<std::uint8_t>(256, 90), false};
    const Image image = detail::write_jpeg(pixels, "page", {.step = 20, .chroma = detail::Chroma::half});
    const std::string file(image.encoded.begin(), image.encoded.end());
    for (const char table : {'\0', '\1'}) {
        const std::size_t at = file.find(bytes_of_hex("ffdb0043") + table);
        REQUIRE(at != std::string::npos);
        CHECK(static_cast<std::uint8_t>(file[at + 5]) == 20);
        CHECK(static_cast<std::uint8_t>(file[at + 5 + 63]) == 48);
    }
}

TEST_CASE("the error of a JPEG falls with its step, and its bytes rise") {
    Pixels pixels{64, 64, {}, false};
    for (std::uint32_t i = 0; i < 64 * 64; ++i) {
        const auto value = static_cast<std::uint8_t>(i * i * 2654435761u >> 25);
        pixels.rgba.insert(pixels.rgba.end(), {value, static_cast<std::uint8_t>(255 - value), 60, 255});
    }
    double last = 1e9;
    std::size_t last_bytes = 0;
    for (const std::uint32_t step : {40u, 20u, 10u, 5u, 2u}) {
        const Image image = detail::write_jpeg(pixels, "page", {step, detail::Chroma::full});
        const Pixels decoded = decode(image);
        double sum = 0;
        for (std::size_t i = 0; i < pixels.rgba.size(); ++i) {
            const double difference = double(decoded.rgba[i]) - pixels.rgba[i];
            sum += difference * difference;
        }
        CHECK(sum < last);
        CHECK(image.encoded.size() > last_bytes);
        last = sum;
        last_bytes = image.encoded.size();
    }
}

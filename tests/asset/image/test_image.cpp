// Decoding and encoding of images.

#include <functional>

#include "asset/image/image.hpp"
#include "asset/image/image_size.hpp"
#include "asset/image/png_chunks.hpp"
#include "support/catch.hpp"
#include "support/format_support.hpp"

using namespace faqem;
using namespace faqem::testing;

namespace {

Image image_x(const std::string& bytes) { return image_of(bytes, "x"); }

std::string bytes_of_hex(const std::string& hex) {
    std::string bytes;
    for (std::size_t i = 0; i + 1 < hex.size(); i += 2)
        bytes.push_back(static_cast<char>(std::stoi(hex.substr(i, 2), nullptr, 16)));
    return bytes;
}

/// CRC-32 of PNG chunks (ISO 3309).
std::uint32_t crc(const std::string& bytes) {
    std::uint32_t sum = 0xffffffff;
    for (const char c : bytes) {
        sum ^= static_cast<unsigned char>(c);
        for (int k = 0; k < 8; ++k) sum = sum & 1 ? 0xedb88320u ^ (sum >> 1) : sum >> 1;
    }
    return ~sum;
}

std::string big_endian(std::uint32_t value) {
    std::string bytes;
    for (int shift = 24; shift >= 0; shift -= 8) bytes.push_back(static_cast<char>(value >> shift));
    return bytes;
}

std::string chunk(const std::string& type, const std::string& data) {
    return big_endian(static_cast<std::uint32_t>(data.size())) + type + data + big_endian(crc(type + data));
}

/// A zlib stream of one stored, uncompressed block (RFC 1950 and 1951).
std::string stored(const std::string& data) {
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

/// A PNG with the given rows, each of which starts with its filter byte.
std::string png(std::uint32_t width, std::uint32_t height, int bits, int color_type, const std::string& rows,
                const std::string& extra_chunks = "") {
    const std::string header = big_endian(width) + big_endian(height) + static_cast<char>(bits) +
                               static_cast<char>(color_type) + std::string(3, '\0');
    return std::string("\x89PNG\r\n\x1a\n") + chunk("IHDR", header) + extra_chunks +
           chunk("IDAT", stored(rows)) + chunk("IEND", "");
}

using Bytes = std::vector<std::uint8_t>;

}  // namespace

TEST_CASE("image formats are detected from the first bytes") {
    const auto kind = [](const std::string& bytes) { return detail::sniff_mime_type(bytes_of(bytes)); };
    CHECK(kind("\x89PNG\r\n\x1a\n") == "image/png");
    CHECK(kind("\xff\xd8\xff\xe0") == "image/jpeg");
    CHECK(kind("RIFF\1\2\3\4WEBPVP8 ") == "image/webp");
    CHECK(kind("\xabKTX 20\xbb\r\n\x1a\n") == "image/ktx2");
    CHECK(kind("GIF89a") == "image/gif");
    CHECK(kind("").empty());
    CHECK(kind("\x89PN").empty());
    CHECK(kind("text").empty());
}

TEST_CASE("PNG encoding is lossless, also for colours with zero alpha") {
    Pixels pixels{2, 2, {255, 0, 1, 0, 2, 3, 4, 5, 250, 128, 7, 128, 9, 10, 11, 255}, true};
    const Image image = encode_png(pixels, "name");
    CHECK(image.name == "name");
    CHECK(image.mime_type == "image/png");
    const Pixels back = decode(image);
    CHECK(back.width == 2);
    CHECK(back.height == 2);
    CHECK(back.has_alpha);
    CHECK(back.rgba == pixels.rgba);
}

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

TEST_CASE("PNG encoding is deterministic and writes no metadata") {
    const Pixels pixels{1, 1, {1, 2, 3, 255}, false};
    const Image image = encode_png(pixels, "");
    const std::string bytes(image.encoded.begin(), image.encoded.end());
    for (const char* type : {"tIME", "tEXt", "iTXt", "zTXt", "gAMA"}) CHECK_FALSE(contains(bytes, type));
    CHECK(bytes.substr(12, 4) == "IHDR");
    CHECK(bytes[25] == 2);  // RGB without alpha
    CHECK(encode_png(pixels, "").encoded == image.encoded);
}

TEST_CASE("grey, grey with alpha, 16-bit and palette images are decoded to 8-bit RGBA") {
    CHECK(decode(image_x(png(2, 1, 8, 0,
                             bytes_of_hex("00"
                                          "40"
                                          "ff"))))
              .rgba == Bytes{0x40, 0x40, 0x40, 255, 255, 255, 255, 255});
    const Pixels grey_alpha = decode(image_x(png(1, 1, 8, 4,
                                                 bytes_of_hex("00"
                                                              "c880"))));
    CHECK(grey_alpha.rgba == Bytes{0xc8, 0xc8, 0xc8, 0x80});
    CHECK(grey_alpha.has_alpha);
    CHECK(decode(image_x(png(1, 1, 16, 2,
                             bytes_of_hex("00"
                                          "ffff"
                                          "8080"
                                          "0000"))))
              .rgba == Bytes{255, 128, 0, 255});
    const std::string palette = chunk("PLTE", bytes_of_hex("0a0b0c"
                                                           "14151e"));
    CHECK(decode(image_x(png(2, 1, 8, 3,
                             bytes_of_hex("00"
                                          "01"
                                          "00"),
                             palette)))
              .rgba == Bytes{0x14, 0x15, 0x1e, 255, 0x0a, 0x0b, 0x0c, 255});
    const Pixels keyed = decode(image_x(png(2, 1, 8, 3,
                                            bytes_of_hex("00"
                                                         "01"
                                                         "00"),
                                            palette + chunk("tRNS", bytes_of_hex("00")))));
    CHECK(keyed.rgba == Bytes{0x14, 0x15, 0x1e, 255, 0x0a, 0x0b, 0x0c, 0});
}

TEST_CASE("gamma chunks do not change the decoded colours") {
    const std::string gamma = chunk("gAMA", big_endian(100000));
    CHECK(decode(image_x(png(1, 1, 8, 6,
                             bytes_of_hex("00"
                                          "64c8fa80"),
                             gamma)))
              .rgba == Bytes{0x64, 0xc8, 0xfa, 0x80});
}

TEST_CASE("metadata of a PNG is removed before it is decoded") {
    const auto bytes = [](const std::string& text) { return Bytes(text.begin(), text.end()); };
    const std::string pixels = bytes_of_hex("0064c8fa80"), gamma = chunk("gAMA", big_endian(100000));
    const std::string text = chunk("zTXt", std::string("a\0\0", 3) + stored(std::string(1000, 'x')));
    const std::string others =
        chunk("tEXt", "a") + chunk("iTXt", "b") + chunk("eXIf", "MM") + chunk("prVt", "");
    const std::string plain = png(1, 1, 8, 6, pixels, gamma);
    const std::string with_texts = png(1, 1, 8, 6, pixels, text + gamma + others);
    CHECK(detail::without_metadata(bytes(with_texts)) == bytes(plain));
    CHECK(detail::without_metadata(bytes(plain)).empty());
    CHECK(decode(image_x(with_texts)).rgba == decode(image_x(plain)).rgba);
    // Everything after a damaged chunk is left to the decoder.
    const std::string cut = with_texts.substr(0, with_texts.find("zTXt") + 100);
    CHECK(detail::without_metadata(bytes(cut)).empty());
    CHECK_THROWS_AS(decode(image_x(cut)), InputError);
    for (std::size_t size = 0; size < with_texts.size(); ++size)
        detail::without_metadata(bytes(with_texts.substr(0, size)));
}

TEST_CASE("the memory of an image decoder is estimated from the headers") {
    const auto memory = [](std::string bytes) {
        return detail::decoding_memory(Bytes(bytes.begin(), bytes.end())) - bytes.size();
    };
    std::string image = png(1000, 500, 16, 6, "");
    CHECK(memory(image) == 0);
    image[28] = 1;  // interlaced
    CHECK(memory(image) == 1000 * 500 * 8);
    // Headers of JPEG files of 1000 x 500 pixels with three components: baseline with one scan, baseline with
    // a scan of one component, progressive.
    const std::string frame =
                          "001108"
                          "01f403e803"
                          "012200"
                          "021100"
                          "031100",
                      rest(40, '0');
    CHECK(memory(bytes_of_hex("ffd8ffc0" + frame + "ffda000c03" + rest)) == 0);
    CHECK(memory(bytes_of_hex("ffd8ffc0" + frame + "ffda000801" + rest)) == 1000 * 500 * 6);
    CHECK(memory(bytes_of_hex("ffd8ffc2" + frame + "ffda000c03" + rest)) == 1000 * 500 * 6);
    CHECK(detail::decoding_memory(Bytes(100, 'x')) == 0);
    CHECK(detail::decoding_memory({}) == 0);
}

TEST_CASE("a PNG whose header exceeds the size limit is rejected before memory is allocated") {
    const std::string message =
        message_of<InputError>([] { decode(image_x(png(100000, 100000, 8, 6, ""))); });
    CHECK(contains(message, "image 'x'"));
    CHECK(contains(message, "16384"));
    CHECK(contains(message_of<InputError>([] { decode(image_x(png(16385, 1, 8, 0, ""))); }), "16385 x 1"));
}

TEST_CASE("a PNG too short for its pixels is rejected before memory is allocated") {
    const std::string message =
        message_of<InputError>([] { decode(image_x(png(16384, 16384, 8, 6, std::string(1000, 'x')))); });
    CHECK(contains(message, "image 'x'"));
    CHECK(contains(message, "cannot hold 16384 x 16384 pixels"));
}

TEST_CASE("a JPEG or WebP too short for its pixels is rejected before memory is allocated") {
    // A JPEG up to its first frame header, which is all that is read.
    const auto jpeg = [](const std::string& size) {
        return bytes_of_hex(
                   "ffd8"
                   "fffe0004ffc0"
                   "00ffc0000b08" +
                   size + "01011100") +
               std::string(100, '\0');
    };
    const auto refused = [](const std::string& bytes) {
        return message_of<InputError>([&] { decode(image_x(bytes)); });
    };
    CHECK(contains(refused(jpeg("40003fff")), "image 'x': is damaged: 122 bytes cannot hold 16383 x 16384"));
    CHECK(contains(refused(jpeg("4001"
                                "0001")),
                   "is 1 x 16385 pixels, at most 16384 x 16384"));
    CHECK(contains(refused(jpeg("0000"
                                "0001")),
                   "is 1 x 0 pixels"));
    CHECK(contains(refused("\xff\xd8\xff\xe0"), "has no image size"));
    if (!detail::can_decode_image("image/webp")) return;
    const auto webp = [](const std::string& chunk) {
        return "RIFF" + std::string(4, '\x7f') + "WEBP" + chunk + std::string(4, '\0');
    };
    // A lossless image of 16384 x 16384, a lossy one of 16383 x 16383, and a canvas of 16383 x 16777216
    // pixels.
    CHECK(contains(refused(webp("VP8L" + bytes_of_hex("0d0000002fffffff0f") + std::string(9, '\0'))),
                   "cannot hold 16384 x 16384"));
    CHECK(contains(refused(webp("VP8 " + bytes_of_hex("0d0000000000009d012aff3fff3f"))),
                   "cannot hold 16383 x 16383"));
    CHECK(contains(refused(webp("VP8X" + bytes_of_hex("0a00000010000000fe3f00ffffff"))),
                   "is 16383 x 16777216 pixels"));
    CHECK(contains(refused(webp("JUNK" + std::string(20, '\0'))), "has no image size"));
}

TEST_CASE("damaged images are rejected") {
    const Image whole = encode_png(Pixels{64, 64, Bytes(64 * 64 * 4, 77), true}, "x");
    for (const std::size_t size : {std::size_t{8}, std::size_t{20}, whole.encoded.size() / 2}) {
        Image cut = whole;
        cut.encoded.resize(size);
        INFO(size);
        CHECK(message_of<InputError>([&] { decode(cut); }) != "(nothing thrown)");
    }
    Image flipped = whole;
    flipped.encoded[flipped.encoded.size() / 2] ^= 0xff;
    CHECK(message_of<InputError>([&] { decode(flipped); }) != "(nothing thrown)");
}

TEST_CASE("unsupported image formats are rejected with their name") {
    if (detail::can_decode_image("image/webp"))
        CHECK_THROWS_AS(decode(image_x("RIFF1234WEBPVP8 ")), InputError);
    else
        CHECK(contains(message_of<UnsupportedError>([] { decode(image_x("RIFF1234WEBPVP8 ")); }),
                       "image/webp"));
    CHECK(contains(message_of<UnsupportedError>([] { decode(image_x("\xabKTX 20\xbb\r\n\x1a\n")); }),
                   "image/ktx2"));
    CHECK(contains(message_of<UnsupportedError>([] { decode(image_x("")); }), "has an unknown format"));
}

TEST_CASE("pixel arrays that do not match the image size are rejected") {
    CHECK_THROWS_AS(encode_png(Pixels{2, 2, Bytes(12), false}, ""), InputError);
    CHECK_THROWS_AS(encode_png(Pixels{}, ""), InputError);
}

TEST_CASE("encoding and decoding an image can be cancelled between bands of rows") {
    Pixels pixels{600, 300, {}, false};
    for (std::uint32_t i = 0; i < pixels.width * pixels.height; ++i) {
        for (const std::uint32_t value : {i % 251, i / 7 % 256, i * i % 256, 255u})
            pixels.rgba.push_back(static_cast<std::uint8_t>(value));
    }
    const Image png = encode_png(pixels, "x"), jpeg = encode_jpeg(pixels, "x", 90, Content::color);
    const std::function<bool(engine::CancellationCheck)> works[] = {
        [&](engine::CancellationCheck check_cancelled) {
            return detail::encode_png(pixels, "x", check_cancelled).encoded == png.encoded;
        },
        [&](engine::CancellationCheck check_cancelled) {
            return detail::encode_jpeg(pixels, "x", 90, Content::color, check_cancelled).encoded ==
                   jpeg.encoded;
        },
        [&](engine::CancellationCheck check_cancelled) {
            return detail::decode(png, check_cancelled).rgba == pixels.rgba;
        },
        [&](engine::CancellationCheck check_cancelled) {
            return detail::decode(jpeg, check_cancelled).width == 600;
        }};
    for (const auto& work : works) {
        int questions = 0;
        engine::ProgressMonitor count([&] { return ++questions, Continue::yes; });
        CHECK(work(engine::CancellationCheck(count)));
        CHECK(questions >= 600 * 300 / 16384);
        for (int stop = 1; stop <= questions; ++stop) {
            int calls = 0;
            engine::ProgressMonitor monitor(
                [&] { return ++calls == stop ? Continue::cancel : Continue::yes; });
            CHECK_THROWS_AS(work(engine::CancellationCheck(monitor)), engine::Cancelled);
            CHECK(calls == stop);
        }
    }
}

TEST_CASE("a JPEG is decoded, and rejected if it is truncated") {
    // A baseline JPEG of 8 x 8 pixels with the grey value 128 (all coefficients are 0). The quantisation and
    // Huffman tables have one code each.
    const std::string zeros(32, '0');
    std::string jpeg = bytes_of_hex(
        "ffd8"
        "ffdb004300");
    jpeg.append(64, '\1');
    jpeg.append(bytes_of_hex("ffc0000b080008000801011100"));
    jpeg.append(bytes_of_hex("ffc400140001" + zeros));
    jpeg.append(bytes_of_hex("ffc400141001" + zeros));
    jpeg.append(bytes_of_hex("ffda0008010100003f00"));
    // Code 0 is a DC difference of size 0, the next code 0 is the end of the block; the rest is padding with
    // ones.
    jpeg.append(
        bytes_of_hex("3f"
                     "ffd9"));
    const Pixels pixels = decode(image_x(jpeg));
    CHECK(pixels.width == 8);
    CHECK(pixels.height == 8);
    CHECK_FALSE(pixels.has_alpha);
    REQUIRE(pixels.rgba.size() == 256);
    for (std::size_t i = 0; i < 256; ++i) CHECK(pixels.rgba[i] == (i % 4 == 3 ? 255 : 128));
    CHECK(message_of<InputError>([&] { decode(image_x(jpeg.substr(0, 100))); }) != "(nothing thrown)");
    CHECK(message_of<InputError>([&] { decode(image_x(jpeg.substr(0, jpeg.size() - 3))); }) !=
          "(nothing thrown)");
}

// Decoding and encoding of images.


#include "asset/image/image.hpp"
#include "asset/image/image_size.hpp"
#include "support/catch.hpp"
#include "support/format_support.hpp"
#include "support/image_builder.hpp"

using namespace faqem;
using namespace faqem::testing;

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

TEST_CASE("the memory of an image decoder is estimated from the headers") {
    const auto memory = [](std::string bytes) {
        return detail::decoding_memory(image_x(std::string(bytes.begin(), bytes.end()))) - bytes.size();
    };
    std::string image = png_file(1000, 500, 16, 6, "");
    CHECK(memory(image) == 0);
    image[28] = 1;  // interlaced
    CHECK(memory(image) == 0);
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
    CHECK(detail::decoding_memory(image_x(std::string(100, 'x'))) == 0);
    CHECK(detail::decoding_memory(Image{}) == 0);
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

TEST_CASE("unsupported image formats are rejected with their name") {
    CHECK(contains(message_of<UnsupportedError>([] { decode(image_x("\xabKTX 20\xbb\r\n\x1a\n")); }),
                   "image/ktx2"));
    CHECK(contains(message_of<UnsupportedError>([] { decode(image_x("")); }), "has an unknown format"));
}

TEST_CASE("pixel arrays that do not match the image size are rejected") {
    CHECK_THROWS_AS(encode_png(Pixels{2, 2, Bytes(12), false}, ""), InputError);
    CHECK_THROWS_AS(encode_png(Pixels{}, ""), InputError);
}

#ifdef FAQEM_WITH_IMAGE_PLUGIN

namespace {

// Images of two pixels, (10, 20, 30) and (1, 2, 3).
const std::string bmp_hex =
    "424d3e00000000000000360000002800000002000000010000000100180000000000080000000000000000000000000000000000"
    "0000"
    "1e140a0302010000";
const std::string gif_hex = "474946383961020001008000000a141e0102032c00000000020001000002 02440a003b";
const std::string tiff_hex =
    "49492a0008000000"
    "0900000103000100000002000000010103000100000001000000020103000300 00007a000000030103000100000001000000"
    "060103000100000002000000110104000100000080000000150103000100000003000000160103000100000001000000"
    "170104000100000006000000"
    "00000000"
    "080008000800"
    "0a141e010203";

Image image_of_hex(std::string hex) {
    hex.erase(std::remove(hex.begin(), hex.end(), ' '), hex.end());
    return image_x(bytes_of_hex(hex));
}

}  // namespace

TEST_CASE("BMP, GIF and TIFF are decoded by the plugin") {
    for (const std::string& hex : {bmp_hex, gif_hex, tiff_hex}) {
        const Image image = image_of_hex(hex);
        INFO(detail::sniff_mime_type(image.encoded));
        const auto size = detail::declared_size(image);
        REQUIRE(size);
        CHECK(size->width == 2);
        CHECK(size->height == 1);
        const Pixels pixels = decode(image);
        CHECK(pixels.width == 2);
        CHECK(pixels.height == 1);
        CHECK(!pixels.has_alpha);
        CHECK(pixels.rgba == Bytes{10, 20, 30, 255, 1, 2, 3, 255});
    }
}

TEST_CASE("damaged BMP, GIF and TIFF are rejected with the name of the image") {
    for (const std::string& hex : {bmp_hex, gif_hex, tiff_hex}) {
        const Image whole = image_of_hex(hex);
        INFO(detail::sniff_mime_type(whole.encoded));
        for (std::size_t size = 4; size < whole.encoded.size(); ++size) {
            Image cut = whole;
            cut.encoded.resize(size);
            try {
                const std::size_t bytes = decode(cut).rgba.size();
                CHECK(bytes == 8);  // such as GIF without its last byte
            } catch (const InputError& error) {
                CHECK(contains(error.what(), "image 'x'"));
            }
        }
    }
}

TEST_CASE("sizes of BMP, GIF and TIFF are checked before they are decoded") {
    Image bmp = image_of_hex(bmp_hex), gif = image_of_hex(gif_hex), tiff = image_of_hex(tiff_hex);
    const auto set = [](Image& image, std::size_t at, std::uint32_t value) {
        for (std::size_t i = 0; i < 2; ++i)
            image.encoded[at + i] = static_cast<std::uint8_t>(value >> (8 * i));
    };
    const auto error = [](const Image& image) { return message_of<InputError>([&] { decode(image); }); };
    set(bmp, 18, 1000), set(bmp, 22, 1000);
    CHECK(contains(error(bmp), "62 bytes cannot hold 1000 x 1000 pixels"));
    bmp.encoded[25] = 0xff, bmp.encoded[24] = 0xff, set(bmp, 22, 0xffff);  // height -1: from top to bottom
    CHECK(detail::declared_size(bmp)->height == 1);
    set(gif, 6, 16000), set(gif, 8, 16000);
    CHECK(contains(error(gif), "cannot hold 16000 x 16000 pixels"));
    set(gif, 6, 20000);
    CHECK(contains(error(gif), "is 20000 x 16000 pixels, at most"));
    set(tiff, 18, 20000);
    CHECK(contains(error(tiff), "is 20000 x 1 pixels, at most"));
    set(tiff, 18, 0);
    CHECK(contains(error(tiff), "is 0 x 1 pixels"));
    set(tiff, 4, 200);  // a directory after the end
    CHECK(contains(error(tiff), "its header has no image size"));
    set(tiff, 4, 8), set(tiff, 8, 60000);  // too many entries
    CHECK(contains(error(tiff), "its header has no image size"));
}

TEST_CASE("an unused fourth channel of TGA does not hide the image") {
    Image image = image_x(bytes_of_hex("0000020000000000000000000200010020081e140a0003020100"));
    image.mime_type = "image/x-tga";
    const Pixels pixels = decode(image);
    CHECK(!pixels.has_alpha);
    CHECK(pixels.rgba == Bytes{10, 20, 30, 255, 1, 2, 3, 255});
}

TEST_CASE("images of kinds that glTF does not have are written as PNG") {
    const TemporaryFolder folder;
    Asset asset = one_part({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}, {{0, 1, 2}});
    asset.parts[0].face_material = {0};
    asset.parts[0].uvs = {{{0, 0}, {1, 0}, {1, 1}}};
    asset.materials.resize(1);
    asset.materials[0].base_color_texture.image = 0;
    asset.images = {image_of_hex(bmp_hex)};
    asset.images[0].mime_type = "image/bmp";
    save(asset, folder / "a.glb");
    const Asset back = load(folder / "a.glb");
    CHECK(back.images.at(0).mime_type == "image/png");
    CHECK(decode(back.images[0]).rgba == Bytes{10, 20, 30, 255, 1, 2, 3, 255});
    save(asset, folder / "a.obj");  // which names files of any kind
    CHECK(load(folder / "a.obj").images.at(0).encoded == asset.images[0].encoded);
}

TEST_CASE("a TGA is decoded by the plugin, if its media type says so") {
    // Two pixels of blue, green, red and alpha, the first one at the lower left.
    Image image =
        image_x(bytes_of_hex("000002000000000000000000020001002008"
                             "1e140a80"
                             "030201ff"));
    for (const char* type : {"image/x-tga", "image/tga"}) {
        image.mime_type = type;
        const Pixels pixels = decode(image);
        CHECK(pixels.width == 2);
        CHECK(pixels.height == 1);
        CHECK(pixels.has_alpha);
        CHECK(pixels.rgba == Bytes{10, 20, 30, 128, 1, 2, 3, 255});
    }
    Image other = image;
    other.mime_type = "image/png";
    CHECK(contains(message_of<UnsupportedError>([&] { decode(other); }), "has an unknown format"));
    Image cut = image;
    cut.encoded.resize(20);
    CHECK(contains(message_of<InputError>([&] { decode(cut); }), "image 'x': "));
    Image large = image;
    for (const std::size_t at : {12, 14}) large.encoded[at] = 0, large.encoded[at + 1] = 0x40;
    CHECK(contains(message_of<InputError>([&] { decode(large); }), "26 bytes cannot hold 16384 x 16384"));
    large.encoded[15] = 0x41;
    CHECK(contains(message_of<InputError>([&] { decode(large); }), "is 16384 x 16640 pixels, at most"));
    const Image png = encode_png(Pixels{1, 1, {1, 2, 3, 4}, true}, "");
    CHECK(decode({"", "image/tga", png.encoded, ""}).rgba == Bytes{1, 2, 3, 4});
}

#endif

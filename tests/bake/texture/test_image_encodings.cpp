// Ways to encode an image, among which the search for a byte limit chooses.

#include "bake/texture/pending_images.hpp"

#include <cmath>
#include <memory>

#include "support/catch.hpp"
#include "support/scenes.hpp"

using namespace faqem;
using namespace faqem::detail;
using namespace faqem::test;

namespace {

using Codec = ImageEncoding::Codec;

PendingImage pending_image(Pixels pixels) {
    PendingImage result;
    result.known = std::make_shared<const std::vector<std::uint8_t>>(
        std::size_t{pixels.width} * pixels.height, std::uint8_t{1});
    result.pixels = std::move(pixels);
    result.name = "painted";
    return result;
}

Pixels smooth_colors(std::uint8_t alpha = 255) {
    return paint(64, 64, [&](std::uint32_t x, std::uint32_t y) {
        return Rgba{static_cast<std::uint8_t>(4 * x), static_cast<std::uint8_t>(4 * y),
                    static_cast<std::uint8_t>(128 + 100 * std::sin(0.2 * x) * std::cos(0.3 * y)), alpha};
    });
}

BakeOptions with_format(ImageFormat format) {
    BakeOptions result;
    result.image_format = format;
    return result;
}

bool has_codec(const std::vector<ImageEncoding>& encodings, Codec codec) {
    for (const ImageEncoding& encoding : encodings)
        if (encoding.codec == codec) return true;
    return false;
}

}  // namespace

TEST_CASE("encodings of higher fineness have more bytes and a smaller difference") {
    const PendingImage pending = pending_image(smooth_colors());
    for (const ImageFormat format : {ImageFormat::webp, ImageFormat::png_or_jpeg}) {
        const BakeOptions bake = with_format(format);
        const Codec codec = format == ImageFormat::webp ? Codec::webp : Codec::jpeg;
        std::size_t last_bytes = 0;
        double last_difference = 1;
        for (const ImageEncoding& encoding : image_encodings(pending, bake)) {
            if (encoding.codec != codec || encoding.fineness % fineness_step != 0) continue;
            CAPTURE(encoding.fineness, encoding.level);
            const Image image = encode_as(pending, bake, encoding);
            const double difference = mean_square_error(pending, image);
            CHECK(image.encoded.size() > last_bytes);
            CHECK(difference < last_difference);
            last_bytes = image.encoded.size();
            last_difference = difference;
        }
        CHECK(last_difference < 1e-4);
        CHECK(last_difference > 0);
    }
}

TEST_CASE("encodings are those that the image format allows") {
    PendingImage pending = pending_image(smooth_colors());
    const auto codecs = [&](ImageFormat format) { return image_encodings(pending, with_format(format)); };
    CHECK_FALSE(has_codec(codecs(ImageFormat::png_or_jpeg), Codec::webp));
    CHECK_FALSE(has_codec(codecs(ImageFormat::webp), Codec::jpeg));
    CHECK(codecs(ImageFormat::webp).back().codec == Codec::near_lossless_webp);
    CHECK_FALSE(has_codec(codecs(ImageFormat::automatic), Codec::webp));
    pending.tries_webp = true;
    CHECK(has_codec(codecs(ImageFormat::automatic), Codec::webp));
    CHECK(has_codec(codecs(ImageFormat::automatic), Codec::jpeg));

    const std::vector<ImageEncoding> only_png = codecs(ImageFormat::png);
    REQUIRE(only_png.size() == 1);
    CHECK(encode_as(pending, with_format(ImageFormat::png), only_png[0]).mime_type == "image/png");

    pending = pending_image(smooth_colors(100));
    pending.pixels.has_alpha = true;
    CHECK_FALSE(has_codec(codecs(ImageFormat::png_or_jpeg), Codec::jpeg));
    for (const ImageEncoding& encoding : codecs(ImageFormat::png_or_jpeg))
        CHECK(decode(encode_as(pending, with_format(ImageFormat::png_or_jpeg), encoding)).rgba[3] == 100);
}

TEST_CASE("images of few colours have lossless encodings, and those of the source stay as they are") {
    PendingImage pending = pending_image(paint(32, 32, [](std::uint32_t x, std::uint32_t) {
        return x < 16 ? Rgba{255, 0, 0, 255} : Rgba{0, 0, 255, 255};
    }));
    const BakeOptions webp = with_format(ImageFormat::webp);
    bool has_lossless = false;
    for (const ImageEncoding& encoding : image_encodings(pending, webp)) {
        if (encoding.codec != Codec::lossless_webp) continue;
        has_lossless = true;
        CHECK(mean_square_error(pending, encode_as(pending, webp, encoding)) == 0);
    }
    CHECK(has_lossless);
    CHECK_FALSE(has_codec(image_encodings(pending_image(smooth_colors()), webp), Codec::lossless_webp));

    pending.original = encode_png(pending.pixels, "original");
    CHECK_FALSE(has_codec(image_encodings(pending, webp), Codec::original));
    const BakeOptions automatic = with_format(ImageFormat::automatic);
    const std::vector<ImageEncoding> encodings = image_encodings(pending, automatic);
    CHECK(has_codec(encodings, Codec::original));
    for (const ImageEncoding& encoding : encodings)
        if (encoding.codec == Codec::original)
            CHECK(encode_as(pending, automatic, encoding).encoded == pending.original->encoded);
}

TEST_CASE("encodings are in ascending order of fineness, and those between have levels of their own") {
    const PendingImage pending = pending_image(smooth_colors());
    const std::vector<ImageEncoding> encodings =
        image_encodings(pending, with_format(ImageFormat::png_or_jpeg));
    for (std::size_t i = 1; i < encodings.size(); ++i) {
        CHECK(encodings[i].fineness >= encodings[i - 1].fineness);
        CHECK(encodings[i].level < encodings[i - 1].level);
    }
}

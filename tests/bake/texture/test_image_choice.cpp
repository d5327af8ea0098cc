#include "bake/texture/image_choice.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "bake/texture/pending_images.hpp"
#include "support/catch.hpp"
#include "support/scenes.hpp"

using namespace faqem;
using namespace faqem::detail;
using namespace faqem::test;

namespace {

std::vector<std::uint8_t> all_known(const Pixels& pixels) {
    return std::vector<std::uint8_t>(std::size_t{pixels.width} * pixels.height, 1);
}

// Waves with some noise, as in photographs.
Pixels waves(std::uint32_t size) {
    std::uint32_t state = 1;
    return paint(size, size, [&](std::uint32_t x, std::uint32_t y) {
        state = state * 1664525u + 1013904223u;
        const double wave = 128 + 60 * std::sin(x / 5.0) * std::cos(y / 7.0);
        const auto c = static_cast<std::uint8_t>(wave + static_cast<double>(state >> 29));
        return Rgba{c, c, c, 255};
    });
}

// Values without correlation between texels.
Pixels noise(std::uint32_t size) {
    std::uint32_t state = 1;
    return paint(size, size, [&](std::uint32_t, std::uint32_t) {
        Rgba texel = {0, 0, 0, 255};
        for (std::size_t k = 0; k < 3; ++k) {
            state = state * 1664525u + 1013904223u;
            texel[k] = static_cast<std::uint8_t>(state >> 24);
        }
        return texel;
    });
}

// The mean of 2 x 2 texels.
Pixels blurred(const Pixels& pixels) {
    return paint(pixels.width, pixels.height, [&](std::uint32_t x, std::uint32_t y) {
        Rgba texel{0, 0, 0, 255};
        for (std::size_t k = 0; k < 3; ++k) {
            unsigned sum = 0;
            for (const std::uint32_t i : {x, (x + 1) % pixels.width})
                for (const std::uint32_t j : {y, (y + 1) % pixels.height})
                    sum += pixels.rgba[4 * (std::size_t{j} * pixels.width + i) + k];
            texel[k] = static_cast<std::uint8_t>(sum / 4);
        }
        return texel;
    });
}

ImageQuality quality_of(double whole) { return {whole, whole - 15}; }

Image smallest(const Pixels& pixels, double quality, bool may_shrink = true) {
    return encode_smallest(pixels, all_known(pixels), "page", Content::color,
                           {quality_of(quality), may_shrink});
}

}  // namespace

TEST_CASE("psnr: ten decibels for each factor of ten, infinity or the limit without a difference") {
    CHECK(psnr(1) == Approx(0).margin(1e-12));
    CHECK(psnr(1e-4) == Approx(40));
    CHECK(psnr(0) == std::numeric_limits<double>::infinity());
    CHECK(psnr(0, 1e-5) == Approx(50));
    CHECK(mean_square_of(40) == Approx(1e-4));
}

TEST_CASE("the shown PSNR is that of the differences at known texels") {
    const Pixels gray = paint(4, 4, [](std::uint32_t, std::uint32_t) { return Rgba{100, 100, 100, 255}; });
    Pixels other = gray;
    CHECK(shown_quality(gray, other, all_known(gray)).whole == std::numeric_limits<double>::infinity());
    for (std::size_t i = 0; i < other.rgba.size(); ++i) other.rgba[i] = static_cast<std::uint8_t>(110);
    CHECK(shown_quality(gray, other, all_known(gray)).whole == Approx(20 * std::log10(255.0 / 10)));
    std::vector<std::uint8_t> first_only(16, 0);
    first_only[0] = 1;
    other = gray;
    other.rgba[4] = 0;  // the second texel
    CHECK(std::isinf(shown_quality(gray, other, first_only).whole));
}

TEST_CASE("an error in one block is not within a limit that the whole image meets") {
    const Pixels gray = paint(128, 128, [](std::uint32_t, std::uint32_t) {
        return Rgba{100, 100, 100, 255};
    });
    Pixels other = gray;
    for (std::size_t x = 0; x < 8; ++x) other.rgba[4 * x] = 200;
    const ImageQuality shown = shown_quality(gray, other, all_known(gray));
    CHECK(shown.whole == Approx(10 * std::log10(255.0 * 255 * 3 * 128 * 128 / (8 * 100 * 100))));
    CHECK(shown.block == Approx(10 * std::log10(255.0 * 255 * 3 * 64 / (8 * 100 * 100))));
    CHECK_FALSE(is_within(shown, quality_of(40)));
    CHECK(is_within(shown, quality_of(shown.block + 9)));
}

TEST_CASE("an image with fewer texels is interpolated bilinearly") {
    // A linear ramp is reproduced by its halved image, except at the two borders.
    const Pixels ramp_x = paint(64, 64, [](std::uint32_t x, std::uint32_t) {
        const auto c = static_cast<std::uint8_t>(4 * x);
        return Rgba{c, c, c, 255};
    });
    const Pixels half = halved(ramp_x);
    CHECK(half.width == 32);
    CHECK(half.rgba[0] == 2);  // between 0 and 4
    std::vector<std::uint8_t> inner = all_known(ramp_x);
    for (std::size_t y = 0; y < 64; ++y) inner[64 * y] = inner[64 * y + 63] = 0;
    CHECK(std::isinf(shown_quality(ramp_x, half, inner).whole));
    // At the left border of a repeated image, the right one adds a quarter: 0.75 * 2 + 0.25 * 250.
    std::vector<std::uint8_t> left(64 * 64, 0);
    left[64] = 1;
    CHECK(shown_quality(ramp_x, half, left).whole > 40);
    CHECK(shown_quality(ramp_x, half, left, {true, false}).whole == Approx(20 * std::log10(255.0 / 64)));
}

TEST_CASE("colours of transparent texels do not count") {
    const Pixels clear = paint(4, 4, [](std::uint32_t, std::uint32_t) { return Rgba{100, 100, 100, 0}; });
    Pixels other = clear;
    other.rgba[0] = 255;
    CHECK(std::isinf(shown_quality(clear, other, all_known(clear)).whole));
    other.rgba[3] = 255;
    CHECK(shown_quality(clear, other, all_known(clear)).whole < 40);
}

TEST_CASE("chosen images are within the limit at any quality and content") {
    const double quality = GENERATE(25.0, 34.0, 40.0, 48.0, 80.0);
    for (const Pixels& pixels : {ramp(128), noise(64), waves(64)}) {
        const Image image = smallest(pixels, quality);
        CHECK(is_within(shown_quality(pixels, decode(image), all_known(pixels)), quality_of(quality)));
        CHECK(image.encoded.size() <= encode_png(pixels, "page").encoded.size());
        CHECK(image.name == "page");
    }
}

TEST_CASE("smooth images get fewer texels, and detail keeps them") {
    const Pixels smooth = decode(smallest(ramp(256), 40));
    CHECK(smooth.width <= 64);
    CHECK(smooth.height == smooth.width);
    CHECK(decode(smallest(noise(64), 40)).width == 64);
    CHECK(decode(smallest(ramp(256), 40, false)).width == 256);
}

TEST_CASE("images with alpha, and images with few colours, stay PNG") {
    Pixels glass = ramp(64);
    for (std::size_t i = 3; i < glass.rgba.size(); i += 8) glass.rgba[i] = 128;
    glass.has_alpha = true;
    CHECK(smallest(glass, 40).mime_type == "image/png");
    const Pixels stripes = paint(64, 64, [](std::uint32_t x, std::uint32_t) {
        const std::uint8_t c = x % 2 ? 255 : 0;
        return Rgba{c, 0, 0, 255};
    });
    CHECK(smallest(stripes, 40).mime_type == "image/png");
    CHECK(smallest(waves(64), 36, false).mime_type == "image/jpeg");
    CHECK(smallest(waves(64), 80, false).mime_type == "image/png");
}

TEST_CASE("normals of rough surfaces may be as inexact as data, those of glossy ones only as colours") {
    const auto least = [](const BakeOptions& bake, TextureContent content, double roughness) {
        return least_quality(bake, content, roughness).whole;
    };
    const BakeOptions usual;
    CHECK(least(usual, TextureContent::color, 1) == 40);
    CHECK(least(usual, TextureContent::data, 0) == 36);
    CHECK(least(usual, TextureContent::normal, 0) == 40);
    CHECK(least(usual, TextureContent::normal, 1) == 36);
    CHECK(least({.image_quality = 32}, TextureContent::normal, 1) == 30);
    CHECK(least({.image_quality = 25}, TextureContent::normal, 1) == 25);
}

TEST_CASE("images are better where pictures show it, unless a quality was asked for") {
    using enum TextureContent;
    const auto change = [](double unlit, double lit, TextureContent content) {
        const auto difference = [](double psnr) { return mean_square_of(psnr) - invisible_difference; };
        return quality_change(PictureDifference{difference(unlit), difference(lit)}, content);
    };
    CHECK(quality_change({}, color) == 0);
    CHECK(change(20, 20, color) == -2);
    CHECK(change(33, 20, color) == Approx(1));
    CHECK(change(20, 33, color) == Approx(1));
    CHECK(change(50, 20, data) == -2);
    CHECK(change(20, 50, normal) == 4);
    const ImageQuality worse = least_quality({}, color, 1, -2);
    CHECK(worse.whole == 38);
    CHECK(worse.block == 25);  // details stay
    CHECK(least_quality({.image_quality = 40}, color, 1, -2).whole == 40);
}

TEST_CASE("images with alpha are PNGs within the limit, smaller than lossless ones, with alpha as it was") {
    Pixels leaf = waves(64);
    for (std::size_t i = 3; i < leaf.rgba.size(); i += 4) leaf.rgba[i] = i % 64 < 24 ? 0 : 255;
    leaf.has_alpha = true;
    std::size_t last = encode_png(leaf, "page").encoded.size();
    for (const double quality : {60.0, 45.0, 40.0, 35.0}) {
        const Image image = smallest(leaf, quality, false);
        CHECK(image.mime_type == "image/png");
        const Pixels decoded = decode(image);
        CHECK(is_within(shown_quality(leaf, decoded, all_known(leaf)), quality_of(quality)));
        for (std::size_t i = 3; i < leaf.rgba.size(); i += 4) REQUIRE(decoded.rgba[i] == leaf.rgba[i]);
        CHECK(image.encoded.size() <= last);
        last = image.encoded.size();
    }
    CHECK(last < encode_png(leaf, "page").encoded.size() / 2);
}

TEST_CASE("WebP images are within the limit, with alpha as it was") {
    const Pixels glass = paint(64, 64, [](std::uint32_t x, std::uint32_t y) {
        return Rgba{static_cast<std::uint8_t>(3 * x), static_cast<std::uint8_t>(2 * x + y), 90,
                    static_cast<std::uint8_t>(255 - 2 * x)};
    });
    for (const Pixels& pixels : {noise(64), glass, ramp(64)}) {
        for (const Content content : {Content::color, Content::data}) {
            for (const double quality : {25.0, 40.0, 60.0}) {
                const ImageLimits limits{quality_of(quality), false, false, true};
                const Image webp = encode_smallest(pixels, all_known(pixels), "page", content, limits);
                CHECK(webp.mime_type == "image/webp");
                const Pixels decoded = decode(webp);
                CHECK(is_within(shown_quality(pixels, decoded, all_known(pixels)), quality_of(quality)));
                for (std::size_t i = 3; i < pixels.rgba.size(); i += 4)
                    REQUIRE(decoded.rgba[i] == pixels.rgba[i]);
                const ImageLimits both{quality_of(quality), false, true, true};
                CHECK(encode_smallest(pixels, all_known(pixels), "page", content, both).encoded.size() <=
                      webp.encoded.size());
            }
        }
    }
}

TEST_CASE("few trials of WebP find about the smallest of all qualities that are within the limit") {
    for (const Pixels& pixels : {waves(128), ramp(256), blurred(noise(64))}) {
        for (const double quality : {30.0, 36.0, 42.0}) {
            const ImageLimits limits{quality_of(quality), false, false, true};
            std::size_t smallest = std::numeric_limits<std::size_t>::max();
            for (int level = 40; level <= 100; ++level) {
                const Image image = encode_webp(pixels, "page", {.level = level});
                if (is_within(shown_quality(pixels, decode(image), all_known(pixels)), limits.quality))
                    smallest = std::min(smallest, image.encoded.size());
            }
            if (smallest == std::numeric_limits<std::size_t>::max()) continue;
            const Image found = encode_smallest(pixels, all_known(pixels), "page", Content::color, limits);
            CHECK(static_cast<double>(found.encoded.size()) <= 1.25 * static_cast<double>(smallest));
        }
    }
}

TEST_CASE("images of few colours that no lossy encoding shows well are lossless WebP") {
    const Pixels random = noise(256);
    const Pixels palette = paint(256, 256, [&](std::uint32_t x, std::uint32_t y) {
        const bool is_red = random.rgba[4 * (std::size_t{y} * 256 + x)] > 127;
        return is_red ? Rgba{200, 30, 20, 255} : Rgba{20, 60, 190, 255};
    });
    for (const bool tries_core : {false, true}) {
        const ImageLimits limits{quality_of(40), false, tries_core, true};
        const Image image = encode_smallest(palette, all_known(palette), "page", Content::color, limits);
        CHECK(decode(image).rgba == palette.rgba);
        CHECK(image.encoded.size() < 256 * 256 / 8 * 1.1);  // a bit for each texel
    }
}

TEST_CASE("automatic formats are WebP only if a glTF source has WebP images") {
    Asset asset = textured_square(paint(256, 256, [](std::uint32_t x, std::uint32_t y) {
        return Rgba{static_cast<std::uint8_t>(120 + 100 * std::sin(0.3 * x)),
                    static_cast<std::uint8_t>(120 + 100 * std::sin(0.2 * y)), 90, 255};
    }));
    Options options{.bake = {.kind = Bake::atlas}};
    const auto mime_type = [&] { return bake(asset, unchanged(asset), options).asset.images[0].mime_type; };
    asset.images[0] = encode_webp(decode(asset.images[0]), "wave", {.mode = WebpMode::lossless});
    CHECK(mime_type() != "image/webp");
    options.bake.image_format = ImageFormat::webp;
    CHECK(mime_type() == "image/webp");
}

TEST_CASE("with webp, colours are WebP, and normals are not larger than as PNG or JPEG") {
    for (const Pixels& pixels : {ramp(128), waves(64), noise(64), blurred(noise(64))}) {
        PendingImage pending{0, pixels, {}, "page"};
        pending.known = std::make_shared<const std::vector<std::uint8_t>>(all_known(pixels));
        const auto image = [&](TextureContent content, ImageFormat format) {
            pending.content = content;
            std::vector<Image> images(1);
            encode_pending_images({&pending, 1}, {.image_format = format}, {}, images);
            return images[0];
        };
        CHECK(image(TextureContent::color, ImageFormat::webp).mime_type == "image/webp");
        CHECK(image(TextureContent::normal, ImageFormat::webp).encoded.size() <=
              image(TextureContent::normal, ImageFormat::png_or_jpeg).encoded.size());
    }
}

TEST_CASE("baked images are chosen by loss unless a format, a density or a correspondence is requested") {
    const Asset asset = textured_square(ramp(256));
    const auto width = [&](const BakeOptions& bake) {
        Options options{.target = ratio(1)};
        options.bake = bake;
        options.bake.kind = Bake::atlas;
        return base_color_image(faqem::bake(asset, unchanged(asset), options).asset).width;
    };
    const std::uint32_t full = width({.image_format = ImageFormat::png});
    CHECK(width({}) < full);
    CHECK(width({.image_quality = 80}) == full);
    CHECK(width({.texel_density = 1}) >= full / 2);
    CHECK(width({.correspondence = Recording::on}) == full);
}

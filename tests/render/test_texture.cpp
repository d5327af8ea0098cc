#include "render/texture.hpp"

#include <cmath>

#include "support/catch.hpp"

using namespace faqem::render;
using Eigen::Vector2d;
using faqem::TextureRef;
using faqem::Wrap;

namespace {

/// A texture of one row of grey texels.
Texture row(const std::vector<int>& greys, ColorSpace color_space = ColorSpace::linear) {
    faqem::Pixels pixels;
    pixels.width = static_cast<std::uint32_t>(greys.size());
    pixels.height = 1;
    for (const int grey : greys) {
        for (const int byte : {grey, grey, grey, 255}) pixels.rgba.push_back(static_cast<std::uint8_t>(byte));
    }
    return make_texture(pixels, color_space);
}

double grey(const Texture& texture, double u, Wrap wrap = Wrap::repeat, double lod = 0) {
    TextureRef use;
    use.wrap_u = use.wrap_v = wrap;
    return 255 * sample(texture, use, {u, 0.5}, lod)[0];
}

}  // namespace

TEST_CASE("texels are interpolated linearly between their centres") {
    const Texture texture = row({0, 100, 200, 40});
    CHECK(grey(texture, 0.375) == Approx(100));
    CHECK(grey(texture, 0.5) == Approx(150));
    CHECK(grey(texture, 0.4375) == Approx(125));
}

TEST_CASE("texture coordinates outside the unit square follow the wrap mode") {
    const Texture texture = row({0, 100, 200, 40});
    CHECK(grey(texture, 1.375) == Approx(100));
    CHECK(grey(texture, -0.125) == Approx(40));
    CHECK(grey(texture, 1.0) == Approx(20));
    CHECK(grey(texture, 1.375, Wrap::mirror) == Approx(200));
    CHECK(grey(texture, -0.375, Wrap::mirror) == Approx(100));
    CHECK(grey(texture, 1.0, Wrap::mirror) == Approx(40));
    CHECK(grey(texture, 7, Wrap::clamp) == Approx(40));
    CHECK(grey(texture, -7, Wrap::clamp) == Approx(0).margin(1e-4));
    for (const double far : {1e300, -1e300, std::nan(""), HUGE_VAL}) CHECK(std::isfinite(grey(texture, far)));
}

TEST_CASE("nearest filtering returns the texel that contains the coordinate") {
    const Texture texture = row({0, 100, 200, 40});
    TextureRef use;
    use.filter = faqem::Filter::nearest;
    CHECK(255 * sample(texture, use, {0.51, 0.5}, 0)[0] == Approx(200));
    CHECK(255 * sample(texture, use, {0.49, 0.5}, 0)[0] == Approx(100));
}

TEST_CASE("sRGB textures are filtered in linear light and data textures without conversion") {
    const Texture colors = row({0, 255}, ColorSpace::srgb);
    CHECK(sample(colors, TextureRef{}, {0.5, 0.5}, 0)[0] == Approx(0.5));
    CHECK(sample(row({188, 188}, ColorSpace::srgb), TextureRef{}, {0.5, 0.5}, 0)[0] ==
          Approx(0.503).epsilon(0.01));
    // The next mip level is the average in linear light: the sRGB value of 0.5 is 188.
    CHECK(int(colors.levels.at(1).rgba[0]) == 188);
    CHECK(int(row({0, 255}).levels.at(1).rgba[0]) == 128);
}

TEST_CASE("mip levels are averages of the finer level and are interpolated") {
    const Texture texture = row({0, 100, 200, 40});
    REQUIRE(texture.levels.size() == 3);
    CHECK(grey(texture, 0.25, Wrap::clamp, 1) == Approx(50));
    CHECK(grey(texture, 0.75, Wrap::clamp, 1) == Approx(120));
    CHECK(grey(texture, 0.3, Wrap::clamp, 9) == Approx(85));
    CHECK(grey(texture, 0.25, Wrap::clamp, 1.5) == Approx(67.5));
}

TEST_CASE("a texture transform scales, rotates and translates as in KHR_texture_transform") {
    TextureRef use;
    use.scale = {2, 3};
    use.rotation = static_cast<float>(3.14159265358979 / 2);
    use.offset = {0.25f, 0.5f};
    // A rotation by 90 degrees maps u to -v, which points up in the image, and v to u.
    CHECK(transform_uv(use, {1, 0}).isApprox(Vector2d(0.25, 0.5 - 2), 1e-6));
    CHECK(transform_uv(use, {0, 1}).isApprox(Vector2d(0.25 + 3, 0.5), 1e-6));
}

#include "asset/image/combine.hpp"

#include <cmath>

#include "support/catch.hpp"
#include "support/scenes.hpp"

using namespace faqem;
using namespace faqem::detail;
using faqem::test::paint;
using faqem::test::Rgba;

namespace {

Pixels uniform(std::uint32_t width, std::uint32_t height, const Rgba& color) {
    return paint(width, height, [&](std::uint32_t, std::uint32_t) { return color; });
}

}  // namespace

TEST_CASE("a scalar texture is a channel, or alpha if a pixel is transparent, or luminance") {
    const Pixels opaque = uniform(2, 1, {10, 20, 30, 255}), clear = uniform(2, 1, {10, 20, 30, 40});
    const auto value = [](const Pixels& pixels, ScalarChannel channel) {
        return int(scalar_image(pixels, channel).values.at(1));
    };
    CHECK(value(opaque, ScalarChannel::red) == 10);
    CHECK(value(opaque, ScalarChannel::green) == 20);
    CHECK(value(opaque, ScalarChannel::blue) == 30);
    CHECK(value(opaque, ScalarChannel::alpha) == 255);
    CHECK(value(opaque, ScalarChannel::luminance) == 19);  // 0.2126 * 10 + 0.7152 * 20 + 0.0722 * 30 = 18.6
    CHECK(value(opaque, ScalarChannel::automatic) == 19);
    CHECK(value(clear, ScalarChannel::automatic) == 40);
    CHECK(value(uniform(2, 1, {255, 255, 255, 255}), ScalarChannel::luminance) == 255);
}

TEST_CASE("directions are told from heights and colours") {
    CHECK(is_normal_map(uniform(2, 2, {128, 128, 255, 255})));
    CHECK(is_normal_map(uniform(2, 2, {218, 128, 218, 255})));
    CHECK(!is_normal_map(uniform(2, 2, {128, 128, 128, 255})));
    CHECK(!is_normal_map(uniform(2, 2, {200, 200, 200, 255})));
    CHECK(!is_normal_map(uniform(2, 2, {150, 110, 90, 255})));   // wood
    CHECK(!is_normal_map(uniform(2, 2, {128, 255, 100, 255})));  // points inwards
    CHECK(is_grey(uniform(2, 2, {7, 7, 7, 0})));
    CHECK(!is_grey(uniform(2, 2, {7, 7, 8, 0})));
}

TEST_CASE("a mask becomes the alpha of a colour image of the larger size") {
    const Pixels color = paint(2, 1, [](std::uint32_t x, std::uint32_t) {
        return Rgba{std::uint8_t(100 * x), 0, 0, 7};
    });
    const Pixels result = with_alpha(color, {4, 2, {0, 1, 2, 3, 4, 5, 6, 255}});
    CHECK(result.width == 4);
    CHECK(result.height == 2);
    CHECK(result.has_alpha);
    for (std::size_t i = 0; i < 8; ++i) {
        CHECK(int(result.rgba[4 * i]) == std::array<int, 4>{0, 25, 75, 100}[i % 4]);
        CHECK(int(result.rgba[4 * i + 3]) == (i == 7 ? 255 : int(i)));
    }
    const Pixels small_mask = with_alpha(color, {1, 1, {9}});
    CHECK(small_mask.rgba == std::vector<std::uint8_t>{0, 0, 0, 9, 100, 0, 0, 9});
    CHECK(!with_alpha(color, {1, 1, {255}}).has_alpha);
}

TEST_CASE("roughness is stored in green and metal in blue") {
    const ScalarImage r{2, 1, {10, 20}}, m{1, 1, {30}};
    CHECK(roughness_metallic(r, m).rgba == std::vector<std::uint8_t>{255, 10, 30, 255, 255, 20, 30, 255});
    CHECK(roughness_metallic({}, m).rgba == std::vector<std::uint8_t>{255, 255, 30, 255});
    CHECK(roughness_metallic(r, {}).width == 2);
}

// h = x / 8 within a period of 8 texels, and the same in y: the slopes are those of a plane inside.
TEST_CASE("the normals of a height map are those of its slopes") {
    ScalarImage heights{8, 8, {}};
    const bool along_x = GENERATE(true, false);
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x)
            heights.values.push_back(static_cast<std::uint8_t>(16 * (along_x ? x : y)));
    const double depth = 0.5, slope = depth * 16 / 255.0 * 8, length = std::sqrt(1 + slope * slope);
    const Pixels normals = normals_of_heights(heights, depth);
    const std::uint8_t* p = &normals.rgba[4 * (3 * 8 + 3)];
    // Heights that increase downwards, against v, tilt the normal upwards.
    const std::array<double, 3> expected = {along_x ? -slope / length : 0, along_x ? 0 : slope / length,
                                            1 / length};
    for (std::size_t k = 0; k < 3; ++k) CHECK(p[k] / 127.5 - 1 == Approx(expected[k]).margin(1 / 127.5));
    CHECK(int(p[3]) == 255);
}

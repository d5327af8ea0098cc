#include <cmath>

#include "asset/image/srgb.hpp"
#include "bake/page/push_pull.hpp"
#include "render/texture_sampling.hpp"
#include "support/catch.hpp"
#include "support/scenes.hpp"

using namespace faqem;
using namespace faqem::detail;
using faqem::test::paint;
using faqem::test::Rgba;

namespace {

// 4 x 1 texels of data: 0, 51, 102, 255.
MipImage four() {
    return MipImage(paint(4, 1,
                          [](std::uint32_t x, std::uint32_t) {
                              const std::uint8_t c = std::array<std::uint8_t, 4>{0, 51, 102, 255}[x];
                              return Rgba{c, c, c, 255};
                          }),
                    TexelEncoding::data);
}

TextureRef wrapped(Wrap wrap, Filter filter = Filter::linear) {
    TextureRef use;
    use.wrap_u = use.wrap_v = wrap;
    use.filter = filter;
    return use;
}

}  // namespace

TEST_CASE("bilinear filtering is exact at texel centres and midpoints") {
    const MipImage image = four();
    const TextureRef use = wrapped(Wrap::clamp);
    CHECK(image.sample(use, 0.375, 0.5, 0)[0] == Approx(0.2));
    CHECK(image.sample(use, 0.5, 0.5, 0)[0] == Approx(0.3));
    CHECK(image.sample(use, 0.5, 0.5, -3)[0] == Approx(0.3));
}

TEST_CASE("wrap modes apply outside of the image") {
    const MipImage image = four();
    const auto at = [&](Wrap wrap, double u) { return image.sample(wrapped(wrap), u, 0.5, 0)[0]; };
    CHECK(at(Wrap::clamp, -5.3) == Approx(0));
    CHECK(at(Wrap::clamp, 7) == Approx(1));
    CHECK(at(Wrap::repeat, 2.375) == Approx(0.2));
    CHECK(at(Wrap::repeat, -0.625) == Approx(0.2));
    CHECK(at(Wrap::repeat, 1.0) == Approx(0.5));  // between the last and the first
    CHECK(at(Wrap::mirror, -0.375) == Approx(0.2));
    CHECK(at(Wrap::mirror, 1.625) == Approx(0.2));
    CHECK(at(Wrap::mirror, 2.375) == Approx(0.2));
    CHECK(at(Wrap::repeat, std::nan("")) == at(Wrap::repeat, 0));
    CHECK(at(Wrap::repeat, 1e300) == at(Wrap::repeat, 0));
}

TEST_CASE("nearest filtering does not interpolate") {
    CHECK(four().sample(wrapped(Wrap::clamp, Filter::nearest), 0.49, 0.5, 0)[0] == Approx(0.2));
    CHECK(four().sample(wrapped(Wrap::clamp, Filter::nearest), 0.51, 0.5, 0)[0] == Approx(0.4));
}

TEST_CASE("mip levels are averages in linear light") {
    const MipImage image(paint(2, 2,
                               [](std::uint32_t x, std::uint32_t) {
                                   return x ? Rgba{255, 255, 255, 255} : Rgba{0, 0, 0, 255};
                               }),
                         TexelEncoding::opaque_color);
    const float mean = image.sample(wrapped(Wrap::repeat), 0.3, 0.3, 9)[0];
    CHECK(mean == Approx(0.5).margin(1e-4));
    CHECK(srgb_byte(mean) == 188);
}

TEST_CASE("downsampling an odd width uses all columns") {
    for (std::uint32_t width : {3u, 5u, 7u}) {
        const MipImage image(paint(width, 1,
                                   [&](std::uint32_t x, std::uint32_t) {
                                       const std::uint8_t c = x == width - 1 ? 255 : 0;
                                       return Rgba{c, c, c, 255};
                                   }),
                             TexelEncoding::data);
        CHECK(image.sample(wrapped(Wrap::clamp), 0.5, 0.5, 20)[0] == Approx(1.0 / width).margin(1e-3));
    }
}

TEST_CASE("mip levels do not depend on the number of threads") {
    const Pixels pixels = paint(75, 130, [](std::uint32_t x, std::uint32_t y) {
        return Rgba{static_cast<std::uint8_t>(x * 7), static_cast<std::uint8_t>(y * 3), 9, 255};
    });
    const MipImage one(pixels, TexelEncoding::color, 1), four(pixels, TexelEncoding::color, 4);
    const TextureRef use = wrapped(Wrap::clamp, Filter::nearest);
    for (const double lod : {1.0, 2.0, 3.0}) {
        for (double v = 0.01; v < 1; v += 0.02)
            CHECK(one.sample(use, 0.7 * v, v, lod) == four.sample(use, 0.7 * v, v, lod));
    }
}

TEST_CASE("transparent texels do not affect the colour of others") {
    const MipImage image(paint(2, 2,
                               [](std::uint32_t x, std::uint32_t) {
                                   return x ? Rgba{255, 0, 0, 255} : Rgba{0, 255, 0, 0};
                               }),
                         TexelEncoding::color);
    const LinearColor c = image.sample(wrapped(Wrap::clamp), 0.5, 0.5, 1);
    CHECK(c[3] == Approx(0.5).margin(1e-4));
    CHECK(c[0] / c[3] == Approx(1).margin(1e-3));
    CHECK(c[1] == Approx(0).margin(1e-4));
}

TEST_CASE("the stored colour of a texel does not depend on its alpha") {
    const MipImage image(paint(2, 1,
                               [](std::uint32_t x, std::uint32_t) {
                                   return Rgba{255, 0, std::uint8_t(51 * x), 0};
                               }),
                         TexelEncoding::color);
    CHECK(image.stored_color(wrapped(Wrap::repeat), 0.25, 0.5) == Vec3f{1, 0, 0});
    CHECK(image.stored_color(wrapped(Wrap::repeat), 1.75, 0.5)[2] == Approx(0.0331).margin(1e-4));
    CHECK(image.stored_color(wrapped(Wrap::clamp), -3, 0.5) == Vec3f{1, 0, 0});
    CHECK(image.stored_color(wrapped(Wrap::clamp), std::nan(""), 1e300) == Vec3f{1, 0, 0});
}

TEST_CASE("a texture transform applies scale, then rotation, then offset") {
    TextureRef use;
    use.offset = {0.25f, 0.5f};
    use.scale = {2, 3};
    use.rotation = static_cast<float>(std::acos(-1.0) / 2);
    // (1, 0) is scaled to (2, 0), and rotated to (0, -2): counter-clockwise on an image with v down.
    const auto uv = uv_transform(use).apply(1, 0);
    CHECK(uv[0] == Approx(0.25).margin(1e-6));
    CHECK(uv[1] == Approx(-1.5).margin(1e-6));
}

TEST_CASE("byte encodings round and clamp") {
    CHECK(srgb_byte(0) == 0);
    CHECK(srgb_byte(1) == 255);
    CHECK(srgb_byte(7) == 255);
    CHECK(srgb_byte(std::nan("")) == 0);
    CHECK(linear_byte(0.5) == 128);
    CHECK(linear_byte(-1) == 0);
}

TEST_CASE("sRGB bytes are those of the formula, also next to the borders between them") {
    const auto formula = [](double x) { return linear_byte(srgb_from_linear(std::min(x, 1.0))); };
    std::size_t different = 0;
    for (int i = 0; i <= 200000; ++i) {
        for (const double x : {i / 200000.0, static_cast<double>(static_cast<float>(i / 1e7))})
            different += srgb_byte(x) != formula(x);
    }
    for (int byte = 0; byte < 256; ++byte) {
        const double border = linear_from_srgb((byte + 0.5) / 255);
        for (const double x :
             {border * (1 - 1e-9), border * (1 - 1e-15), border, border * (1 + 1e-15), border * (1 + 1e-9)})
            different += srgb_byte(x) != formula(x);
    }
    CHECK(different == 0);
}

TEST_CASE("push-pull keeps known texels and fills all others") {
    Pixels pixels = paint(13, 9, [](std::uint32_t, std::uint32_t) { return Rgba{0, 0, 0, 7}; });
    std::vector<std::uint8_t> known(13 * 9, 0);
    const auto bake = [&](std::size_t at, const Rgba& c) {
        known[at] = 1;
        std::copy(c.begin(), c.end(), pixels.rgba.begin() + static_cast<std::ptrdiff_t>(4 * at));
    };
    SECTION("a single known texel fills the page") {
        bake(40, {10, 200, 30, 7});
        push_pull(pixels, known, {0, 3});
        for (std::size_t t = 0; t < known.size(); ++t) {
            CHECK(pixels.rgba[4 * t] == 10);
            CHECK(pixels.rgba[4 * t + 1] == 200);
            CHECK(pixels.rgba[4 * t + 3] == 7);
        }
    }
    SECTION("texels between two known ones are blended") {
        bake(0, {100, 0, 0, 7});
        bake(13 * 9 - 1, {200, 0, 0, 7});
        push_pull(pixels, known, {0, 3});
        for (std::size_t t = 0; t < known.size(); ++t) {
            CHECK(pixels.rgba[4 * t] >= 100);
            CHECK(pixels.rgba[4 * t] <= 200);
        }
        CHECK(pixels.rgba[0] == 100);
        CHECK(pixels.rgba[4 * (13 * 9 - 1)] == 200);
        CHECK(pixels.rgba[4 * 1] < pixels.rgba[4 * (13 * 9 - 2)]);
    }
    SECTION("without known texels nothing is changed") {
        const auto before = pixels.rgba;
        push_pull(pixels, known, {});
        CHECK(pixels.rgba == before);
    }
}

// Texels of an image that triangles show.

#include <algorithm>

#include "bake/keep/uv_texels.hpp"
#include "support/catch.hpp"

using namespace faqem;
using detail::UvTexels;

namespace {

std::vector<std::uint8_t> shown_by(const std::array<Vec2f, 3>& uv, Wrap wrap, std::uint32_t size = 16) {
    UvTexels texels(size, size);
    texels.add(uv, wrap, wrap);
    return std::move(texels).finish();
}

std::ptrdiff_t count(const std::vector<std::uint8_t>& shown) {
    return std::count(shown.begin(), shown.end(), 1);
}

}  // namespace

TEST_CASE("uv texels: those of a triangle and the ones that its bilinear filter reads") {
    const auto shown = shown_by({{{0, 0}, {0.5f, 0}, {0, 0.5f}}}, Wrap::clamp);
    for (std::size_t y = 0; y < 16; ++y) {
        for (std::size_t x = 0; x < 16; ++x) {
            INFO(x << " " << y);
            if (x + y < 8) CHECK(shown[16 * y + x]);
            if (x + y > 11) CHECK_FALSE(shown[16 * y + x]);
        }
    }
}

TEST_CASE("uv texels: wrap modes place what is outside the image") {
    const std::array<Vec2f, 3> outside = {{{1.25f, 0.4f}, {1.4f, 0.4f}, {1.25f, 0.6f}}};
    const auto repeated = shown_by(outside, Wrap::repeat), mirrored = shown_by(outside, Wrap::mirror),
               clamped = shown_by(outside, Wrap::clamp);
    CHECK(repeated[16 * 7 + 4]);
    CHECK_FALSE(repeated[16 * 7 + 11]);
    CHECK(mirrored[16 * 7 + 11]);
    CHECK_FALSE(mirrored[16 * 7 + 4]);
    CHECK(clamped[16 * 7 + 15]);
    CHECK(count(clamped) < 8);
}

TEST_CASE("uv texels: all are shown by a repeated pattern, and if no triangle is known") {
    CHECK(count(shown_by({{{0, 0}, {10, 0}, {0, 10}}}, Wrap::repeat)) == 256);
    CHECK(count(shown_by({{{0, 0}, {1e30f, 0}, {0, 1}}}, Wrap::repeat)) == 256);
    CHECK(count(UvTexels(16, 16).finish()) == 256);
}

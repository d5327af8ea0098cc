#include "bake/page/page_canvas.hpp"

#include <numeric>

#include "support/catch.hpp"

using namespace faqem;
using namespace faqem::detail;

namespace {

Atlas page_with(const Triangle2& uv) {
    Atlas atlas;
    atlas.width = atlas.height = 8;
    atlas.placements.resize(1);
    atlas.placements[0] = uv;
    return atlas;
}

}  // namespace

TEST_CASE("texels are shown if their centres are in a triangle") {
    const std::vector<std::uint8_t> shown = shown_texels(page_with({{{1, 1}, {5, 1}, {1, 5}}}));
    for (std::uint32_t y = 0; y < 8; ++y) {
        for (std::uint32_t x = 0; x < 8; ++x) {
            CAPTURE(x, y);
            if (x + y + 1 == 6) continue;  // centres on the longest edge
            CHECK((shown[8 * y + x] != 0) == (x >= 1 && y >= 1 && x + y + 1 < 6));
        }
    }
}

TEST_CASE("a triangle without a texel centre shows the texel around its centre") {
    const std::vector<std::uint8_t> shown = shown_texels(page_with({{{3.1, 2.1}, {3.3, 2.1}, {3.1, 2.3}}}));
    CHECK(std::accumulate(shown.begin(), shown.end(), 0) == 1);
    CHECK(shown[8 * 2 + 3] == 1);
    CHECK(std::accumulate(shown.begin(), shown.end(), 0) == 1);
}

TEST_CASE("triangles at the border of a page stay on it") {
    const std::vector<std::uint8_t> shown = shown_texels(page_with({{{0, 0}, {8, 0}, {8, 8}}}));
    CHECK(std::accumulate(shown.begin(), shown.end(), 0) >= 28);
    CHECK(shown[7] == 1);
}

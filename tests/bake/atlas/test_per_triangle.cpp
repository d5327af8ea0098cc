#include <bit>
#include <cmath>
#include <map>
#include <random>
#include <set>

#include "bake/atlas/per_triangle.hpp"
#include "support/catch.hpp"
#include "support/scenes.hpp"

using namespace faqem;
using namespace faqem::detail;

namespace {

std::vector<AtlasTriangle> random_triangles(std::size_t count, double largest) {
    std::mt19937 random(7);
    std::vector<AtlasTriangle> result(count);
    for (AtlasTriangle& t : result) {
        const double a = largest * std::exp2(-6.0 * (random() % 1000) / 1000.0);
        t.right_angle_corner = static_cast<std::uint8_t>(random() % 3);
        t.legs = {a, a * std::exp2(-3.0 * (random() % 1000) / 1000.0)};
        if (random() % 2) std::swap(t.legs[0], t.legs[1]);
        t.order = random();
    }
    return result;
}

// Random triangles, of which every fourth one has its successor as partner.
std::vector<AtlasTriangle> random_partners(std::size_t count, double largest) {
    std::vector<AtlasTriangle> result = random_triangles(count, largest);
    for (std::size_t i = 0; i + 3 < count; i += 4) {
        result[i].partner = static_cast<Index>(i + 1);
        result[i + 1].partner = static_cast<Index>(i);
        result[i + 1].legs = {result[i].legs[0] * 1.1, result[i].legs[1] * 0.9};
    }
    return result;
}

// Texels that bilinear filtering reads in a triangle. Weights within the rounding error are ignored.
std::set<std::pair<int, int>> texels_read(const Triangle2& placement) {
    std::set<std::pair<int, int>> result;
    const Box2 box = bounding_box(placement);
    const int n = 4 * static_cast<int>(box.width() + box.height()) + 1;
    for (const Vec3& w : test::spread(n)) {
        double x = -0.5, y = -0.5;
        for (std::size_t i = 0; i < 3; ++i) {
            x += w[i] * placement[i].x;
            y += w[i] * placement[i].y;
        }
        for (double i : {std::floor(x), std::floor(x) + 1}) {
            for (double j : {std::floor(y), std::floor(y) + 1}) {
                if (std::abs(i - x) < 1 - 1e-9 && std::abs(j - y) < 1 - 1e-9) result.insert({int(i), int(j)});
            }
        }
    }
    return result;
}

}  // namespace

TEST_CASE("bilinear reads of a triangle use no texels of other triangles except its partner") {
    const double largest = GENERATE(3.0, 20.0, 90.0);
    const auto triangles = GENERATE_COPY(random_triangles(300, largest), random_partners(300, largest));
    const auto atlas = pack_triangles(triangles, 4096);
    REQUIRE(atlas);
    CHECK(std::has_single_bit(atlas->width));
    CHECK(std::has_single_bit(atlas->height));
    CHECK(atlas->scale >= 1);
    std::map<std::pair<int, int>, std::size_t> owner;
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        for (const auto& [x, y] : texels_read(atlas->placements[t])) {
            REQUIRE((x >= 0 && y >= 0 && x < int(atlas->width) && y < int(atlas->height)));
            const auto [found, fresh] = owner.insert({{x, y}, t});
            REQUIRE((fresh || found->second == t || triangles[t].partner == found->second));
        }
    }
}

TEST_CASE("partners share their common edge on the page") {
    const double largest = GENERATE(0.9, 20.0, 90.0);
    const auto triangles = random_partners(300, largest);
    const auto atlas = pack_triangles(triangles, 4096);
    REQUIRE(atlas);
    std::size_t joined = 0;
    for (const AtlasCell& cell : atlas->cells) {
        if (!cell.has_shared_hypotenuse) continue;
        ++joined;
        REQUIRE(triangles[cell.first].partner == cell.second);
        const Triangle2 &a = atlas->placements[cell.first], &b = atlas->placements[cell.second];
        const std::size_t ra = triangles[cell.first].right_angle_corner,
                          rb = triangles[cell.second].right_angle_corner;
        CHECK(a[(ra + 1) % 3] == b[(rb + 2) % 3]);
        CHECK(a[(ra + 2) % 3] == b[(rb + 1) % 3]);
        CHECK(a[ra] != b[rb]);
    }
    CHECK(joined > 0);
    if (largest > 50) CHECK(joined == 75);  // no pair is reduced to single texels
}

TEST_CASE("mip levels up to that of the block size read texels of their own cell only") {
    const auto triangles = random_partners(300, 90);
    const auto atlas = pack_triangles(triangles, 4096);
    REQUIRE(atlas);
    std::map<std::uint32_t, int> seen;
    for (const AtlasCell& cell : atlas->cells) {
        if (!cell.has_shared_hypotenuse) continue;
        Box2 box;
        for (Index t : {cell.first, cell.second}) {
            for (const Point2& uv : atlas->placements[t]) box.add(uv);
        }
        const double inset = box.low.x - cell.x;
        const auto block_size = static_cast<std::uint32_t>(2 * inset);
        CHECK(std::has_single_bit(block_size));
        for (std::uint32_t n : {cell.x, cell.y, cell.width, cell.height}) CHECK(n % block_size == 0);
        CHECK(box.low.y == cell.y + inset);
        CHECK(box.high.x == cell.x + cell.width - inset);
        CHECK(box.high.y == cell.y + cell.height - inset);
        CHECK((block_size >= 2 || std::min(box.width(), box.height()) < 8));
        ++seen[block_size];
    }
    CHECK(seen.size() > 2);
}

TEST_CASE("cells do not overlap and every triangle is in exactly one") {
    const auto triangles = random_triangles(500, 40);
    const auto atlas = pack_triangles(triangles, 2048);
    REQUIRE(atlas);
    std::vector<int> texels(std::size_t{atlas->width} * atlas->height, 0), seen(triangles.size(), 0);
    for (const AtlasCell& cell : atlas->cells) {
        REQUIRE(cell.x + cell.width <= atlas->width);
        REQUIRE(cell.y + cell.height <= atlas->height);
        for (Index t : {cell.first, cell.second}) {
            if (t != no_index) ++seen[t];
        }
        for (std::uint32_t y = cell.y; y < cell.y + cell.height; ++y) {
            for (std::uint32_t x = cell.x; x < cell.x + cell.width; ++x) ++texels[y * atlas->width + x];
        }
    }
    CHECK(*std::max_element(texels.begin(), texels.end()) == 1);
    CHECK(std::all_of(seen.begin(), seen.end(), [](int n) { return n == 1; }));
    const auto used = std::accumulate(texels.begin(), texels.end(), 0.0);
    CHECK(used / static_cast<double>(texels.size()) > 0.8);
}

TEST_CASE("triangles have about the wanted size and are not mirrored") {
    const auto triangles = random_triangles(300, 60);
    const auto atlas = pack_triangles(triangles, 4096);
    REQUIRE(atlas);
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        const Triangle2& placement = atlas->placements[t];
        double area = 1;
        for (std::size_t i = 0; i < 2; ++i) {
            const Point2& r = placement[triangles[t].right_angle_corner];
            const Point2& end = placement[(triangles[t].right_angle_corner + 1 + i) % 3];
            const double leg = std::abs(end.x - r.x) + std::abs(end.y - r.y);
            const double wanted = triangles[t].legs[i] * atlas->scale;
            CHECK(leg > 0.75 * wanted - 2.5);
            CHECK(leg < 1.35 * wanted + 2.5);
            area *= leg;
        }
        CHECK(twice_signed_area(placement[0], placement[1], placement[2]) == -area);
    }
}

TEST_CASE("triangles are scaled down to the largest page and need at least one texel each") {
    const auto triangles = random_triangles(4000, 100);
    const auto small = pack_triangles(triangles, 256);
    REQUIRE(small);
    CHECK(small->scale < 1);
    CHECK(small->width == 256);
    REQUIRE(pack_triangles(triangles, 64));
    const auto densest = pack_triangles(std::span(triangles).first(64 * 64 - 96), 64);
    REQUIRE(densest);
    std::set<std::pair<double, double>> positions;
    for (const Triangle2& placement : densest->placements) positions.insert({placement[0].x, placement[0].y});
    CHECK(positions.size() == densest->placements.size());
    CHECK_FALSE(pack_triangles(random_triangles(64 * 64 + 1, 100), 64));
}

TEST_CASE("barycentric coordinates are exact at corners and closest points are inside") {
    const Triangle2 placement = {{{10.5, 20.5}, {18.5, 20.5}, {10.5, 16.5}}};
    const BarycentricFrame frame(placement);
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3 w = frame.at(placement[i].x, placement[i].y);
        for (std::size_t k = 0; k < 3; ++k) CHECK(w[k] == Approx(k == i ? 1 : 0).margin(1e-12));
    }
    CHECK(frame.closest(9.5, 25)[0] == Approx(1));     // beyond the right-angle corner
    CHECK(frame.closest(14.5, 30)[1] == Approx(0.5));  // below the midpoint of the first leg
    CHECK(frame.closest(14.5, 30)[2] == Approx(0).margin(1e-12));
    const Vec3 h = frame.closest(14.5 + 1, 18.5 - 2);  // perpendicular to the hypotenuse at its midpoint
    CHECK(h[0] == Approx(0).margin(1e-12));
    CHECK(h[1] == Approx(0.5));
}

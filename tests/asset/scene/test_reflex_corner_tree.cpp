#include <algorithm>
#include <numeric>
#include <random>

#include "asset/scene/reflex_corner_tree.hpp"
#include "support/catch.hpp"

using namespace faqem;
using namespace faqem::detail;

namespace {

using Points = std::vector<PlanarPoint>;

std::vector<Index> all(const Points& points) {
    std::vector<Index> corners(points.size());
    std::iota(corners.begin(), corners.end(), Index{0});
    return corners;
}

/// Corners found one after the other, each being deactivated when it is found.
std::vector<Index> all_in(ReflexCornerTree& tree, const std::array<PlanarPoint, 3>& triangle) {
    std::vector<Index> found;
    for (Index i; (i = tree.find_in(triangle)) != no_index;) {
        found.push_back(i);
        tree.set_active(i, false);
    }
    for (const Index i : found) tree.set_active(i, true);
    std::sort(found.begin(), found.end());
    return found;
}

std::vector<Index> expected(const Points& points, const std::array<PlanarPoint, 3>& triangle) {
    const auto& [a, b, c] = triangle;
    std::vector<Index> inside;
    for (Index i = 0; i < points.size(); ++i) {
        const PlanarPoint& p = points[i];
        if (p != a && p != b && p != c && orient2d(a, b, p) >= 0 && orient2d(b, c, p) >= 0 &&
            orient2d(c, a, p) >= 0)
            inside.push_back(i);
    }
    return inside;
}

}  // namespace

TEST_CASE("the tree finds exactly the corners in a triangle: scattered, repeated and along slanted lines") {
    std::mt19937 random(1);
    const auto coordinate = [&] { return double(random() % 33) / 16 - 1; };  // sums and products are exact
    Points scattered, slanted;
    for (int i = 0; i < 300; ++i) scattered.push_back({coordinate(), coordinate()});
    for (int i = 0; i < 300; ++i) {
        const double x = coordinate();
        slanted.push_back({x, x / 2 + (i % 2 ? 0.25 : 0)});
    }
    std::size_t found = 0;
    for (const Points& points : {scattered, slanted}) {
        ReflexCornerTree tree(points, all(points));
        for (int round = 0; round < 500; ++round) {
            std::array<PlanarPoint, 3> triangle;
            for (PlanarPoint& p : triangle) p = {coordinate(), coordinate()};
            if (!(orient2d(triangle[0], triangle[1], triangle[2]) > 0)) continue;
            const std::vector<Index> inside = all_in(tree, triangle);
            found += inside.size();
            if (inside != expected(points, triangle)) CHECK(inside == expected(points, triangle));
        }
    }
    CHECK(found > 1000);
}

TEST_CASE("the tree does not return inactive corners, nor those that it does not have") {
    const Points points = {{0, 0}, {0.1, 0}, {0.2, 0}};
    const std::array<PlanarPoint, 3> triangle = {{{-1, -1}, {1, -1}, {0, 1}}};
    ReflexCornerTree tree(points, std::array<Index, 2>{0, 2});
    CHECK(all_in(tree, triangle) == std::vector<Index>{0, 2});
    tree.set_active(0, false);
    tree.set_active(0, false);
    tree.set_active(1, true);
    CHECK(all_in(tree, triangle) == std::vector<Index>{2});
    tree.set_active(0, true);
    CHECK(all_in(tree, triangle) == std::vector<Index>{0, 2});
    CHECK(ReflexCornerTree(points, {}).find_in(triangle) == no_index);
}

#include "faqem/detail/mapping/local_map.hpp"

#include <algorithm>
#include <cmath>

#include "faqem/simplify.hpp"
#include "support/catch.hpp"
#include "support/mapped_points.hpp"

using namespace faqem;
using namespace faqem::test;

namespace {

// Two wavy sheets of n x n squares with a distance of `gap`, facing away from each other.
TriangleMesh double_sheet(Index n, double gap) {
    TriangleMesh above = square(n, 1, 0), below;
    for (Vec3& p : above.positions) p[2] = 0.05 * std::sin(9 * p[0]) * std::cos(7 * p[1]) + gap / 2;
    below = moved(inside_out(above), {0, 0, -gap});
    return both(above, below);
}

bool same(const SurfacePoint& a, const SurfacePoint& b) {
    return a.face == b.face && a.barycentric == b.barycentric && a.step == b.step;
}

bool same_but_for_rounding(const SurfacePoint& a, const SurfacePoint& b) {
    double largest = 0;
    for (std::size_t i = 0; i < 3; ++i)
        largest = std::max(largest, std::abs(a.barycentric[i] - b.barycentric[i]));
    return a.face == b.face && a.step == b.step && largest < 1e-9;
}

// Maps rows of points of all faces with and without a local map for every `block` points.
void check_same_points(const SimplifyResult& result, int block) {
    const SurfaceMap map(result.history);
    constexpr int n = 24;
    std::size_t different = 0, points = 0, unchanged = 0;
    for (Index f = 0; f < result.mesh.triangles.size(); ++f) {
        for (int row = 0; row < n; row += 5) {
            const auto weights = [&](double i) { return Vec3{1 - (row + i) / n, row / double(n), i / n}; };
            const double length = distance(small_point(result.mesh, f, weights(0)),
                                           small_point(result.mesh, f, weights(block)));
            SurfacePoint near = map.map(f, weights(0));
            detail::LocalMap local, larger;
            larger.prepare(map, f, weights((n - row) / 2.0), length / block * (n - row) / 2, near);
            for (int i = 0; row + i <= n; ++i, ++points) {
                if (i % block == 0 && (row % 2 == 0 || !local.prepare_from(map, f, weights(i + block / 2.0),
                                                                           length / 2, larger)))
                    local.prepare(map, f, weights(i + block / 2.0), length / 2, near);
                const SurfacePoint expected = map.map_near(f, weights(i), near);
                if (const auto point = local.map_to_same(map, f, weights(i), near.step)) {
                    ++unchanged;
                    different += !same_but_for_rounding(*point, expected);
                }
                different += !same(local.map_near(map, f, weights(i), near), expected);
                near = expected;
            }
        }
    }
    CHECK(points > 1000);
    CHECK(different == 0);
    CHECK(unchanged > points / 10);
}

}  // namespace

TEST_CASE("local map: gives the points of the whole map") {
    for (const double gap : {1e-3, 0.2}) {
        const TriangleMesh mesh = double_sheet(24, gap);
        Options options{.target = ratio(0.1)};
        options.history = Recording::on;
        const SimplifyResult result = simplify(mesh.view(), options);
        check_same_points(result, 8);
        check_same_points(result, 3);
    }
}

TEST_CASE("local map: is the whole map until it is prepared") {
    Options options{.target = ratio(0.3)};
    options.history = Recording::on;
    const SimplifyResult result = simplify(double_sheet(6, 0.1).view(), options);
    const SurfaceMap map(result.history);
    const SurfacePoint near = map.map(0, {0.4, 0.3, 0.3});
    CHECK(same(detail::LocalMap{}.map_near(map, 0, {0.3, 0.4, 0.3}, near),
               map.map_near(0, {0.3, 0.4, 0.3}, near)));
}

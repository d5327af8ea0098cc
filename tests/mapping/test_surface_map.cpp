#include <cmath>
#include <set>
#include <thread>
#include <vector>

#include "faqem/surface_map.hpp"
#include "support/catch.hpp"
#include "support/hand_history.hpp"
#include "support/mapped_points.hpp"

using namespace faqem;
using namespace faqem::test;

namespace {

// 6--7--8      Collapses (4, 5) into 9 at (1.5, 1), then (9, 7) into 10 at (1.25, 1.5).
// | /| /|
// 3--4--5
// | /| /|
// 0--1--2
CollapseHistory grid_with_two_collapses() {
    HandHistory hand(grid(2).positions, grid(2).triangles);
    const Index nine = hand.collapse(4, 5, {1.5, 1, 0});
    hand.collapse(nine, 7, {1.25, 1.5, 0});
    return hand.finish();
}

// Two layers of (n + 1)^2 vertices, z = +h and -h, that share their rim (z = 0). Top faces first.
struct Pillow {
    Index n = 0;
    std::vector<Vec3> positions;
    std::vector<Triangle> faces;
    Index top_faces() const { return 2 * n * n; }
    bool rim(Index i, Index j) const { return i == 0 || j == 0 || i == n || j == n; }
    Index top(Index i, Index j) const { return (n + 1) * j + i; }
    Index bottom(Index i, Index j) const { return rim(i, j) ? top(i, j) : (n + 1) * (n + 1) + top(i, j); }
};

Pillow pillow(Index n, double h) {
    const TriangleMesh layers = two_layers(n, h);
    return {n, layers.positions, layers.triangles};
}

// Collapses every other rim vertex and every other inner vertex into its left neighbour. The new positions
// are beyond the other layer.
CollapseHistory squeezed_pillow(const Pillow& p, const std::set<Index>& reversed) {
    std::vector<Triangle> faces = p.faces;
    for (Index f : reversed) std::swap(faces[f][1], faces[f][2]);
    HandHistory hand(p.positions, faces);
    for (Index j = 0; j <= p.n; ++j) {
        for (Index i = 1; i + 1 <= p.n; i += 2) {
            for (double side : {1.0, -1.0}) {
                const Index a = side > 0 ? p.top(i, j) : p.bottom(i, j);
                const Index b = side > 0 ? p.top(i + 1, j) : p.bottom(i + 1, j);
                if (side < 0 && p.rim(i, j)) continue;
                if (p.rim(i, j) != p.rim(i + 1, j)) continue;
                hand.collapse(
                    a, b, {i + 0.5, double(j), p.rim(i, j) ? 0 : -3 * side * p.positions[p.top(1, 1)][2]});
            }
        }
    }
    return hand.finish();
}

}  // namespace

TEST_CASE("surface map: without collapses, each point is mapped to itself") {
    HandHistory hand({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 1}}, {{0, 1, 2}, {0, 2, 3}});
    const CollapseHistory history = hand.finish();
    const SurfaceMap map(history);
    for (Index f = 0; f < 2; ++f) {
        for (const Vec3& w : spread(5)) {
            const SurfacePoint p = map.map(f, w);
            CHECK(p.step == MapStep::history);
            CHECK(distance(original_point(history, p), small_point(small_mesh(history), f, w)) < 1e-15);
        }
        CHECK(map.map(f, {0.2, 0.3, 0.5}).face == f);
    }
}

TEST_CASE("surface map: in a plane, projection is exact") {
    const CollapseHistory history = grid_with_two_collapses();
    const TriangleMesh small = small_mesh(history);
    REQUIRE(small.triangles.size() == 4);
    const SurfaceMap map(history);
    double area = 0;
    for (Index f = 0; f < small.triangles.size(); ++f) {
        const Vec3 a = small_point(small, f, {1, 0, 0}), b = small_point(small, f, {0, 1, 0}),
                   c = small_point(small, f, {0, 0, 1});
        const double twice = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
        if (twice < 0) continue;  // folded over by the arbitrary collapses
        area += twice / 2;
        for (const Vec3& w : spread(7)) {
            const Vec3 p0 = small_point(small, f, w);
            const SurfacePoint p = map.map(f, w);
            CHECK(p.face < history.triangles.size());
            CHECK(p.barycentric[0] + p.barycentric[1] + p.barycentric[2] == Approx(1));
            CHECK(distance(original_point(history, p), p0) < 1e-14);
            CHECK(p.step == MapStep::history);
            const SurfacePoint again = map.map_near(f, w, p);
            CHECK(distance(original_point(history, again), p0) < 1e-14);
        }
    }
    CHECK(area == Approx(2.75));
}

TEST_CASE("surface map: points of faces with a flipped edge are mapped exactly") {
    //  3---2        3---2
    //  | / |   ->   | \ |
    //  0---1        0---1
    HandHistory hand({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}});
    CollapseHistory history = hand.finish();
    history.patch_faces = {0, 1};
    history.patch_begin = {0, 2};
    validate(history);
    const TriangleMesh small = replay(history);
    REQUIRE(small.triangles == std::vector<Triangle>{{2, 3, 1}, {0, 1, 3}});
    const SurfaceMap map(history);
    for (Index f = 0; f < 2; ++f) {
        for (const Vec3& w : spread(7)) {
            const SurfacePoint p = map.map(f, w);
            CHECK(distance(original_point(history, p), small_point(small, f, w)) < 1e-15);
        }
    }
}

TEST_CASE("surface map: points are not mapped to the other side of a thin plate") {
    const Pillow p = pillow(6, 1e-3);
    std::set<Index> reversed;
    SECTION("consistent orientation") {}
    SECTION("every fourth face with reversed orientation") {
        for (Index f = 0; f < p.faces.size(); f += 4) reversed.insert(f);
    }
    const CollapseHistory history = squeezed_pillow(p, reversed);
    const TriangleMesh small = small_mesh(history);
    REQUIRE(small.triangles.size() < p.faces.size());
    const SurfaceMap map(history);
    for (Index f = 0; f < small.triangles.size(); ++f) {
        const bool top = history.remaining_faces[f] < p.top_faces();
        for (const Vec3& w : spread(6)) {
            const SurfacePoint q = map.map(f, w);
            CHECK((q.face < p.top_faces()) == top);
            CHECK(distance(original_point(history, q), small_point(small, f, w)) < 0.6);
        }
    }
}

// A step across a rough grid. Where a simplified face cuts the corner of the step, upper, lower and vertical
// faces are about equally close.
TEST_CASE("surface map: projection gives the closest preimage face of the same orientation") {
    constexpr Index n = 8;
    const auto vertex = [](Index i, Index j) { return (n + 1) * j + i; };
    std::vector<Vec3> positions = grid(n).positions;
    const std::vector<Triangle> faces = grid(n).triangles;
    for (Index v = 0; v < positions.size(); ++v) {
        const Index i = v % (n + 1), j = v / (n + 1);
        const double rough = 0.03 * double((7 * i + 5 * j + i * j) % 5);
        positions[v] = {i - (i > 4 ? 0.9 : 0.0), double(j), (i > 4 ? 0.7 : 0.0) + rough};
    }
    HandHistory hand(positions, faces);
    for (Index j = 1; j < n; ++j) {
        Index last = vertex(3, j);
        for (const Index i : {4u, 5u}) last = hand.collapse(last, vertex(i, j), {i - 0.6, double(j), 0.2});
    }
    const CollapseHistory history = hand.finish();
    std::vector<Index> last(positions.size() + history.collapses.size());
    for (Index v = 0; v < last.size(); ++v) last[v] = v;
    for (std::size_t k = history.collapses.size(); k-- > 0;) {
        last[history.collapses[k].first] = last[history.collapses[k].second] = last[positions.size() + k];
    }
    const auto normal = [](const Vec3& a, const Vec3& b, const Vec3& c) {
        const Vec3 u{b[0] - a[0], b[1] - a[1], b[2] - a[2]}, v{c[0] - a[0], c[1] - a[1], c[2] - a[2]};
        const Vec3 cross{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
        const double length = std::hypot(cross[0], cross[1], cross[2]);
        return Vec3{cross[0] / length, cross[1] / length, cross[2] / length};
    };
    const TriangleMesh small = small_mesh(history);
    const SurfaceMap map(history);
    for (Index f = 0; f < small.triangles.size(); ++f) {
        const Triangle& corners = small.triangles[f];
        const Vec3 n0 =
            normal(small.positions[corners[0]], small.positions[corners[1]], small.positions[corners[2]]);
        std::set<Index> ends;
        for (const Index v : faces[history.remaining_faces[f]]) ends.insert(last[v]);
        SurfacePoint near;
        for (const Vec3& w : spread(5)) {
            const Vec3 p0 = small_point(small, f, w);
            double least = 1e300;
            for (const Triangle& t : faces) {
                if (ends.count(last[t[0]]) + ends.count(last[t[1]]) + ends.count(last[t[2]]) == 0) continue;
                const Vec3 m = normal(positions[t[0]], positions[t[1]], positions[t[2]]);
                if (n0[0] * m[0] + n0[1] * m[1] + n0[2] * m[2] < 0.17) continue;
                for (const Vec3& v : spread(30)) {
                    least = std::min(least,
                                     distance(p0, mix(v, positions[t[0]], positions[t[1]], positions[t[2]])));
                }
            }
            const SurfacePoint found = map.map(f, w);
            CHECK(distance(original_point(history, found), p0) <= least + 1e-12);
            if (near.face != no_index) {
                CHECK(distance(original_point(history, map.map_near(f, w, near)), p0) <= least + 1e-12);
            }
            near = found;
        }
    }
}

TEST_CASE("surface map: concurrent calls give the same results") {
    const CollapseHistory history = squeezed_pillow(pillow(8, 1e-3), {});
    const SurfaceMap map(history);
    const auto all = [&] {
        std::vector<SurfacePoint> result;
        for (Index f = 0; f < history.remaining_faces.size(); ++f) {
            for (const Vec3& w : spread(5)) result.push_back(map.map(f, w));
        }
        return result;
    };
    const std::vector<SurfacePoint> serial = all();
    std::vector<SurfacePoint> other;
    std::thread helper([&] { other = all(); });
    const std::vector<SurfacePoint> mine = all();
    helper.join();
    for (std::size_t i = 0; i < serial.size(); ++i) {
        REQUIRE(mine[i].face == serial[i].face);
        REQUIRE(other[i].face == serial[i].face);
        REQUIRE(mine[i].barycentric == serial[i].barycentric);
        REQUIRE(other[i].barycentric == serial[i].barycentric);
    }
}

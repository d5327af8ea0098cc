#include <cmath>
#include <limits>
#include <vector>

#include "faqem/detail/geometry/triangle.hpp"
#include "faqem/forward_map.hpp"
#include "faqem/simplify.hpp"
#include "support/catch.hpp"
#include "support/hand_history.hpp"
#include "support/mapped_points.hpp"
#include "support/meshes.hpp"

using namespace faqem;
using namespace faqem::test;

namespace {

// Two layers of n x n squares at distance `thick` that share their boundary; the upper faces first.
TriangleMesh thin_wall(Index n, double thick) {
    TriangleMesh wall = two_layers(n, thick / 2);
    for (Vec3& p : wall.positions) {
        const double x = p[0] / n, y = p[1] / n;
        p = {x, y, 0.05 * std::sin(5 * x) * std::cos(4 * y) + p[2]};
    }
    return wall;
}

SimplifyResult simplified(const TriangleMesh& mesh, Options options) {
    options.history = Recording::on;
    return simplify(mesh.view(), options);
}

double brute_force_distance(const Vec3& from, const TriangleMesh& to) {
    double nearest = std::numeric_limits<double>::infinity();
    const auto at = [&](Index v) { return engine::to_eigen(to.positions[v]); };
    for (const auto& [a, b, c] : to.triangles) {
        const auto found = detail::closest_point_on_triangle(engine::to_eigen(from), at(a), at(b), at(c));
        nearest = std::min(nearest, found.distance_squared);
    }
    return std::sqrt(nearest);
}

}  // namespace

TEST_CASE("forward map: without collapses, each point is mapped to itself") {
    HandHistory hand({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 1}}, {{0, 1, 2}, {0, 2, 3}});
    const CollapseHistory history = hand.finish();
    const ForwardMap map(history);
    CHECK(vertex_map(history) == std::vector<Index>{0, 1, 2, 3});
    for (Index f = 0; f < 2; ++f) {
        for (const Vec3& w : spread(5)) {
            const SimplifiedPoint p = map.map(f, w);
            CHECK(distance(small_point(small_mesh(history), p.face, p.barycentric),
                           original_point(history, {f, w})) < 1e-15);
        }
        CHECK(map.map(f, {0.2, 0.3, 0.5}).face == f);
    }
}

TEST_CASE("forward map: vertex_map() gives the vertex that each vertex was collapsed into") {
    HandHistory hand(grid(2).positions, grid(2).triangles);
    hand.collapse(hand.collapse(4, 5, {1.5, 1, 0}), 7, {1.25, 1.5, 0});
    const CollapseHistory history = hand.finish();
    REQUIRE(history.remaining_versions == std::vector<Index>{0, 1, 2, 3, 6, 10});
    // Both faces of vertex 8 were removed.
    CHECK(vertex_map(history) == std::vector<Index>{0, 1, 2, 3, 5, 5, 4, 5, no_index});
}

TEST_CASE("forward map: points of a plane with locked boundary keep their positions") {
    const TriangleMesh mesh = grid(12);
    for (const Preset preset : all_presets) {
        CAPTURE(name(preset));
        Options options{.target = ratio(0.1), .preset = preset};
        options.topology.boundary = Boundary::locked;
        const SimplifyResult small = simplified(mesh, options);
        const ForwardMap map(small.history);
        double farthest = 0;
        for (Index f = 0; f < mesh.triangles.size(); ++f) {
            for (const Vec3& w : spread(3)) {
                const SimplifiedPoint p = map.map(f, w);
                REQUIRE(p.face < small.mesh.triangles.size());
                farthest = std::max(farthest, distance(small_point(small.mesh, p.face, p.barycentric),
                                                       original_point(small.history, {f, w})));
            }
        }
        CHECK(farthest < 1e-12);
    }
}

TEST_CASE("forward map: on a smooth surface, the result is the closest point in 99% of all cases") {
    const TriangleMesh mesh = shaken(torus(48, 24), 0.004, 7);
    for (const Preset preset : {Preset::qem, Preset::balanced, Preset::best}) {
        CAPTURE(name(preset));
        const SimplifyResult small = simplified(mesh, {.target = ratio(0.1), .preset = preset});
        const ForwardMap map(small.history);
        std::size_t nearer = 0, all = 0;
        for (Index f = 0; f < mesh.triangles.size(); f += 3) {
            const Vec3 w = {0.2, 0.5, 0.3};
            const Vec3 at = original_point(small.history, {f, w});
            const SimplifiedPoint p = map.map(f, w);
            REQUIRE(p.face != no_index);
            const double found = distance(small_point(small.mesh, p.face, p.barycentric), at);
            nearer += brute_force_distance(at, small.mesh) < found - 1e-12;
            ++all;
        }
        CHECK(nearer <= all / 100);
    }
}

TEST_CASE("forward map: points are not mapped to the other side of a thin wall") {
    const Index n = 24;
    const TriangleMesh mesh = thin_wall(n, 0.001);
    const SimplifyResult small = simplified(mesh, {.target = ratio(0.1), .preset = Preset::fast});
    const ForwardMap map(small.history);
    const Index side = 2 * n * n;
    for (Index f = 0; f < mesh.triangles.size(); ++f) {
        const SimplifiedPoint p = map.map(f, {0.3, 0.3, 0.4});
        REQUIRE(p.face != no_index);
        CHECK((small.face_origin[p.face] < side) == (f < side));
    }
}

TEST_CASE("forward map: the composition with SurfaceMap is close to the identity") {
    const TriangleMesh mesh = icosphere(3);
    const SimplifyResult small = simplified(mesh, {.target = ratio(0.2)});
    const SurfaceMap back(small.history);
    const ForwardMap there(small.history);
    for (Index f = 0; f < mesh.triangles.size(); ++f) {
        const Vec3 w = {0.25, 0.25, 0.5};
        const SimplifiedPoint on_small = there.map(f, w);
        const SurfacePoint again = back.map(on_small.face, on_small.barycentric);
        CHECK(distance(original_point(small.history, again), original_point(small.history, {f, w})) < 0.1);
    }
}

TEST_CASE("forward map: points of removed faces have no corresponding point") {
    // A duplicate of the first face, and a small component that is pruned.
    TriangleMesh mesh = grid(4);
    mesh.triangles.push_back(mesh.triangles[0]);
    const Index v = static_cast<Index>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), {{9, 9, 9}, {9.1, 9, 9}, {9, 9.1, 9}});
    mesh.triangles.push_back({v, v + 1, v + 2});
    Options options{.target = ratio(0.5)};
    options.topology.prune = model_units(1);
    const SimplifyResult small = simplified(mesh, options);
    const ForwardMap map(small.history);
    CHECK(map.map(0, {1, 0, 0}).face != no_index);
    CHECK(map.map(32, {1, 0, 0}).face == no_index);
    CHECK(map.map(33, {1, 0, 0}).face == no_index);
    const std::vector<Index> vertices = vertex_map(small.history);
    REQUIRE(vertices.size() == small.history.positions.size());
    CHECK(vertices.back() == no_index);
}

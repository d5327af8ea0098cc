#include "faqem/engine/tracking/vertex_bindings.hpp"

#include "support/catch.hpp"
#include "support/original.hpp"

using namespace faqem;
using namespace faqem::engine;

namespace {

std::vector<Index> bound_to(const VertexBindings& bindings, Index f) {
    std::vector<Index> found;
    bindings.for_each_bound(f, [&](Index v) { found.push_back(v); });
    std::sort(found.begin(), found.end());
    return found;
}

}  // namespace

TEST_CASE("vertex bindings: initially every vertex is bound to exactly one of its faces") {
    const test::OriginalOf original(test::icosphere(1));
    const CollapseMesh collapse_mesh(original.positions, original.triangles);
    VertexBindings bindings(original.surface, original.tracked, collapse_mesh);
    bindings.bind_all(collapse_mesh);
    std::vector<int> times(collapse_mesh.vertex_slots(), 0);
    for (Index f = 0; f < collapse_mesh.face_slots(); ++f) {
        for (const Index v : bound_to(bindings, f)) {
            CHECK(collapse_mesh.has_corner(f, v));
            CHECK(bindings.position(v) == collapse_mesh.position(v));
            ++times[v];
        }
    }
    CHECK(times == std::vector<int>(times.size(), 1));
}

TEST_CASE("vertex bindings: released vertices are not bound until they are bound again") {
    const test::OriginalOf original(test::quad());
    const CollapseMesh collapse_mesh(original.positions, original.triangles);
    VertexBindings bindings(original.surface, original.tracked, collapse_mesh);
    bindings.bind_all(collapse_mesh);
    std::vector<Index> all = bound_to(bindings, 0);
    for (const Index v : bound_to(bindings, 1)) all.push_back(v);
    CHECK(all.size() == 4);
    for (const Index f : {0u, 1u}) bindings.unbind_all(f);
    CHECK(bound_to(bindings, 0).empty());
    bindings.bind(2, 1);
    bindings.bind(0, 1);
    CHECK(bound_to(bindings, 1) == std::vector<Index>{0, 2});
}

TEST_CASE("vertex bindings: a vertex without faces is not bound") {
    const test::OriginalOf original(test::make({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {9, 9, 9}}, {{0, 1, 2}}));
    const CollapseMesh collapse_mesh(original.positions, original.triangles);
    VertexBindings bindings(original.surface, original.tracked, collapse_mesh);
    bindings.bind_all(collapse_mesh);
    CHECK(bound_to(bindings, 0) == std::vector<Index>{0, 1, 2});
}

TEST_CASE("vertex bindings: a merged vertex is bound to the face nearest to its original position") {
    // Every second column of a grid is merged into its left neighbour, which does not move.
    const TriangleMesh mesh = test::grid(6);
    const test::OriginalOf original(mesh);
    CollapseMesh collapse_mesh = test::collapse_mesh_of(mesh);
    VertexBindings bindings(original.surface, original.tracked, collapse_mesh);
    for (Index y = 0; y <= 6; ++y) {
        for (const Index x : {1u, 3u, 5u}) {
            const Index v = x + 7 * y;
            bindings.merge(v - 1, v);
            collapse_mesh.collapse(v - 1, v, collapse_mesh.position(v - 1));
        }
    }
    bindings.bind_all(collapse_mesh);
    const auto distance = [&](Index f, const Vector3& p) {
        const Triangle& t = collapse_mesh.triangle(f);
        return TriangleDistance(collapse_mesh.position(t[0]), collapse_mesh.position(t[1]),
                                collapse_mesh.position(t[2]))(p);
    };
    std::size_t found = 0;
    for (Index f = 0; f < collapse_mesh.face_slots(); ++f) {
        if (!collapse_mesh.is_alive(f)) {
            CHECK(bound_to(bindings, f).empty());
            continue;
        }
        for (const Index v : bound_to(bindings, f)) {
            ++found;
            for (Index other = 0; other < collapse_mesh.face_slots(); ++other) {
                if (collapse_mesh.is_alive(other))
                    CHECK(distance(f, bindings.position(v)) <= distance(other, bindings.position(v)));
            }
        }
    }
    CHECK(found == mesh.positions.size());
}

TEST_CASE("vertex bindings: chains of collapse targets are followed") {
    const TriangleMesh mesh = test::fan(8);
    const test::OriginalOf original(mesh);
    CollapseMesh collapse_mesh = test::collapse_mesh_of(mesh);
    VertexBindings bindings(original.surface, original.tracked, collapse_mesh);
    for (Index v = 2; v < 7; ++v) {
        bindings.merge(v, v - 1);
        collapse_mesh.collapse(v, v - 1, collapse_mesh.position(v));
    }
    bindings.bind_all(collapse_mesh);
    std::size_t found = 0;
    for (Index f = 0; f < collapse_mesh.face_slots(); ++f) {
        if (collapse_mesh.is_alive(f)) found += bound_to(bindings, f).size();
    }
    CHECK(found == 9);
}

TEST_CASE("vertex bindings: distances to the original are not affected by collapses") {
    const TriangleMesh mesh = test::fan(6);
    const test::OriginalOf original(mesh);
    CollapseMesh collapse_mesh = test::collapse_mesh_of(mesh);
    const VertexBindings bindings(original.surface, original.tracked, collapse_mesh);
    collapse_mesh.collapse(0, 1, {0, 0, 5});
    CHECK(bindings.squared_distance_to_ring(0, {0.1, 0.1, 2}, 100) == Approx(4));
    CHECK(bindings.squared_distance_to_ring(0, {0.1, 0.1, 2}, 1) == 1);
    CHECK(bindings.squared_distance_to_ring(1, {2, 0, 0}, 100) == Approx(1));
}

TEST_CASE("vertex bindings: some vertices can be bound to a mesh that is already simplified") {
    // The original square has 128 triangles, the current one has two.
    const test::OriginalOf original(test::grid(8));
    const CollapseMesh collapse_mesh({{0, 0, 0}, {8, 0, 0}, {8, 8, 0}, {0, 8, 0}}, {{0, 1, 2}, {0, 2, 3}});
    TrackedVertices tracked;
    tracked.add(3, 1);   // at (3, 0), below the diagonal
    tracked.add(30, 0);  // at (3, 3), on it
    tracked.add(66, 0);  // at (3, 7), above
    VertexBindings bindings(original.surface, tracked, collapse_mesh);
    bindings.bind_all(collapse_mesh);
    CHECK(bound_to(bindings, 0) == std::vector<Index>{0, 1});
    CHECK(bound_to(bindings, 1) == std::vector<Index>{2});
    CHECK(bindings.position(2) == Vector3(3, 7, 0));
    CHECK(bindings.squared_distance_to_ring(2, {3, 7, 2}, 100) == Approx(4));
}

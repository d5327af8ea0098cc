#include "faqem/engine/mesh/degenerate.hpp"

#include <catch2/catch.hpp>

#include "support/meshes.hpp"

using namespace faqem;
using namespace faqem::engine;

namespace {

// A triangle, and beside its edge 0 1 two faces without area.
const TriangleMesh hem =
    test::make({{0, 0, 0}, {4, 0, 0}, {0, 3, 0}, {2, 0, 0}, {1, 0, 0}}, {{0, 1, 2}, {1, 0, 3}, {3, 0, 4}});

}  // namespace

TEST_CASE("degenerate are faces whose height is a thousand millionth of their longest edge or less") {
    const auto is_degenerate_at = [](double height, double size) {
        const TriangleMesh mesh = test::make({{0, 0, 0}, {1, 0, 0}, {0.3, height, 0}}, {{0, 1, 2}});
        return is_degenerate(test::collapse_mesh_of(test::scaled(mesh, size)), 0);
    };
    for (const double size : {1e-30, 1.0, 1e30}) {
        CHECK(is_degenerate_at(0, size));
        CHECK(is_degenerate_at(0.9e-9, size));
        CHECK_FALSE(is_degenerate_at(1.1e-9, size));
    }
    CHECK(
        is_degenerate(test::collapse_mesh_of(test::make({{1, 1, 1}, {1, 1, 1}, {1, 1, 1}}, {{0, 1, 2}})), 0));
}

TEST_CASE("degenerate: the pairs that hold all faces with an area are known") {
    const CollapseMesh collapse_mesh = test::collapse_mesh_of(hem);
    const PairTable pairs(collapse_mesh, {});
    DegenerateFaces degenerate(collapse_mesh);
    const auto are_last_faces = [&](Index u, Index v) {
        return degenerate.are_last_faces(collapse_mesh, pairs, test::pair_of(pairs, u, v));
    };
    CHECK(are_last_faces(1, 2));
    CHECK(are_last_faces(0, 1));
    CHECK_FALSE(are_last_faces(0, 3));
    CHECK_FALSE(are_last_faces(3, 4));
}

TEST_CASE("degenerate: where nothing has an area, the last faces count") {
    CollapseMesh collapse_mesh = test::collapse_mesh_of(hem);
    PairTable pairs(collapse_mesh, {});
    DegenerateFaces degenerate(collapse_mesh);
    collapse_mesh.remove_face(0);
    pairs.after_face_removal(collapse_mesh, hem.triangles[0]);
    CHECK(degenerate.are_last_faces(collapse_mesh, pairs, test::pair_of(pairs, 0, 3)));
    CHECK_FALSE(degenerate.are_last_faces(collapse_mesh, pairs, test::pair_of(pairs, 0, 1)));
}

TEST_CASE("degenerate: what a collapse takes or gives an area counts no longer") {
    CollapseMesh collapse_mesh = test::collapse_mesh_of(hem);
    PairTable pairs(collapse_mesh, {});
    DegenerateFaces degenerate(collapse_mesh);
    std::vector<Index> killed;
    std::vector<PairTable::Change> changes;
    // Vertex 4 goes into 3, which leaves the edge: both faces that are left have an area.
    degenerate.before_collapse(collapse_mesh, pairs, test::pair_of(pairs, 3, 4));
    collapse_mesh.collapse(3, 4, {2, -1, 0});
    pairs.merge(collapse_mesh, 3, 4, killed, changes);
    CHECK_FALSE(degenerate.are_last_faces(collapse_mesh, pairs, test::pair_of(pairs, 1, 2)));
    CHECK(degenerate.are_last_faces(collapse_mesh, pairs, test::pair_of(pairs, 0, 1)));
}

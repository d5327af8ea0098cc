#include "faqem/engine/mesh/degenerate.hpp"

#include "support/catch.hpp"
#include "support/meshes.hpp"

using namespace faqem;
using namespace faqem::engine;

namespace {

// A triangle with two faces of zero area at its edge (0, 1).
const TriangleMesh hem =
    test::make({{0, 0, 0}, {4, 0, 0}, {0, 3, 0}, {2, 0, 0}, {1, 0, 0}}, {{0, 1, 2}, {1, 0, 3}, {3, 0, 4}});

}  // namespace

TEST_CASE("degenerate: a face is degenerate if its height is at most 1e-9 of its longest edge") {
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

TEST_CASE("degenerate: a pair with all non-degenerate faces is detected") {
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

TEST_CASE("degenerate: if all faces are degenerate, a pair with all faces is detected") {
    CollapseMesh collapse_mesh = test::collapse_mesh_of(hem);
    PairTable pairs(collapse_mesh, {});
    DegenerateFaces degenerate(collapse_mesh);
    collapse_mesh.remove_face(0);
    pairs.after_face_removal(collapse_mesh, hem.triangles[0]);
    CHECK(degenerate.are_last_faces(collapse_mesh, pairs, test::pair_of(pairs, 0, 3)));
    CHECK_FALSE(degenerate.are_last_faces(collapse_mesh, pairs, test::pair_of(pairs, 0, 1)));
}

TEST_CASE("degenerate: removed faces and faces that gain an area no longer count") {
    CollapseMesh collapse_mesh = test::collapse_mesh_of(hem);
    PairTable pairs(collapse_mesh, {});
    DegenerateFaces degenerate(collapse_mesh);
    std::vector<Index> killed;
    std::vector<PairTable::Change> changes;
    // Vertex 4 is merged into 3, which moves off the edge: both remaining faces have an area.
    degenerate.before_collapse(collapse_mesh, pairs, test::pair_of(pairs, 3, 4));
    collapse_mesh.collapse(3, 4, {2, -1, 0});
    pairs.merge(collapse_mesh, 3, 4, killed, changes);
    CHECK_FALSE(degenerate.are_last_faces(collapse_mesh, pairs, test::pair_of(pairs, 1, 2)));
    CHECK(degenerate.are_last_faces(collapse_mesh, pairs, test::pair_of(pairs, 0, 1)));
}

TEST_CASE("a pair is short if it is below the limit and below 1e-8 of the edges around it") {
    // The vertices 2 and 3 are 1e-9 apart, the others about 1.
    const CollapseMesh mesh = test::collapse_mesh_of(
        test::make({{0, 0, 0}, {2, 0, 0}, {1, 1, 0}, {1 + 1e-9, 1, 0}}, {{0, 1, 2}, {1, 3, 2}}));
    CHECK(is_short_pair(mesh, 2, 3, 1e-8));
    CHECK_FALSE(is_short_pair(mesh, 2, 3, 1e-10));
    CHECK_FALSE(is_short_pair(mesh, 2, 3, 0));
    CHECK_FALSE(is_short_pair(mesh, 0, 2, 100));
}

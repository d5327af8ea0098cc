#include "faqem/engine/mesh/boundary_edges.hpp"

#include <set>
#include <tuple>

#include "support/catch.hpp"
#include "support/meshes.hpp"

using namespace faqem;
using namespace faqem::engine;

namespace {

using Found = std::set<std::tuple<Index, std::uint32_t, std::uint32_t>>;

Found open_after(const CollapseMesh& mesh, const PairTable& pairs, Index u, Index v) {
    Found found;
    for_each_boundary_edge_after(mesh, pairs, u, v, [&](const BoundaryEdge& edge) {
        CHECK(found.insert({edge.vertex, edge.with_u, edge.with_v}).second);
    });
    return found;
}

}  // namespace

TEST_CASE("boundary edges: the edges after the collapse of a side of a square are predicted") {
    // 3---2
    // | / |
    // 0---1
    const CollapseMesh mesh = test::collapse_mesh_of(test::quad());
    const PairTable pairs(mesh, {});
    CHECK(open_after(mesh, pairs, 0, 1) == Found{{2, 2, 1}, {3, 1, 0}});
    CHECK(open_after(mesh, pairs, 1, 0) == Found{{2, 1, 2}, {3, 0, 1}});
    CHECK(open_after(mesh, pairs, 0, 2).empty());
}

TEST_CASE("boundary edges: predictions for all pairs of a soup agree with the collapsed mesh") {
    for (std::uint32_t seed = 1; seed <= 5; ++seed) {
        const TriangleMesh soup = test::soup(seed, 20, 40);
        const CollapseMesh mesh = test::collapse_mesh_of(soup);
        const PairTable pairs(mesh, {});
        for (Index pair = 0; pair < pairs.size(); ++pair) {
            const Index u = pairs.first(pair), v = pairs.second(pair);
            std::set<Index> predicted, left;
            for (const auto& [vertex, with_u, with_v] : open_after(mesh, pairs, u, v)) {
                predicted.insert(vertex);
            }
            CollapseMesh after = mesh;
            PairTable pairs_after = pairs;
            std::vector<Index> killed;
            std::vector<PairTable::Change> changes;
            after.collapse(u, v, mesh.position(u));
            pairs_after.merge(after, u, v, killed, changes);
            pairs_after.for_each_pair(u, [&](Neighbour n) {
                if (pairs_after.face_count(n.pair) == 1) left.insert(n.vertex);
            });
            CHECK(predicted == left);
        }
    }
}

TEST_CASE("boundary edges: all edges except the non-manifold one are found, in order") {
    const TriangleMesh book = test::book();
    const CollapseMesh mesh = test::collapse_mesh_of(book);
    const PairTable pairs(mesh, {});
    std::vector<std::array<Index, 2>> expected;
    for (Index pair = 0; pair < pairs.size(); ++pair) {
        const auto [a, b] = std::minmax({pairs.first(pair), pairs.second(pair)});
        if (pairs.face_count(pair) == 1) expected.push_back({a, b});
    }
    std::sort(expected.begin(), expected.end());
    CHECK(find_boundary_edges(book.triangles, book.positions.size()) == expected);
    CHECK(expected.size() == 6);
    CHECK(find_boundary_edges(test::tetrahedron().triangles, 4).empty());
    CHECK(find_boundary_edges({}, 0).empty());
}

#include "faqem/engine/constraints/contraction.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "support/catch.hpp"
#include "support/meshes.hpp"

using namespace faqem;
using namespace faqem::engine;

namespace {

// Two pyramids of three sides, whose bases are joined by a triangular tube: a neck of the vertices 3, 4 and 5 between
// the corners 0 to 2 with apex 9 and 6 to 8 with apex 10.
TriangleMesh hourglass() {
    TriangleMesh mesh;
    const double radius[] = {2, 0.1, 2};
    for (int ring = 0; ring < 3; ++ring) {
        for (int k = 0; k < 3; ++k) {
            const double a = 2 * test::pi * k / 3;
            mesh.positions.push_back({radius[ring] * std::cos(a), radius[ring] * std::sin(a), 2.0 * ring});
        }
    }
    mesh.positions.insert(mesh.positions.end(), {{0, 0, -1}, {0, 0, 5}});
    for (Index k = 0; k < 3; ++k) {
        const Index next = (k + 1) % 3;
        for (const Index r : {0u, 3u}) {
            mesh.triangles.push_back({r + k, r + next, r + 3 + next});
            mesh.triangles.push_back({r + k, r + 3 + next, r + 3 + k});
        }
        mesh.triangles.push_back({next, k, 9});
        mesh.triangles.push_back({6 + k, 6 + next, 10});
    }
    return mesh;
}

Contraction contraction_on(const CollapseMesh& mesh) {
    Contraction contraction(mesh.vertex_slots());
    contraction.keep_closed(std::vector<std::uint8_t>(mesh.vertex_slots(), 1));
    return contraction;
}

std::optional<Refusal> refusal_with_lock(const Contraction& contraction, const CollapseMesh& mesh,
                                         Index locked) {
    std::vector<std::uint8_t> locks(mesh.vertex_slots(), 0);
    if (locked != no_index) locks[locked] = 1;
    return contraction.refusal(mesh, 0, locks);
}

std::vector<Index> sorted(std::vector<Index> vertices) {
    std::sort(vertices.begin(), vertices.end());
    return vertices;
}

}  // namespace

TEST_CASE("contraction: a pair that keeps the surface closed is collapsed alone") {
    const CollapseMesh mesh = test::collapse_mesh_of(test::lump(2));
    Contraction contraction = contraction_on(mesh);
    const PairTable pairs(mesh, {});
    for (Index pair = 0; pair < pairs.size(); ++pair) {
        CHECK_FALSE(contraction.find(mesh, pairs.first(pair), pairs.second(pair)));
        CHECK(contraction.vanishing().size() == 2);
    }
}

TEST_CASE("contraction: a neck of three edges is contracted to its centre") {
    REQUIRE(test::closed_manifold(hourglass().triangles));
    const CollapseMesh mesh = test::collapse_mesh_of(hourglass());
    Contraction contraction = contraction_on(mesh);
    REQUIRE(contraction.find(mesh, 4, 5));
    CHECK(sorted(contraction.vertices()) == std::vector<Index>{3, 4, 5});
    CHECK(contraction.vanishing().size() == 6);
    CHECK(contraction.remaining().size() == 6);
    for (const Index free : {no_index, 0u, 3u, 9u}) CHECK_FALSE(refusal_with_lock(contraction, mesh, free));
    const Candidate at = contraction.candidate(mesh, no_index);
    CHECK((at.point - Vector3(0, 0, 2)).norm() < 0.1);
    const double square = 3 * 0.01;  // the side of the neck
    CHECK(at.cost >= square * square);
    CHECK(contraction.candidate(mesh, 4).point == mesh.position(4));
}

TEST_CASE("contraction: applied to a neck, it leaves two closed surfaces that share a vertex") {
    CollapseMesh mesh = test::collapse_mesh_of(hourglass());
    PairTable pairs(mesh, {});
    Contraction contraction = contraction_on(mesh);
    REQUIRE(contraction.find(mesh, 3, 4));
    std::vector<Index> killed;
    std::vector<PairTable::Change> changes;
    const auto collapse = [&](Index survivor, Index removed, Index) {
        mesh.collapse(survivor, removed, {0, 0, 2});
        pairs.merge(mesh, survivor, removed, killed, changes);
    };
    // Even if the time is over after the first collapse.
    CHECK_THROWS_AS(contraction.apply(mesh, pairs, no_index,
                                      [&](Index survivor, Index removed, Index pair) {
                                          collapse(survivor, removed, pair);
                                          throw Cancelled{StopReason::reached_time_limit};
                                      }),
                    Cancelled);
    std::vector<Triangle> left;
    for (Index f = 0; f < mesh.face_slots(); ++f) {
        if (mesh.is_alive(f)) left.push_back(mesh.triangle(f));
    }
    CHECK(left.size() == 12);
    CHECK(test::closed_manifold(left));
    CHECK(test::euler(left) == 3);
}

TEST_CASE("contraction: a tetrahedron vanishes as a whole, at 33 times the square of its area") {
    const TriangleMesh both = test::both(test::tetrahedron(), test::moved(test::cube(), {3, 0, 0}));
    const CollapseMesh mesh = test::collapse_mesh_of(both),
                       alone = test::collapse_mesh_of(test::tetrahedron());
    Contraction contraction = contraction_on(mesh);
    REQUIRE(contraction.find(mesh, 0, 1));
    CHECK(contraction.vertices().size() == 4);
    CHECK(contraction.remaining().empty());
    CHECK_FALSE(refusal_with_lock(contraction, mesh, no_index));
    CHECK(refusal_with_lock(contraction, mesh, 3) == Refusal::locked);
    const double area = 1.5 + std::sqrt(0.75);
    CHECK(contraction.candidate(mesh, no_index).cost == Approx(33 * area * area + 4));  // 4: of the diameter
    REQUIRE(contraction.find(alone, 0, 1));
    CHECK(refusal_with_lock(contraction, alone, no_index) == Refusal::last_faces);
}

#include "faqem/engine/constraints/fold_test.hpp"

#include <cmath>
#include <map>

#include "faqem/engine/constraints/legality.hpp"
#include "support/catch.hpp"
#include "support/meshes.hpp"

using namespace faqem;
using namespace faqem::engine;

namespace {

Vector3 normal(const CollapseMesh& collapse_mesh, Index f) {
    return collapse_mesh.area_vector(f).normalized();
}

// Number of edges with two faces whose normals have a cosine below `min_cosine`, over the whole mesh.
int folds(const CollapseMesh& collapse_mesh, double min_cosine) {
    std::map<std::pair<Index, Index>, std::vector<Index>> faces;
    for (Index f = 0; f < collapse_mesh.face_slots(); ++f) {
        if (!collapse_mesh.is_alive(f)) continue;
        const Triangle& t = collapse_mesh.triangle(f);
        for (unsigned k = 0; k < 3; ++k) faces[std::minmax(t[k], t[(k + 1) % 3])].push_back(f);
    }
    int count = 0;
    for (const auto& [edge, at] : faces) {
        count +=
            at.size() == 2 && normal(collapse_mesh, at[0]).dot(normal(collapse_mesh, at[1])) < min_cosine;
    }
    return count;
}

// Calls FoldTest with the moved faces computed from positions.
class Collapses {
public:
    explicit Collapses(const CollapseMesh& collapse_mesh) : mesh_(collapse_mesh), folds_(collapse_mesh) {}

    bool adds_folds(Index u, Index v, const Vector3& p, double min_cosine) {
        std::vector<MovedFace> moved;
        mesh_.for_each_face_around(u, v, [&](Index f, unsigned corner) {
            if (mesh_.has_corner(f, u) && mesh_.has_corner(f, v)) return;
            const Triangle& t = mesh_.triangle(f);
            const Index a = t[(corner + 1) % 3], b = t[(corner + 2) % 3];
            const Vector3 after = area_vector(p, mesh_.position(a), mesh_.position(b)).normalized();
            moved.push_back({f, a, b, after, after.dot(normal(mesh_, f))});
        });
        return folds_.adds_folds(mesh_, u, v, moved, min_cosine);
    }

private:
    const CollapseMesh& mesh_;
    FoldTest folds_;
};

}  // namespace

TEST_CASE("folds: a face may be rotated onto its neighbour up to the limit angle") {
    //     2
    //    / \     Vertices 3 and 4 are merged and rotated
    //   0---1
    //    \ / \    about the edge (0, 1), towards vertex 2.
    //     3---4
    const TriangleMesh mesh = test::make({{0, 0, 0}, {1, 0, 0}, {0.5, 1, 0}, {0.5, -1, 0}, {1.5, -1, 0}},
                                         {{0, 1, 2}, {1, 0, 3}, {1, 3, 4}});
    const CollapseMesh collapse_mesh = test::collapse_mesh_of(mesh);
    Collapses counter(collapse_mesh);
    for (const double degrees : {10.0, 25.0, 27.0, 90.0, 179.0}) {
        const double angle = degrees * test::pi / 180;
        const Vector3 p(0.5, std::cos(angle), std::sin(angle));
        CHECK(counter.adds_folds(3, 4, p, -0.9) == (std::cos(angle) > 0.9));
        CHECK(counter.adds_folds(4, 3, p, -0.9) == (std::cos(angle) > 0.9));
    }
}

TEST_CASE("folds: existing folds are allowed") {
    // A pillow of two surface patches of four triangles each: all edges of its rim are folds, before and
    // after.
    TriangleMesh mesh =
        test::make({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 0.01}, {0.5, 0.5, -0.01}}, {});
    for (Index k = 0; k < 4; ++k) {
        mesh.triangles.push_back({k, (k + 1) % 4, 4});
        mesh.triangles.push_back({(k + 1) % 4, k, 5});
    }
    const CollapseMesh collapse_mesh = test::collapse_mesh_of(mesh);
    REQUIRE(folds(collapse_mesh, -0.9) == 4);
    Collapses counter(collapse_mesh);
    CHECK_FALSE(counter.adds_folds(0, 4, collapse_mesh.position(0), -0.9));
    CHECK_FALSE(counter.adds_folds(0, 1, collapse_mesh.position(0), -0.9));
}

TEST_CASE("folds: the same collapses add folds if the windings are inconsistent") {
    // The mesh of the first test, with lower faces whose windings are inconsistent with the upper face.
    const std::vector<Triangle> flap = {{0, 1, 2}, {0, 1, 3}, {3, 1, 4}};
    const CollapseMesh collapse_mesh({{0, 0, 0}, {1, 0, 0}, {0.5, 1, 0}, {0.5, -1, 0}, {1.5, -1, 0}}, flap);
    Collapses counter(collapse_mesh);
    CHECK(counter.adds_folds(3, 4, {0.5, 1, 0.1}, -0.9));
    CHECK_FALSE(counter.adds_folds(3, 4, {0.5, -1, 0.1}, -0.9));
    // A plane fan of four faces around vertex 4, with alternating windings: flat before and after.
    const CollapseMesh fan({{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, 0}},
                           {{0, 1, 4}, {2, 1, 4}, {2, 3, 4}, {0, 3, 4}});
    Collapses of_fan(fan);
    CHECK_FALSE(of_fan.adds_folds(4, 0, {0.5, 0, 0}, -0.9));
}

TEST_CASE("folds: the result agrees with counting all folds before and after") {
    test::Random random(3);
    int added = 0, not_added = 0;
    for (std::uint32_t seed = 0; seed < 40; ++seed) {
        TriangleMesh mesh = seed % 2 ? test::icosphere(1) : test::grid(5);
        for (Vec3& p : mesh.positions) {
            for (double& x : p) x += random.between(-0.35, 0.35);
        }
        const CollapseMesh collapse_mesh = test::collapse_mesh_of(mesh);
        const PairTable pairs(collapse_mesh, {});
        Collapses counter(collapse_mesh);
        Legality legality(collapse_mesh);
        for (Index pair = 0; pair < pairs.size(); pair += 3) {
            const Index u = pairs.first(pair), v = pairs.second(pair);
            const Vector3 p =
                collapse_mesh.position(u) +
                random.between(-0.5, 1.5) * (collapse_mesh.position(v) - collapse_mesh.position(u));
            if (legality.check(collapse_mesh, pairs, u, v, pair, p, {LinkCondition::on, -1, 0})) continue;
            CollapseMesh after = collapse_mesh;
            after.collapse(u, v, p);
            const bool more = folds(after, -0.5) > folds(collapse_mesh, -0.5);
            CHECK(counter.adds_folds(u, v, p, -0.5) == more);
            ++(more ? added : not_added);
        }
    }
    CHECK(added > 20);
    CHECK(not_added > 20);
}

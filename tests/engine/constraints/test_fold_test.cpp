#include "faqem/engine/constraints/fold_test.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <map>

#include "support/meshes.hpp"
#include "faqem/engine/constraints/legality.hpp"

using namespace faqem;
using namespace faqem::engine;

namespace {

Vector3 normal(const Complex& complex, Index f) { return complex.area_vector(f).normalized(); }

// Edges with two faces whose normals have a cosine below `least`, counted over the whole surface.
int folds(const Complex& complex, double least) {
    std::map<std::pair<Index, Index>, std::vector<Index>> faces;
    for (Index f = 0; f < complex.face_slots(); ++f) {
        if (!complex.alive(f)) continue;
        const Triangle& t = complex.triangle(f);
        for (unsigned k = 0; k < 3; ++k) faces[std::minmax(t[k], t[(k + 1) % 3])].push_back(f);
    }
    int count = 0;
    for (const auto& [edge, at] : faces) {
        count += at.size() == 2 && normal(complex, at[0]).dot(normal(complex, at[1])) < least;
    }
    return count;
}

// The counter, and the faces there would be, worked out from places alone.
class Collapses {
public:
    explicit Collapses(const Complex& complex) : complex_(complex), folds_(complex) {}

    bool adds(Index u, Index v, const Vector3& p, double least) {
        std::vector<TurnedFace> turned;
        complex_.for_each_face_around(u, v, [&](Index f, unsigned corner) {
            if (complex_.has_corner(f, u) && complex_.has_corner(f, v)) return;
            const Triangle& t = complex_.triangle(f);
            const Index a = t[(corner + 1) % 3], b = t[(corner + 2) % 3];
            const Vector3 after = area_vector(p, complex_.position(a), complex_.position(b)).normalized();
            turned.push_back({f, a, b, after, after.dot(normal(complex_, f))});
        });
        return folds_.adds(complex_, u, v, turned, least);
    }

private:
    const Complex& complex_;
    Folds folds_;
};

}  // namespace

TEST_CASE("folds: a flap may turn over its neighbour down to the limit") {
    //     2
    //    / \     Vertex 3 is joined with 4 and turned
    //   0---1
    //    \ / \    about the edge 0 1, towards vertex 2.
    //     3---4
    const TriangleMesh mesh = test::make({{0, 0, 0}, {1, 0, 0}, {0.5, 1, 0}, {0.5, -1, 0}, {1.5, -1, 0}},
                                         {{0, 1, 2}, {1, 0, 3}, {1, 3, 4}});
    const Complex complex = test::complex_of(mesh);
    Collapses counter(complex);
    for (const double degrees : {10.0, 25.0, 27.0, 90.0, 179.0}) {
        const double angle = degrees * test::pi / 180;
        const Vector3 p(0.5, std::cos(angle), std::sin(angle));
        CHECK(counter.adds(3, 4, p, -0.9) == (std::cos(angle) > 0.9));
        CHECK(counter.adds(4, 3, p, -0.9) == (std::cos(angle) > 0.9));
    }
}

TEST_CASE("folds: those that are there already may stay") {
    // A pillow of two sheets of four triangles: its rim is all folds, before and after.
    TriangleMesh mesh =
        test::make({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 0.01}, {0.5, 0.5, -0.01}}, {});
    for (Index k = 0; k < 4; ++k) {
        mesh.triangles.push_back({k, (k + 1) % 4, 4});
        mesh.triangles.push_back({(k + 1) % 4, k, 5});
    }
    const Complex complex = test::complex_of(mesh);
    REQUIRE(folds(complex, -0.9) == 4);
    Collapses counter(complex);
    CHECK_FALSE(counter.adds(0, 4, complex.position(0), -0.9));
    CHECK_FALSE(counter.adds(0, 1, complex.position(0), -0.9));
}

TEST_CASE("folds: where windings disagree, the surface folds where it did before they did") {
    // The flap of the first test, its faces wound against its neighbour.
    const std::vector<Triangle> flap = {{0, 1, 2}, {0, 1, 3}, {3, 1, 4}};
    const Complex complex({{0, 0, 0}, {1, 0, 0}, {0.5, 1, 0}, {0.5, -1, 0}, {1.5, -1, 0}}, flap);
    Collapses counter(complex);
    CHECK(counter.adds(3, 4, {0.5, 1, 0.1}, -0.9));
    CHECK_FALSE(counter.adds(3, 4, {0.5, -1, 0.1}, -0.9));
    // And a fan of four around vertex 4, every other face turned over: flat before, flat after.
    const Complex fan({{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, 0}},
                      {{0, 1, 4}, {2, 1, 4}, {2, 3, 4}, {0, 3, 4}});
    Collapses of_fan(fan);
    CHECK_FALSE(of_fan.adds(4, 0, {0.5, 0, 0}, -0.9));
}

TEST_CASE("folds: the answer is that of counting them all, before and after") {
    test::Random random(3);
    int added = 0, not_added = 0;
    for (std::uint32_t seed = 0; seed < 40; ++seed) {
        TriangleMesh mesh = seed % 2 ? test::icosphere(1) : test::grid(5);
        for (Vec3& p : mesh.positions) {
            for (double& x : p) x += random.between(-0.35, 0.35);
        }
        const Complex complex = test::complex_of(mesh);
        const PairTable pairs(complex, {});
        Collapses counter(complex);
        Legality legality(complex);
        for (Index pair = 0; pair < pairs.size(); pair += 3) {
            const Index u = pairs.first(pair), v = pairs.second(pair);
            const Vector3 p =
                complex.position(u) + random.between(-0.5, 1.5) * (complex.position(v) - complex.position(u));
            if (legality.check(complex, pairs, u, v, pair, p, {LinkCondition::on, -1, 0})) continue;
            Complex after = complex;
            after.collapse(u, v, p);
            const bool more = folds(after, -0.5) > folds(complex, -0.5);
            CHECK(counter.adds(u, v, p, -0.5) == more);
            ++(more ? added : not_added);
        }
    }
    CHECK(added > 20);
    CHECK(not_added > 20);
}

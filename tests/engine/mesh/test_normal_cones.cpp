#include "faqem/engine/mesh/normal_cones.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "support/catch.hpp"
#include "support/meshes.hpp"

using namespace faqem;
using namespace faqem::engine;

namespace {

double radians(double degrees) { return degrees * test::pi / 180; }

// A pyramid whose n faces are inclined by the angle in degrees; vertex 0 is the apex.
CollapseMesh pyramid(unsigned n, double inclination) {
    std::vector<Vector3> positions = {{0, 0, std::tan(radians(inclination))}};
    std::vector<Triangle> triangles;
    for (unsigned k = 0; k < n; ++k) {
        const double angle = 2 * test::pi * k / n;
        positions.push_back({std::cos(angle), std::sin(angle), 0});
        triangles.push_back({0, k + 1, (k + 1) % n + 1});
    }
    return {positions, triangles};
}

// Smallest cosine between the normals of two faces at v.
double smallest_cosine(const CollapseMesh& mesh, Index v) {
    std::vector<Vector3> normals;
    mesh.for_each_face(v, [&](Index f, unsigned) { normals.push_back(mesh.normal(f)); });
    double smallest = 1;
    for (const Vector3& a : normals) {
        for (const Vector3& b : normals) smallest = std::min(smallest, a.dot(b));
    }
    return smallest;
}

}  // namespace

TEST_CASE("a vertex has a narrow normal cone if its normals are at most 120 degrees apart") {
    // Two faces at a ridge, with an increasing angle between their normals.
    for (const double half : {10.0, 40.0, 59.0, 61.0, 80.0}) {
        const double x = std::sin(radians(half)), z = std::cos(radians(half));
        // The face normals are (x, 0, z) and (-x, 0, z).
        const CollapseMesh roof({{0, 0, 0}, {0, 1, 0}, {z, 0.5, -x}, {-z, 0.5, -x}}, {{0, 2, 1}, {0, 1, 3}});
        CHECK(roof.normal(0).dot(roof.normal(1)) == Approx(std::cos(2 * radians(half))));
        CHECK(NormalCones().is_narrow(roof, 0) == (half < 60));
    }
    CHECK(NormalCones().is_narrow(test::collapse_mesh_of(test::grid(2)), 4));
}

TEST_CASE("the normal cone of a high-valence vertex is that of its faces") {
    for (const double inclination : {0.0, 20.0, 50.0, 59.0, 61.0, 80.0}) {
        const CollapseMesh mesh = pyramid(400, inclination);
        REQUIRE(mesh.is_high_valence(0));
        NormalCones cones;
        CHECK(cones.is_narrow(mesh, 0) == (inclination < 60));
        CHECK(cones.is_narrow(mesh, 0) == (inclination < 60));  // now cached
    }
}

TEST_CASE("a cached normal cone follows the collapses at and beside the vertex") {
    CollapseMesh mesh = pyramid(400, 50);
    NormalCones cones;
    REQUIRE(cones.is_narrow(mesh, 0));
    const Vector3 rim = mesh.position(1);
    mesh.collapse(1, 2, {rim.x(), rim.y(), -20});  // two faces are now almost vertical
    cones.after_collapse(mesh, 1);
    REQUIRE(smallest_cosine(mesh, 0) < -0.5);
    CHECK_FALSE(cones.is_narrow(mesh, 0));
    mesh.collapse(1, 3, rim);
    cones.after_collapse(mesh, 1);
    CHECK(cones.is_narrow(mesh, 0));
    mesh.collapse(0, 1, {0, 0, 20});
    cones.after_collapse(mesh, 0);
    CHECK_FALSE(cones.is_narrow(mesh, 0));
}

TEST_CASE("a narrow normal cone never contains normals more than 120 degrees apart, after any collapses") {
    std::mt19937 random(7);
    CollapseMesh mesh = pyramid(700, 40);
    NormalCones cones;
    unsigned narrow = 0, wide = 0;
    for (Index v = 3; v < 400; v += 3) {
        const bool lowered = random() % 8 == 0;
        const Vector3 p = mesh.position(v);
        mesh.collapse(v, v + 1, lowered ? Vector3(p.x(), p.y(), -20) : p);
        cones.after_collapse(mesh, v);
        const bool is_narrow = cones.is_narrow(mesh, 0);
        ++(is_narrow ? narrow : wide);
        if (is_narrow) CHECK(smallest_cosine(mesh, 0) >= -0.5 - 1e-9);
        if (!lowered) continue;
        mesh.collapse(v, v + 2, p);
        cones.after_collapse(mesh, v);
        CHECK(cones.is_narrow(mesh, 0) == (smallest_cosine(mesh, 0) >= -0.5));
    }
    CHECK(narrow > 0);
    CHECK(wide > 0);
}

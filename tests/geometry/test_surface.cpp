#include "faqem/detail/geometry/surface.hpp"

#include "faqem/error.hpp"
#include "support/catch.hpp"
#include "support/meshes.hpp"

using namespace faqem;
using detail::Surface;
using engine::Vector3;

TEST_CASE("surface: degenerate faces and unreferenced and duplicate positions are left out") {
    TriangleMesh mesh = test::both(test::quad(), test::quad());
    mesh.positions.push_back({9, 9, 9});
    mesh.triangles.push_back({0, 0, 1});
    const Surface surface = detail::extract_nonempty_surface(mesh.view(), "mesh");
    CHECK(surface.positions.size() == 4);
    CHECK(surface.triangles.size() == 4);
    CHECK(surface.faces == std::vector<Index>{0, 1, 2, 3});
    CHECK(surface.cumulative_area.back() == Approx(2));
    CHECK(surface.diagonal() == Approx(std::sqrt(2.0)));
    CHECK_THROWS_AS(detail::extract_nonempty_surface(TriangleMesh().view(), "mesh"), InputError);
}

TEST_CASE("surface: max_normal_cosine() considers both faces at an edge, and one face elsewhere") {
    // A point beyond an edge of the cube is equally close to a top face and a front face.
    const TriangleMesh cube = test::cube();
    const Surface surface = detail::extract_nonempty_surface(cube.view(), "cube");
    const detail::Bvh tree(surface.positions, surface.triangles);
    const auto cosine = [&](const Vec3& p, const Vector3& normal) {
        return detail::max_normal_cosine(tree, surface.normals, p, tree.closest(p), normal, 1e-9);
    };
    CHECK(cosine({0.4, -1, 2}, {0, 0, 1}) == 1);
    CHECK(cosine({0.4, -1, 2}, {0, -1, 0}) == 1);
    CHECK(cosine({0.4, -1, 2}, {1, 0, 0}) == 0);
    CHECK(cosine({0.4, 0.3, 2}, {0, 0, 1}) == 1);
    CHECK(cosine({0.4, 0.3, 2}, {0, -1, 0}) == 0);
}

TEST_CASE("surface: CoherentQuery agrees with the BVH") {
    const TriangleMesh mesh = test::shaken(test::icosphere(2), 0.05, 4);
    const Surface surface = detail::extract_nonempty_surface(mesh.view(), "mesh");
    const detail::Bvh tree(surface.positions, surface.triangles);
    detail::CoherentQuery query(surface, tree);
    test::Random random(1);
    for (int i = 0; i < 200; ++i) {
        const Vec3 p = {random.between(-2, 2), random.between(-2, 2), random.between(-2, 2)};
        CHECK(query(p).distance_squared == tree.closest(p).distance_squared);
        CHECK(query(p, random.below(surface.triangles.size())).face == tree.closest(p).face);
    }
}

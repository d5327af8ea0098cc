#include <array>
#include <cstddef>

#include "faqem/compare.hpp"
#include "faqem/detail/geometry/bvh.hpp"
#include "faqem/detail/measure/covering.hpp"
#include "support/brute_force.hpp"
#include "support/catch.hpp"
#include "support/meshes.hpp"

using namespace faqem;
using test::infinity;

namespace {

// The bound for a triangle, grown from the face of `surface` that is closest to its middle.
double bound(const TriangleMesh& surface, const std::array<Vec3, 3>& triangle, double limit) {
    const detail::Surface to = detail::extract_surface(surface.view());
    const detail::Covering covering(to);
    detail::Covering::Scratch scratch(covering);
    std::array<engine::Vector3, 3> corner;
    for (std::size_t k = 0; k < 3; ++k) corner[k] = engine::to_eigen(triangle[k]);
    const Vec3 middle = engine::to_array((corner[0] + corner[1] + corner[2]) / 3);
    const Index first = detail::Bvh(to.positions, to.triangles).closest(middle).face;
    return covering.bound(corner, first, limit, scratch);
}

constexpr std::array<Vec3, 3> large = {Vec3{2.1, 2.3, 0}, {17.2, 3.4, 0}, {5.5, 16.6, 0}};

}  // namespace

TEST_CASE("covering: the bound over a plane of many faces is the height and the share that it shrinks") {
    const TriangleMesh plane = test::moved(test::grid(20), {0, 0, 0.5});
    CHECK(bound(plane, large, 1) == Approx(0.5 + 1.0 / 8));
    CHECK(bound(plane, {large[0], large[2], large[1]}, 1) == Approx(0.5 + 1.0 / 8));
    CHECK(bound(plane, large, 0.58) == Approx(0.5 + 0.58 / 8));
    CHECK(bound(plane, large, 0.57) == infinity);  // 7/8 of it are below the height
    // Exact coincidence, with the rim as well, far from the origin.
    const Vec3 far = {500'000, 4'000'000, 100};
    CHECK(bound(test::moved(test::grid(20), far), {far, {500'020, 4'000'000, 100}, {500'020, 4'000'020, 100}},
                1e-3) == Approx(1e-3 / 8));
}

TEST_CASE("covering: there is no bound where a face is missing or doubled") {
    TriangleMesh plane = test::grid(20);
    const Index in_triangle = 2 * (8 * 20 + 8);  // the square from (8, 8) to (9, 9)
    TriangleMesh doubled = plane, torn = plane;
    doubled.triangles.push_back(plane.triangles[in_triangle]);
    torn.triangles.erase(torn.triangles.begin() + in_triangle);
    CHECK(bound(plane, large, 1) < 1);
    CHECK(bound(doubled, large, 1) == infinity);
    CHECK(bound(torn, large, 1) == infinity);
    torn = test::grid(20);
    torn.triangles.erase(torn.triangles.begin() + 2 * (18 * 20 + 18));  // outside the triangle
    CHECK(bound(torn, large, 1) < 1);
}

TEST_CASE("covering: a peak above the triangle counts with its height, one beside it does not") {
    TriangleMesh plane = test::grid(20);
    plane.positions[8 + 21 * 8][2] = -0.7;
    CHECK(bound(plane, large, 1) == Approx(0.7 + 1.0 / 8));
    CHECK(bound(plane, large, 0.7) == infinity);
    plane.positions[8 + 21 * 8][2] = 0;
    plane.positions[18 + 21 * 18][2] = 5;
    CHECK(bound(plane, large, 1) == Approx(1.0 / 8));
}

TEST_CASE("covering: faces without area connect the faces beside them") {
    // A strip of large squares at a strip of small ones: the faces at the T-junctions have no area.
    TriangleMesh mesh =
        test::make({{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {1, 2, 0}, {0, 4, 0}, {2, 4, 0}},
                   {{0, 1, 2}, {0, 2, 3}, {3, 4, 5}, {4, 6, 5}, {4, 2, 6}, {3, 2, 4}});
    const std::array<Vec3, 3> triangle = {Vec3{0.1, 0.1, 0.01}, {1.9, 0.1, 0.01}, {0.9, 3.9, 0.01}};
    CHECK(bound(mesh, triangle, 0.1) == Approx(0.01 + 0.1 / 8));
    mesh.triangles.pop_back();
    CHECK(bound(mesh, triangle, 0.1) == infinity);
}

TEST_CASE("covering: bounds are never below the distances of samples") {
    const TriangleMesh coarse = test::lump(1);
    const auto distance = [](const std::array<Vec3, 3>& t, const TriangleMesh& to) {
        return test::sampled_distance(test::make({t[0], t[1], t[2]}, {{0, 1, 2}}), to, 24);
    };
    std::size_t found = 0;
    for (const TriangleMesh& surface :
         {test::lump(3), test::shaken(test::icosphere(3), 0.04, 5), test::soup(1, 60, 300)}) {
        for (std::size_t f = 0; f < coarse.triangles.size(); f += 4) {
            std::array<Vec3, 3> triangle;
            for (std::size_t k = 0; k < 3; ++k) triangle[k] = coarse.positions[coarse.triangles[f][k]];
            for (const double limit : {0.05, 0.1, 0.2, 0.4}) {
                const double most = bound(surface, triangle, limit);
                if (most == infinity) continue;
                ++found;
                CHECK(most <= limit);
                CHECK(most >= distance(triangle, surface));
            }
        }
    }
    CHECK(found > 40);
}

TEST_CASE("covering: two faces and a plate of many, 12 and a box of many have distance 0 after few pieces") {
    const TriangleMesh plate = test::square(100, 1, 0), two = test::square(1, 1, 0);
    const DistanceBound flat = hausdorff(plate.view(), two.view());
    CHECK(flat.bound < 1e-8);
    CHECK(flat.pieces <= 8);
    const DistanceBound box = hausdorff(test::fine_cube(30).view(), test::cube().view());
    CHECK(box.bound < 1e-8);
    CHECK(box.pieces <= 48);
}

// Pictures of meshes that tell which point is seen.

#include "render/visible_points.hpp"

#include <cmath>
#include <tuple>

#include "support/catch.hpp"
#include "support/scenes.hpp"

using namespace faqem;
using namespace faqem::render;
using namespace faqem::test;

namespace {

std::vector<Vector3> positions(const Part& part, double height) {
    std::vector<Vector3> result;
    for (const Vec3& p : part.positions) result.emplace_back(p[0], p[1], p[2] + height);
    return result;
}

// Shows the square from 0 to 1 at height 0.
Camera from_above() {
    Camera camera;
    camera.eye = {0.5, 0.5, 2.5};
    return camera;
}

}  // namespace

TEST_CASE("visible points: each pixel shows the point of the nearest face under its centre") {
    const Part part = faqem::test::square();
    const std::vector<Vector3> low = positions(part, -1), high = positions(part, 0);
    const std::vector<PlacedMesh> meshes = {
        {low, part.triangles}, {high, part.triangles}, {high, part.triangles}};
    const std::vector<VisiblePoint> points = visible_points(meshes, from_above(), 4);
    REQUIRE(points.size() == 16);
    for (std::size_t i = 0; i < points.size(); ++i) {
        INFO("pixel " << i);
        CHECK(points[i].mesh == 1);  // of two at the same height, the first
        Vec3 at{};
        for (std::size_t k = 0; k < 3; ++k)
            for (std::size_t axis = 0; axis < 3; ++axis)
                at[axis] +=
                    points[i].barycentric[k] * part.positions[part.triangles[points[i].face][k]][axis];
        CHECK(at[0] == Approx((static_cast<double>(i % 4) + 0.5) / 4));
        CHECK(at[1] == Approx(1 - (static_cast<double>(i / 4) + 0.5) / 4));
    }
}

TEST_CASE("visible points: barycentric coordinates are those on a face that recedes") {
    const Part part = faqem::test::square();
    std::vector<Vector3> receding = positions(part, 0);
    for (Vector3& p : receding) p.z() = -5 * p.x();
    const std::vector<PlacedMesh> meshes = {{receding, part.triangles}};
    Camera camera = from_above();
    camera.eye.x() = 0;
    const std::uint32_t size = 16;
    const std::vector<VisiblePoint> points = visible_points(meshes, camera, size);
    const VisiblePoint& seen = points[7 * size + 9];
    REQUIRE(seen.mesh == 0);
    Vector3 at = Vector3::Zero();
    for (std::size_t k = 0; k < 3; ++k) at += seen.barycentric[k] * receding[part.triangles[seen.face][k]];
    // The ray through the pixel's centre: x is 3 / 16 of half the picture's side at a depth of 2.5 + 5 x.
    const double slope = 3.0 / 16 * camera.tan_half_fov;
    CHECK(at.x() == Approx(2.5 * slope / (1 - 5 * slope)));
}

TEST_CASE(
    "visible points: nothing is seen beside the meshes or behind the camera, and faces without area or with "
    "huge "
    "coordinates are left out") {
    const Part part = faqem::test::square();
    const std::vector<Vector3> own = positions(part, 0);
    const auto sees_nothing = [](const PlacedMesh& mesh, const Camera& camera) {
        for (const VisiblePoint& point : visible_points({&mesh, 1}, camera, 3))
            if (point.mesh != no_index) return false;
        return true;
    };
    const PlacedMesh mesh{own, part.triangles};
    CHECK_FALSE(sees_nothing(mesh, from_above()));
    const std::vector<Triangle> without_area = {{0, 1, 1}};
    CHECK(sees_nothing({own, without_area}, from_above()));
    std::vector<Vector3> huge = own;
    for (Vector3& p : huge) p *= 1e308;
    CHECK(visible_points(std::vector<PlacedMesh>{{huge, part.triangles}}, from_above(), 3).size() == 9);
    Camera beside = from_above(), below = from_above();
    beside.eye.x() = 5;
    below.eye.z() = -2;
    CHECK(sees_nothing(mesh, beside));
    CHECK(sees_nothing(mesh, below));
}

TEST_CASE("visible points: a face that is seen from one side only hides nothing from the other side") {
    const Part part = faqem::test::square();
    const std::vector<Vector3> low = positions(part, -1), high = positions(part, 0);
    const std::vector<std::int8_t> front(part.triangles.size(), 1), back(part.triangles.size(), -1);
    Camera below;
    below.eye = {0.5, 0.5, -3.5};
    below.right = -below.right, below.back = -below.back;
    for (const auto& [sides, from_above_sees, from_below_sees] :
         {std::tuple(&front, 1u, 0u), std::tuple(&back, 0u, 1u)}) {
        const std::vector<PlacedMesh> meshes = {{low, part.triangles}, {high, part.triangles, *sides}};
        CHECK(visible_points(meshes, from_above(), 3)[4].mesh == from_above_sees);
        CHECK(visible_points({&meshes[1], 1}, below, 3)[4].mesh == (from_below_sees ? 0u : no_index));
    }
}

TEST_CASE("cameras in even directions show the whole scene") {
    const Part part = faqem::test::square();
    const std::vector<Vector3> low = positions(part, -3), high = positions(part, 4);
    const std::vector<PlacedMesh> meshes = {{low, part.triangles}, {high, part.triangles}};
    std::vector<Camera> cameras;
    for (const Vector3& direction : even_directions(6)) cameras.push_back(camera_from(direction));
    REQUIRE(show_all(meshes, cameras));
    for (const Camera& camera : cameras) {
        CHECK(camera.right.dot(camera.up) == Approx(0).margin(1e-12));
        CHECK(camera.right.cross(camera.up).dot(camera.back) == Approx(1));
        for (const PlacedMesh& mesh : meshes) {
            for (const Vector3& p : mesh.positions) {
                const ScreenPoint seen = project(camera, p, 32);
                CHECK(seen.inverse_depth > 0);
                CHECK(std::abs(seen.at.x() - 16) <= 16);
                CHECK(std::abs(seen.at.y() - 16) <= 16);
            }
        }
    }
}

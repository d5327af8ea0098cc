// Pictures of meshes that tell which point is seen.

#include <cmath>

#include "bake/keep/seen_points.hpp"
#include "support/catch.hpp"
#include "support/scenes.hpp"

using namespace faqem;
using namespace faqem::test;
using detail::PlacedMesh;
using detail::SeenPoint;
using engine::Vector3;

namespace {

PlacedMesh placed(Index index, const Part& part, double height) {
    PlacedMesh result{index, part.triangles, {}};
    for (const Vec3& p : part.positions) result.positions.emplace_back(p[0], p[1], p[2] + height);
    return result;
}

detail::View from_above(std::uint32_t size) {
    return {Vector3::UnitX(), Vector3::UnitY(), Vector3::UnitZ(), Vector3(0.5, 0.5, 0), 1.0 / size, size};
}

}  // namespace

TEST_CASE("seen points: each pixel shows the point of the nearest face under its centre") {
    const Part part = square();
    const std::vector<PlacedMesh> meshes = {placed(0, part, 0), placed(1, part, 1), placed(2, part, 1)};
    const std::vector<SeenPoint> points = detail::seen_points(meshes, from_above(4));
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

TEST_CASE(
    "seen points: nothing is seen beside the meshes, and faces without area or with huge coordinates are "
    "left out") {
    Part part = square();
    part.triangles = {{0, 1, 1}};
    std::vector<PlacedMesh> meshes = {placed(0, part, 0)};
    for (const SeenPoint& point : detail::seen_points(meshes, from_above(3))) CHECK(point.mesh == no_index);
    part = square();
    meshes = {placed(0, part, 0)};
    meshes[0].positions[0] = Vector3(-1e308, 1e308, 0);
    CHECK(detail::seen_points(meshes, from_above(3)).size() == 9);
    detail::View beside = from_above(3);
    beside.center = Vector3(5, 5, 0);
    meshes = {placed(0, part, 0)};
    for (const SeenPoint& point : detail::seen_points(meshes, beside)) CHECK(point.mesh == no_index);
}

TEST_CASE("seen points: all views show the whole scene") {
    const Part part = square();
    const std::vector<PlacedMesh> meshes = {placed(0, part, -3), placed(1, part, 4)};
    for (const detail::View& view : detail::views_around(meshes, 6, 32)) {
        CHECK(view.right.dot(view.up) == Approx(0).margin(1e-12));
        CHECK(view.right.cross(view.up).dot(view.back) == Approx(1));
        for (const PlacedMesh& mesh : meshes) {
            for (const Vector3& p : mesh.positions) {
                const Vector3 from_center = (p - view.center) / view.pixel;
                CHECK(std::abs(from_center.dot(view.right)) <= 16.001);
                CHECK(std::abs(from_center.dot(view.up)) <= 16.001);
            }
        }
    }
}

#include "faqem/detail/fitting/closest_point_tracker.hpp"

#include <cmath>

#include "support/catch.hpp"
#include "support/meshes.hpp"

using namespace faqem;
using detail::MeshToReferenceTracker;
using detail::ReferenceSurface;
using detail::ReferenceToMeshTracker;
using engine::Vector3;
using test::quad_faces;
using test::quad_positions;

TEST_CASE("closest point tracker: residuals of a lifted square in both directions") {
    const ReferenceSurface original({quad_positions, quad_faces});
    std::vector<Vector3> lifted = quad_positions;
    for (Vector3& p : lifted) p.z() = 0.25;
    MeshToReferenceTracker there(original, quad_faces, {{0, {0.5, 0.25, 0.25}}, {1, {0, 0.5, 0.5}}});
    ReferenceToMeshTracker back({{{0.5, 0.25, 0}, {0, 0, 1}}}, quad_faces);
    there.update(lifted, 1);
    back.update(lifted, 1);
    for (std::size_t i = 0; i < 2; ++i) {
        CHECK((there.residual(i) - Vector3(0, 0, -0.25)).norm() < 1e-15);
        CHECK(there.correspondence(i).normal == Vector3(0, 0, 1));
    }
    CHECK((back.residual(0) - Vector3(0, 0, -0.25)).norm() < 1e-15);
    CHECK(back.sample(0).face == 0);
    CHECK((back.sample(0).position(lifted, quad_faces) - Vector3(0.5, 0.25, 0.25)).norm() < 1e-15);
}

TEST_CASE("closest point tracker: samples of flipped faces are replaced, others are kept") {
    const ReferenceSurface original({quad_positions, quad_faces});
    const std::vector<Vector3> bent = {{0, 0, 0.5}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    std::vector<Triangle> faces = {{0, 1, 2}, {0, 2, 3}, {0, 1, 3}};
    MeshToReferenceTracker there(original, faces, {{0, {1, 0, 0}}, {2, {0, 0, 1}}, {1, {0.5, 0.5, 0}}});
    there.update(bent, 1);
    faces[0] = {3, 1, 2}, faces[1] = {3, 0, 1};
    const std::vector<detail::SurfaceSample> samples = {{0, {0.5, 0.5, 0}}, {1, {0, 0.5, 0.5}}};
    there.replace_samples(std::vector<std::uint8_t>{1, 1, 0}, samples);
    there.update(bent, 1);
    REQUIRE(there.size() == 3);
    CHECK(there.sample(0).face == 2);
    CHECK(there.residual(0) == Vector3::Zero());
    CHECK(there.residual(1) == Vector3::Zero());
    CHECK((there.residual(2) - Vector3(0, 0, -0.25)).norm() < 1e-15);
}

TEST_CASE("closest point tracker: residuals that pass a vertex of a hundred faces are the shortest") {
    // A cone whose rim goes up and down, and a small triangle that moves over its apex.
    TriangleMesh cone = test::shaken(test::fan(100), 0.01, 3);
    cone.positions[0] = {0, 0, 1};
    std::vector<Vector3> at;
    for (const Vec3& p : cone.positions) at.emplace_back(p[0], p[1], p[2]);
    const ReferenceSurface original({at, cone.triangles});
    const std::vector<Triangle> one = {{0, 1, 2}};
    MeshToReferenceTracker there(original, one, {{0, {1, 0, 0}}, {0, {0, 0.5, 0.5}}});
    for (const double x : {-0.3, -0.02, 0.0, 0.03, 0.4}) {
        const std::vector<Vector3> moving = {{x, 0.01, 1.1}, {x + 0.1, 0.02, 0.9}, {x, 0.1, 1.0}};
        there.update(moving, 1);
        for (std::size_t i = 0; i < 2; ++i) {
            const Vector3 p = there.sample(i).position(moving, one);
            const double shortest = std::sqrt(original.tree.closest(engine::to_array(p)).distance_squared);
            CHECK(there.residual(i).norm() == Approx(shortest));
        }
    }
}

TEST_CASE("closest point tracker: the normal deviation at an edge is the smallest one") {
    // A step: a wall below the edge x = 0 with normal +x, and a floor beyond the edge with normal +z.
    const std::vector<Vector3> step = {{0, 0, 0}, {0, 1, 0}, {0, 0, -1}, {1, 0, 0}};
    const std::vector<Triangle> sides = {{0, 2, 1}, {0, 3, 1}};
    const ReferenceSurface original({step, sides});
    REQUIRE((original.normals[0] - Vector3(1, 0, 0)).norm() < 1e-15);
    REQUIRE((original.normals[1] - Vector3(0, 0, 1)).norm() < 1e-15);
    // A face with normal +z, and a sample that is first on the edge, then on the wall.
    const std::vector<Vector3> below = {{-1, 0, -0.5}, {1, 0, -0.5}, {0, 1, -0.5}};
    const std::vector<Triangle> one = {{0, 1, 2}};
    MeshToReferenceTracker there(original, one, {{0, {0.5, 0.5, 0}}});
    std::vector<Vector3> at_edge = below;
    for (Vector3& p : at_edge) p.z() = 0;
    there.update(at_edge, 1);
    there.measure_normal_deviations(1e-9, 1);
    CHECK(there.normal_deviation(0) == Approx(0).margin(1e-7));
    there.update(below, 1);
    there.measure_normal_deviations(1e-9, 1);
    CHECK(there.normal_deviation(0) == Approx(std::sqrt(2.0)));
}

TEST_CASE("closest point tracker: of two coincident opposite faces, the one with the same normal is used") {
    const std::vector<Triangle> back_first = {{0, 2, 1}, {0, 1, 2}};
    const ReferenceSurface original({quad_positions, back_first});
    const std::vector<Triangle> one = {{0, 1, 2}};
    MeshToReferenceTracker there(original, one, {{0, {0.5, 0.25, 0.25}}});
    there.update(quad_positions, 1);
    there.measure_normal_deviations(1e-9, 1);
    CHECK(there.normal_deviation(0) == Approx(0).margin(1e-7));
}

TEST_CASE("closest point tracker: tracked residuals are equal to or slightly longer than exact ones") {
    const TriangleMesh sphere = test::icosphere(3), simplified = test::icosphere(1);
    const std::vector<Vector3> fixed_points = test::vectors(sphere);
    const ReferenceSurface original({fixed_points, sphere.triangles});
    std::vector<detail::OrientedPoint> points = detail::oriented_vertices(original.mesh);
    const auto samples = detail::vertex_and_midpoint_samples(simplified.triangles);
    for (const double reach : {0.02, 0.2}) {
        std::vector<Vector3> positions = test::vectors(simplified);
        MeshToReferenceTracker there(original, simplified.triangles, samples);
        ReferenceToMeshTracker back(points, simplified.triangles);
        test::Random random(7);
        double sum = 0, sum_exact = 0;
        for (int round = 0; round < 12; ++round) {
            there.update(positions, 1 + round % 3);
            back.update(positions, 1 + round % 3);
            MeshToReferenceTracker there_exact(original, simplified.triangles, samples);
            ReferenceToMeshTracker back_exact(points, simplified.triangles);
            there_exact.update(positions, 1);
            back_exact.update(positions, 1);
            const auto check = [&](const Vector3& tracked, const Vector3& exact) {
                CHECK(tracked.norm() >= exact.norm() - 1e-14);
                sum += tracked.norm(), sum_exact += exact.norm();
            };
            for (std::size_t i = 0; i < there.size(); ++i) check(there.residual(i), there_exact.residual(i));
            for (std::size_t i = 0; i < back.size(); ++i) {
                check(back.residual(i), back_exact.residual(i));
                const Vector3 on = back.sample(i).position(positions, simplified.triangles);
                CHECK((on + back.residual(i) - points[i].position).norm() < 1e-14);
            }
            // Moves a few vertices in the first round, and all of them in the last one.
            for (Index v = 0; v < positions.size(); ++v) {
                if (random.below(12) > static_cast<Index>(round)) continue;
                for (int k = 0; k < 3; ++k) positions[v][k] += random.between(-reach, reach);
            }
        }
        CHECK(sum <= (reach < 0.1 ? 1.01 : 1.05) * sum_exact);
    }
}

TEST_CASE("closest point tracker: a point is tracked across a vertex to all faces of its one-ring") {
    // A fan of six faces around vertex 0. The sample moves around the vertex, and back across it.
    std::vector<Vector3> fan = {{0, 0, 0.2}};
    std::vector<Triangle> faces;
    for (Index k = 0; k < 6; ++k) {
        fan.push_back({std::cos(k * test::pi / 3), std::sin(k * test::pi / 3), 0});
        faces.push_back({0, 1 + k, 1 + (k + 1) % 6});
    }
    const ReferenceSurface original({fan, faces});
    const std::vector<Triangle> one = {{0, 1, 2}};
    MeshToReferenceTracker there(original, one, {{0, {1, 0, 0}}});
    for (const double angle : {0.1, 0.7, 3.5, 0.4}) {
        const Vector3 p(0.5 * std::cos(angle), 0.5 * std::sin(angle), 0.3);
        const std::vector<Vector3> at = {p, p + Vector3(1, 0, 0), p + Vector3(0, 1, 0)};
        there.update(at, 1);
        const auto hit = original.tree.closest(engine::to_array(p));
        CHECK((p + there.residual(0) - engine::to_eigen(hit.point)).norm() < 1e-15);
    }
}

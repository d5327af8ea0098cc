#include "faqem/detail/fitting/two_sided_error.hpp"

#include "support/catch.hpp"
#include "support/meshes.hpp"

using namespace faqem;
using detail::FaceDeviation;
using detail::ReferenceSurface;
using detail::TwoSidedError;
using engine::Vector3;
using test::quad_faces;
using test::quad_positions;

namespace {

const engine::RunContext one_thread(1), three_threads(3);

FaceDeviation sum(const std::vector<FaceDeviation>& deviations) {
    FaceDeviation all;
    for (const FaceDeviation& deviation : deviations) all.add(deviation);
    return all;
}

}  // namespace

TEST_CASE("two-sided error: a square moved along its normal has that distance in both directions") {
    const ReferenceSurface original({quad_positions, quad_faces});
    std::vector<Vector3> lifted = quad_positions;
    for (Vector3& p : lifted) p.z() = 0.25;
    TwoSidedError error(original, quad_faces, lifted, one_thread);
    REQUIRE_FALSE(error.empty());
    const std::vector<FaceDeviation> deviations = error.measure(lifted);
    REQUIRE(deviations.size() == 2);
    const std::size_t there = error.correspondences().size() - error.from_reference().size();
    for (const FaceDeviation& deviation : deviations)
        CHECK(deviation.max_squared_distance == Approx(1.0 / 16));
    CHECK(sum(deviations).squared_distance_sum ==
          Approx(static_cast<double>(error.correspondences().size()) / 16));
    // The normals are equal: only the offset per sample of the moved square is left.
    CHECK(sum(deviations).normal_deviation == Approx(0.005 * static_cast<double>(there)));
    for (const detail::Correspondence& correspondence : error.correspondences())
        CHECK((correspondence.residual - Vector3(0, 0, -0.25)).norm() < 1e-14);
    const std::vector<std::uint8_t> second = {0, 1};
    for (const detail::Correspondence& correspondence : error.correspondences_at(second))
        CHECK(correspondence.sample.face == 1);
}

TEST_CASE("two-sided error: the maximum distance is exact after any motion of the mesh") {
    const TriangleMesh sphere = test::icosphere(3), simplified = test::icosphere(1);
    const std::vector<Vector3> fine = test::vectors(sphere);
    const ReferenceSurface original({fine, sphere.triangles});
    std::vector<Vector3> positions = test::vectors(simplified);
    TwoSidedError one(original, simplified.triangles, positions, one_thread),
        three(original, simplified.triangles, positions, three_threads);
    one.measure(positions), three.measure(positions);
    test::Random random(3);
    for (int round = 0; round < 6; ++round) {
        for (Vector3& p : positions) {
            for (int k = 0; k < 3; ++k) p[k] += random.between(-0.2, 0.2);
        }
        const FaceDeviation again = sum(one.remeasure(positions)), threaded = sum(three.remeasure(positions));
        CHECK(again.max_squared_distance == threaded.max_squared_distance);
        CHECK(again.squared_distance_sum == threaded.squared_distance_sum);
        CHECK(again.normal_deviation == threaded.normal_deviation);
        TwoSidedError exact(original, simplified.triangles, positions, one_thread);
        // The samples of the mesh differ slightly, those of the original are the same.
        double farthest = 0, farthest_exact = 0;
        exact.measure(positions);
        for (std::size_t i = 0; i < exact.from_reference().size(); ++i) {
            farthest = std::max(farthest, one.from_reference().residual(i).norm());
            farthest_exact = std::max(farthest_exact, exact.from_reference().residual(i).norm());
            CHECK(one.from_reference().residual(i).norm() >=
                  exact.from_reference().residual(i).norm() - 1e-14);
        }
        CHECK(farthest == Approx(farthest_exact).epsilon(1e-12));
    }
}

TEST_CASE("two-sided error: all residuals are exact for a mesh much coarser than the original") {
    const TriangleMesh sphere = test::icosphere(4), simplified = test::icosphere(0);  // 5120 and 20 faces
    const std::vector<Vector3> fine = test::vectors(sphere);
    const ReferenceSurface original({fine, sphere.triangles});
    std::vector<Vector3> positions = test::vectors(simplified);
    TwoSidedError error(original, simplified.triangles, positions, one_thread);
    error.measure(positions);
    test::Random random(3);
    for (Vector3& p : positions) {
        for (int k = 0; k < 3; ++k) p[k] += random.between(-0.3, 0.3);
    }
    error.update_correspondences(positions);
    for (const detail::Correspondence& correspondence : error.correspondences()) {
        const std::size_t i = static_cast<std::size_t>(&correspondence - error.correspondences().data());
        if (i >= error.correspondences().size() - error.from_reference().size()) break;
        const Vector3 p = correspondence.sample.position(positions, simplified.triangles);
        const auto hit = original.tree.closest(engine::to_array(p));
        CHECK(correspondence.residual.squaredNorm() == Approx(hit.distance_squared).margin(1e-28));
    }
}

TEST_CASE("two-sided error: flipped triangles get samples according to their new areas") {
    // A sliver 0 1 2 next to a large triangle; after an edge flip both have about the same area.
    const std::vector<Vector3> at = {{0, 0, 0}, {4, 0, 0}, {2, 0.01, 0}, {2, 2, 0}};
    std::vector<Triangle> faces = {{0, 1, 2}, {0, 2, 3}, {2, 1, 3}};
    const std::vector<Triangle> whole = {{0, 1, 3}};
    const ReferenceSurface original({at, whole});
    TwoSidedError error(original, faces, at, one_thread);
    error.measure(at);
    const auto points_on = [&](Index face) {
        const auto correspondences = error.correspondences();
        return std::count_if(
            correspondences.begin(),
            correspondences.end() - static_cast<std::ptrdiff_t>(error.from_reference().size()),
            [&](const detail::Correspondence& correspondence) { return correspondence.sample.face == face; });
    };
    CHECK(points_on(0) < 50);
    CHECK(points_on(1) > 2000);
    // The edge 0 2 is flipped: the triangles are now 0 1 3 and 1 2 3.
    faces[0] = {0, 1, 3}, faces[1] = {1, 2, 3};
    error.resample_flipped(at, std::vector<std::uint8_t>{1, 1, 0});
    error.measure(at);
    CHECK(points_on(0) > 2000);
    CHECK(points_on(2) > 2000);
}

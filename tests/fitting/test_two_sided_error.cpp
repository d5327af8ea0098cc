#include "faqem/detail/fitting/two_sided_error.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "support/meshes.hpp"

using namespace faqem;
using detail::Fit;
using detail::StillSurface;
using detail::TwoSidedGaps;
using engine::Vector3;

namespace {

Fit sum(const std::vector<Fit>& fits) {
    Fit all;
    for (const Fit& fit : fits) all.add(fit);
    return all;
}

// The unit square in the plane z = 0 as two triangles.
const std::vector<Vector3> square = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
const std::vector<Triangle> halves = {{0, 1, 2}, {0, 2, 3}};

}  // namespace

TEST_CASE("two sided gaps: a square that is lifted by a quarter is a quarter away on both sides") {
    const StillSurface original({square, halves});
    std::vector<Vector3> lifted = square;
    for (Vector3& p : lifted) p.z() = 0.25;
    TwoSidedGaps gaps(original, halves, lifted, 1);
    REQUIRE_FALSE(gaps.empty());
    const std::vector<Fit> fits = gaps.measure(lifted);
    REQUIRE(fits.size() == 2);
    const std::size_t there = gaps.pulls().size() - gaps.back().size();
    for (const Fit& fit : fits) CHECK(fit.farthest == Approx(1.0 / 16));
    CHECK(sum(fits).distance == Approx(static_cast<double>(gaps.pulls().size()) / 16));
    // Nothing turns: only what is counted for each point of the lifted square.
    CHECK(sum(fits).turn == Approx(0.005 * static_cast<double>(there)));
    for (const detail::Pull& pull : gaps.pulls()) CHECK((pull.gap - Vector3(0, 0, -0.25)).norm() < 1e-14);
    const std::vector<std::uint8_t> second = {0, 1};
    for (const detail::Pull& pull : gaps.pulls_at(second)) CHECK(pull.spot.face == 1);
}

TEST_CASE("two sided gaps: the farthest point is what a search finds, however the mesh has moved") {
    const TriangleMesh sphere = test::icosphere(3), light = test::icosphere(1);
    const std::vector<Vector3> fine = test::vectors(sphere);
    const StillSurface original({fine, sphere.triangles});
    std::vector<Vector3> positions = test::vectors(light);
    TwoSidedGaps one(original, light.triangles, positions, 1), three(original, light.triangles, positions, 3);
    one.measure(positions), three.measure(positions);
    test::Random random(3);
    for (int round = 0; round < 6; ++round) {
        for (Vector3& p : positions) {
            for (int k = 0; k < 3; ++k) p[k] += random.between(-0.2, 0.2);
        }
        const Fit again = sum(one.measure_again(positions)), threaded = sum(three.measure_again(positions));
        CHECK(again.farthest == threaded.farthest);
        CHECK(again.distance == threaded.distance);
        CHECK(again.turn == threaded.turn);
        TwoSidedGaps anew(original, light.triangles, positions, 1);
        // The points on the mesh are others by a little, the original's are the same.
        double farthest = 0, farthest_anew = 0;
        anew.measure(positions);
        for (std::size_t i = 0; i < anew.back().size(); ++i) {
            farthest = std::max(farthest, one.back().gap(i).norm());
            farthest_anew = std::max(farthest_anew, anew.back().gap(i).norm());
            CHECK(one.back().gap(i).norm() >= anew.back().gap(i).norm() - 1e-14);
        }
        CHECK(farthest == Approx(farthest_anew).epsilon(1e-12));
    }
}

TEST_CASE("two sided gaps: a coarse mesh is measured by searches alone") {
    const TriangleMesh sphere = test::icosphere(4), light = test::icosphere(0);  // 5120 and 20 faces
    const std::vector<Vector3> fine = test::vectors(sphere);
    const StillSurface original({fine, sphere.triangles});
    std::vector<Vector3> positions = test::vectors(light);
    TwoSidedGaps gaps(original, light.triangles, positions, 1);
    gaps.measure(positions);
    test::Random random(3);
    for (Vector3& p : positions) {
        for (int k = 0; k < 3; ++k) p[k] += random.between(-0.3, 0.3);
    }
    gaps.measure_pulls(positions);
    for (const detail::Pull& pull : gaps.pulls()) {
        const std::size_t i = static_cast<std::size_t>(&pull - gaps.pulls().data());
        if (i >= gaps.pulls().size() - gaps.back().size()) break;
        const Vector3 p = pull.spot.on(positions, light.triangles);
        const auto hit = original.tree.closest(engine::to_array(p));
        CHECK(pull.gap.squaredNorm() == Approx(hit.distance_squared).margin(1e-28));
    }
}

TEST_CASE("two sided gaps: swapped triangles get points by their new areas") {
    //  A sliver 0 1 2 beside a large triangle: swapped, they share the area.
    const std::vector<Vector3> at = {{0, 0, 0}, {4, 0, 0}, {2, 0.01, 0}, {2, 2, 0}};
    std::vector<Triangle> faces = {{0, 1, 2}, {0, 2, 3}, {2, 1, 3}};
    const std::vector<Triangle> whole = {{0, 1, 3}};
    const StillSurface original({at, whole});
    TwoSidedGaps gaps(original, faces, at, 1);
    gaps.measure(at);
    const auto points_on = [&](Index face) {
        const auto pulls = gaps.pulls();
        return std::count_if(pulls.begin(), pulls.end() - static_cast<std::ptrdiff_t>(gaps.back().size()),
                             [&](const detail::Pull& pull) { return pull.spot.face == face; });
    };
    CHECK(points_on(0) < 50);
    CHECK(points_on(1) > 2000);
    // Over the edge 0 2: triangles 0 1 3 and 1 2 3 now.
    faces[0] = {0, 1, 3}, faces[1] = {1, 2, 3};
    gaps.swap(at, std::vector<std::uint8_t>{1, 1, 0});
    gaps.measure(at);
    CHECK(points_on(0) > 2000);
    CHECK(points_on(2) > 2000);
}

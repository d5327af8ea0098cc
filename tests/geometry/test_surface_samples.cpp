#include "faqem/detail/geometry/surface_samples.hpp"

#include <algorithm>
#include <cmath>

#include "support/catch.hpp"

using namespace faqem;
using detail::SurfaceSample;
using engine::Vector3;

namespace {

// c       Two triangles in the plane z = 0, and a removed one between them.
// | \     The area of abc is three times that of bde.
// |   \ /e
// a----b--d
const std::vector<Vector3> sampled_positions = {{0, 0, 0}, {3, 0, 0}, {0, 2, 0}, {5, 0, 0}, {4, 1, 0}};
const std::vector<Triangle> sampled_faces = {{0, 1, 2}, {no_index, no_index, no_index}, {1, 3, 4}};

}  // namespace

TEST_CASE("surface samples: distributed uniformly by area and sorted by face") {
    const std::vector<SurfaceSample> samples =
        detail::area_uniform_samples({sampled_positions, sampled_faces}, 400);
    REQUIRE(samples.size() == 400);
    CHECK(std::count_if(samples.begin(), samples.end(), [](const SurfaceSample& s) { return s.face == 0; }) ==
          300);
    CHECK(std::is_sorted(samples.begin(), samples.end(),
                         [](const SurfaceSample& a, const SurfaceSample& b) { return a.face < b.face; }));
    Vector3 mean = Vector3::Zero();
    for (const SurfaceSample& sample : samples) {
        CHECK(sample.face != 1);
        CHECK(std::min({sample.barycentric[0], sample.barycentric[1], sample.barycentric[2]}) >= 0);
        CHECK(sample.barycentric[0] + sample.barycentric[1] + sample.barycentric[2] == Approx(1));
        if (sample.face == 0) mean += sample.position(sampled_positions, sampled_faces) / 300;
    }
    CHECK((mean - Vector3(1, 2.0 / 3, 0)).norm() < 0.01);
}

TEST_CASE("surface samples: none without area") {
    const std::vector<Triangle> flat = {{0, 1, 3}};
    CHECK(detail::area_uniform_samples({sampled_positions, flat}, 10).empty());
    CHECK(detail::area_uniform_samples({sampled_positions, {}}, 10).empty());
}

TEST_CASE("surface samples: each vertex once, each edge midpoint once per face") {
    const std::vector<SurfaceSample> samples = detail::vertex_and_midpoint_samples(sampled_faces);
    CHECK(samples.size() == 5 + 6);
    const auto at = [&](const Vector3& p) {
        return std::count_if(samples.begin(), samples.end(), [&](const SurfaceSample& s) {
            return (s.position(sampled_positions, sampled_faces) - p).norm() < 1e-15;
        });
    };
    for (const Vector3& p : sampled_positions) CHECK(at(p) == 1);
    CHECK(at({1.5, 1, 0}) == 1);
    CHECK(at({4.5, 0.5, 0}) == 1);
}

TEST_CASE("surface samples: vertices have the mean normal of their faces, unreferenced ones are left out") {
    // A vertical face of the same area as abc, adjacent to it along ab.
    const std::vector<Vector3> corner = {{0, 0, 0}, {3, 0, 0}, {0, 2, 0}, {9, 9, 9}, {0, 0, 2}};
    const std::vector<Triangle> both = {{0, 1, 2}, {1, 0, 4}};
    const auto points = detail::oriented_vertices({corner, both});
    REQUIRE(points.size() == 4);
    CHECK((points[0].normal - Vector3(0, 1, 1) / std::sqrt(2.0)).norm() < 1e-15);
    CHECK(points[2].normal == Vector3(0, 0, 1));
    CHECK(points[3].position == corner[4]);
    CHECK(points[3].normal == Vector3(0, 1, 0));
}

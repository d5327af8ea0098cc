#include "faqem/detail/geometry/random_sampling.hpp"

#include <set>

#include "support/catch.hpp"
#include "support/meshes.hpp"

using namespace faqem;
using detail::RandomSample;
using detail::Surface;

namespace {

constexpr std::uint64_t sample_count = 2000;

}  // namespace

TEST_CASE("random samples: positions agree with the barycentric coordinates") {
    const TriangleMesh mesh = test::icosphere(1);
    const Surface surface = detail::extract_nonempty_surface(mesh.view(), "mesh");
    for (std::uint64_t i = 0; i < sample_count; ++i) {
        const RandomSample s = detail::sample(surface, i, sample_count, 1);
        REQUIRE(s.face < surface.triangles.size());
        engine::Vector3 p = engine::Vector3::Zero();
        for (std::size_t k = 0; k < 3; ++k) {
            CHECK(s.barycentric[k] >= 0);
            p += s.barycentric[k] * surface.corner(s.face, k);
        }
        CHECK(s.barycentric[0] + s.barycentric[1] + s.barycentric[2] == Approx(1));
        CHECK((p - engine::to_eigen(s.point)).norm() < 1e-15);
    }
}

TEST_CASE("random samples: stratified by area, so that the samples of a face are proportional to its area") {
    // Two triangles, the second with three times the area of the first.
    const TriangleMesh mesh = test::make({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {3, 0, 1}, {0, 0, 1}, {0, 1, 1}},
                                         {{0, 1, 2}, {4, 3, 5}});
    const Surface surface = detail::extract_nonempty_surface(mesh.view(), "mesh");
    std::uint64_t first = 0;
    for (std::uint64_t i = 0; i < sample_count; ++i)
        first += detail::sample(surface, i, sample_count, 3).face == 0;
    CHECK(first == sample_count / 4);
}

TEST_CASE("random samples: determined by index and seed") {
    const TriangleMesh mesh = test::cube();
    const Surface surface = detail::extract_nonempty_surface(mesh.view(), "mesh");
    std::set<Vec3> positions;
    for (std::uint64_t i = 0; i < 100; ++i) {
        const Vec3 p = detail::sample(surface, i, 100, 1).point;
        CHECK(p == detail::sample(surface, i, 100, 1).point);
        CHECK(p != detail::sample(surface, i, 100, 2).point);
        positions.insert(p);
    }
    CHECK(positions.size() == 100);
}

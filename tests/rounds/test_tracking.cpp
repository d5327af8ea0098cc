#include "faqem/detail/rounds/tracking.hpp"

#include <algorithm>
#include <numeric>
#include <vector>

#include "faqem/detail/simplify/spatial_order.hpp"
#include "faqem/engine/tracking/distance.hpp"
#include "support/applied_steps.hpp"
#include "support/catch.hpp"
#include "support/meshes.hpp"

using namespace faqem;
using namespace faqem::detail;

namespace {

const TriangleMesh& noisy() {
    static const TriangleMesh mesh = test::shaken(test::icosphere(5), 0.01, 3);
    return mesh;
}

// Rounds of a surface down to 2,048 faces, with distances tracked from `start` faces on.
struct Tracked {
    Tracked(std::size_t start, double weight, const RunContext& context = 2)
        : input(reorder(preprocess(noisy().view(), settings({})))),
          original(input.positions, input.triangles),
          vertex_map(input.positions.size()) {
        std::iota(vertex_map.begin(), vertex_map.end(), Index{0});
        const std::vector<std::uint8_t> locked(input.positions.size(), 0);
        ReorderedMesh copy = input;
        std::vector<Links> links;
        const RoundTracking tracking{&original, vertex_map, start, weight};
        left = *simplify_in_rounds(
            {copy.positions, copy.triangles, links, locked, {}, nullptr, Recording::on, &tracking}, 2048,
            Recording::on, context, found);
    }

    double squared_distance(Index face, const engine::Vector3& p) const {
        const Triangle& t = left.triangles[face];
        return engine::TriangleDistance(left.positions[t[0]], left.positions[t[1]], left.positions[t[2]])(p);
    }

    // The largest squared distance of an original vertex from the nearest face that is left.
    double farthest() const {
        double worst = 0;
        for (const engine::Vector3& p : input.positions) {
            double nearest = squared_distance(0, p);
            for (Index f = 1; f < left.triangles.size(); ++f)
                nearest = std::min(nearest, squared_distance(f, p));
            worst = std::max(worst, nearest);
        }
        return worst;
    }

    ReorderedMesh input;
    engine::OriginalSurface original;
    std::vector<Index> vertex_map;
    RoundSteps found;
    CompactedMesh left;
};

}  // namespace

TEST_CASE("tracked rounds: 1, 2 and 8 threads find the same collapses and the same bindings") {
    const Tracked one(8192, 1e-3, 1);
    CHECK(one.left.triangles.size() < 2100);
    CHECK(test::closed_manifold(one.left.triangles));
    for (const std::uint32_t threads : {2u, 8u}) {
        const Tracked more(8192, 1e-3, threads);
        CHECK(test::same_steps(more.found, one.found));
        CHECK(more.left.bound_faces == one.left.bound_faces);
    }
}

TEST_CASE("tracked rounds: every original vertex is bound to a face that is about the nearest one") {
    const Tracked rounds(8192, 1e-3);
    REQUIRE(rounds.left.bound_faces.size() == rounds.input.positions.size());
    double bound = 0, nearest_sum = 0;
    for (Index v = 0; v < rounds.input.positions.size(); ++v) {
        const engine::Vector3& p = rounds.input.positions[v];
        REQUIRE(rounds.left.bound_faces[v] < rounds.left.triangles.size());
        double nearest = rounds.squared_distance(0, p);
        for (Index f = 1; f < rounds.left.triangles.size(); ++f)
            nearest = std::min(nearest, rounds.squared_distance(f, p));
        bound += rounds.squared_distance(rounds.left.bound_faces[v], p);
        nearest_sum += nearest;
    }
    CHECK(bound < 1.02 * nearest_sum);
}

TEST_CASE("tracked rounds: a weight reduces the largest distance; without one, the collapses are the same") {
    const Tracked free(20'480, 0), held(20'480, 4 * 3.14 / 2048);
    CHECK(test::same_steps(free.found, Tracked(0, 1).found));
    CHECK(held.farthest() < 0.8 * free.farthest());
}

TEST_CASE(
    "tracked rounds: a surface that keeps more faces than those from which distances are tracked has no "
    "bindings") {
    const Tracked rounds(1000, 1e-3);
    CHECK(rounds.left.triangles.size() > 2000);
    CHECK(rounds.left.bound_faces.empty());
}

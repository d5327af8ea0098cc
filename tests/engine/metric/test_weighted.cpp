#include "faqem/engine/metric/weighted.hpp"

#include <limits>
#include <utility>

#include "faqem/compare.hpp"
#include "faqem/engine/metric/memoryless.hpp"
#include "faqem/engine/tracking/tracked_metric.hpp"
#include "faqem/error.hpp"
#include "faqem/simplify.hpp"
#include "support/catch.hpp"
#include "support/original.hpp"

using namespace faqem;
using namespace faqem::engine;

namespace {

static_assert(CollapseMetric<WeightedMetric<AccumulatedMetric>>);
static_assert(!WeightedMetric<MemorylessMetric>::has_exact_cost);
static_assert(WeightedMetric<TrackedMetric>::has_exact_cost);

bool is_upper(const TriangleMesh& mesh, const Triangle& t) {
    return mesh.positions[t[0]][2] + mesh.positions[t[1]][2] + mesh.positions[t[2]][2] > 0;
}

double upper_share(const TriangleMesh& mesh) {
    const auto upper = std::count_if(mesh.triangles.begin(), mesh.triangles.end(),
                                     [&](const Triangle& t) { return is_upper(mesh, t); });
    return static_cast<double>(upper) / static_cast<double>(mesh.triangles.size());
}

TriangleMesh upper_half(TriangleMesh mesh) {
    std::erase_if(mesh.triangles, [&](const Triangle& t) { return !is_upper(mesh, t); });
    return mesh;
}

// A bumpy sphere. The vertices of its upper half have the given weight, the others weight 1.
struct Globe {
    explicit Globe(float weight) {
        for (Vec3& p : mesh.positions) {
            const double r = 1 + 0.03 * std::sin(9 * p[0]) * std::cos(8 * p[1]) * std::sin(7 * p[2]);
            p = {r * p[0], r * p[1], r * p[2]};
            weights.push_back(p[2] > 0 ? weight : 1);
        }
    }
    SimplifyResult simplified(Preset preset) const {
        MeshView view{.positions = mesh.positions, .triangles = mesh.triangles, .vertex_weights = weights};
        return simplify(view, {.target = ratio(0.1), .preset = preset});
    }

    TriangleMesh mesh = test::icosphere(4);
    std::vector<float> weights;
};

// Calls visit(u, v, without, with) for every pair, with its candidates without and with weights.
template <class Metric, class Visit>
void for_each_pair(const CollapseMesh& collapse_mesh, const PairTable& pairs, Metric& plain,
                   WeightedMetric<Metric>& weighted, Visit&& visit) {
    plain.initialise(collapse_mesh, pairs);
    weighted.initialise(collapse_mesh, pairs);
    for (Index pair = 0; pair < pairs.size(); ++pair) {
        const Index u = pairs.first(pair), v = pairs.second(pair);
        const auto a = plain.evaluate(collapse_mesh, pairs, pair, AllowedPosition::anywhere);
        const auto b = weighted.evaluate(collapse_mesh, pairs, pair, AllowedPosition::anywhere);
        REQUIRE((a && b));
        visit(u, v, *a, *b);
    }
}

}  // namespace

TEST_CASE("vertex weights: the larger weight of both vertices multiplies the cost of a pair") {
    const TriangleMesh mesh = test::shaken(test::icosphere(1), 0.1, 1);
    const CollapseMesh collapse_mesh = test::collapse_mesh_of(mesh);
    const PairTable pairs(collapse_mesh, {});
    test::Random random(2);
    std::vector<double> weights;
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) weights.push_back(random.between(0.1, 10));
    MemorylessMetric plain;
    WeightedMetric weighted(MemorylessMetric(), weights);
    for_each_pair(collapse_mesh, pairs, plain, weighted,
                  [&](Index u, Index v, const Candidate& a, const Candidate& b) {
                      CHECK(a.point == b.point);
                      CHECK(weighted.weight(u, v) == std::max(weights[u], weights[v]));
                      CHECK(b.cost == Approx(a.cost * weighted.weight(u, v)));
                      CHECK(!weighted.evaluate(collapse_mesh, pairs, test::pair_of(pairs, u, v),
                                               AllowedPosition::nowhere));
                  });
}

TEST_CASE("vertex weights: exact costs are multiplied, too, and are at least the lower bound") {
    const TriangleMesh mesh = test::shaken(test::icosphere(1), 0.1, 1);
    const CollapseMesh collapse_mesh = test::collapse_mesh_of(mesh);
    const PairTable pairs(collapse_mesh, {});
    const std::vector<double> weights(mesh.positions.size(), 3);
    const test::OriginalOf original(mesh);
    TrackedMetric plain({}, original.surface, original.tracked, 80, 0.1);
    WeightedMetric weighted(TrackedMetric({}, original.surface, original.tracked, 80, 0.1), weights);
    for_each_pair(collapse_mesh, pairs, plain, weighted,
                  [&](Index u, Index v, const Candidate& a, const Candidate& b) {
                      const Index pair = test::pair_of(pairs, u, v);
                      const double refined = weighted.exact_cost(collapse_mesh, pairs, pair, b);
                      CHECK(refined == Approx(3 * plain.exact_cost(collapse_mesh, pairs, pair, a)));
                      CHECK(refined >= b.cost);
                  });
}

TEST_CASE("vertex weights: the weight of the new vertex is interpolated along the edge") {
    const TriangleMesh mesh = test::quad();
    const CollapseMesh collapse_mesh = test::collapse_mesh_of(mesh);
    const PairTable pairs(collapse_mesh, {});
    // Vertices 0 and 1 are at x = 0 and 1. The last position is beside the edge, the two before it are
    // beyond its ends.
    const std::pair<Vector3, double> places[] = {{{0, 0, 0}, 1},  {{1, 0, 0}, 9}, {{0.25, 0, 0}, 3},
                                                 {{-5, 0, 0}, 1}, {{7, 0, 0}, 9}, {{0.5, 3, -2}, 5}};
    for (const auto& [place, expected] : places) {
        CAPTURE(place.transpose());
        WeightedMetric metric(MemorylessMetric(), {1, 9, 0.5, 0.5});
        metric.initialise(collapse_mesh, pairs);
        metric.before_collapse(collapse_mesh, pairs, 0, 1, place);
        CHECK(metric.weight(0, 3) == expected);
    }
}

TEST_CASE("vertex weights: a cost that overflows gives no candidate") {
    const TriangleMesh mesh = test::scaled(test::tetrahedron(), 1e60);
    const CollapseMesh collapse_mesh = test::collapse_mesh_of(mesh);
    const PairTable pairs(collapse_mesh, {});
    WeightedMetric metric(MemorylessMetric(), {1e200, 1, 1, 1});
    metric.initialise(collapse_mesh, pairs);
    CHECK(!metric.evaluate(collapse_mesh, pairs, test::pair_of(pairs, 0, 1), AllowedPosition::at_first));
    CHECK(metric.evaluate(collapse_mesh, pairs, test::pair_of(pairs, 2, 3), AllowedPosition::at_first));
}

TEST_CASE("vertex weights: a region of weight 10 keeps more faces and has a smaller error") {
    const Globe even(1), tilted(10);
    const TriangleMesh upper = upper_half(even.mesh);
    for (const Preset preset : all_presets) {
        CAPTURE(name(preset));
        const SimplifyResult a = even.simplified(preset), b = tilted.simplified(preset);
        CHECK(b.report.faces_out <= b.report.target_faces);
        CHECK(upper_share(a.mesh) == Approx(0.5).margin(0.05));
        CHECK(upper_share(b.mesh) > 0.6);
        const OneSided before = compare(upper.view(), a.mesh.view(), {.samples = 20000}).a_to_b;
        const OneSided after = compare(upper.view(), b.mesh.view(), {.samples = 20000}).a_to_b;
        CHECK(after.mean_squared < 0.8 * before.mean_squared);
    }
}

TEST_CASE("vertex weights: a uniform weight does not change the result, lifted rules or deletions") {
    // A ring with a triangular cross-section cannot be collapsed under the link condition; beside it are
    // components to delete. A power of two as the weight keeps all costs exact.
    TriangleMesh mesh = test::shaken(test::torus(60, 3), 0.02, 1);
    for (int i = 0; i < 6; ++i)
        mesh =
            test::both(mesh, test::moved(test::scaled(test::tetrahedron(), 0.1 + 0.02 * i), {3.0 + i, 0, 0}));
    const std::vector<float> weights(mesh.positions.size(), 4);
    for (const Preset preset : all_presets) {
        CAPTURE(name(preset));
        Options options{.target = ratio(0.1), .preset = preset};
        const SimplifyResult plain = simplify(mesh.view(), options);
        MeshView view{.positions = mesh.positions, .triangles = mesh.triangles, .vertex_weights = weights};
        const SimplifyResult weighted = simplify(view, options);
        CHECK(weighted.mesh.positions == plain.mesh.positions);
        CHECK(weighted.mesh.triangles == plain.mesh.triangles);
        CHECK(weighted.report.rungs == plain.report.rungs);
        if (preset >= Preset::fast)
            CHECK(plain.report.rungs[static_cast<std::size_t>(Rung::without_link)] > 0);
    }
}

TEST_CASE("vertex weights: welded vertices have the largest of their weights") {
    // Each face has its own three vertices. Of those at one position, only one has the weight.
    const Globe globe(10);
    const TriangleMesh split = test::separated(globe.mesh);
    std::vector<float> weights, left = globe.weights;
    for (const Triangle& t : globe.mesh.triangles)
        for (const Index v : t) weights.push_back(std::exchange(left[v], 1.0f));
    MeshView view{.positions = split.positions, .triangles = split.triangles, .vertex_weights = weights};
    const SimplifyResult a = simplify(view, {.target = ratio(0.1)});
    const SimplifyResult b = globe.simplified(Preset::balanced);
    CHECK(a.report.faces_out == b.report.faces_out);
    CHECK(upper_share(a.mesh) == Approx(upper_share(b.mesh)).margin(0.01));
}

TEST_CASE("vertex weights: a weight out of range is an error that names the vertex") {
    const TriangleMesh mesh = test::quad();
    for (const float bad : {0.0f, -1.0f, 1e-7f, 2e6f, std::numeric_limits<float>::quiet_NaN(),
                            std::numeric_limits<float>::infinity()}) {
        CAPTURE(bad);
        const std::vector<float> weights = {1, 1e-6f, bad, 1e6f};
        MeshView view{.positions = mesh.positions, .triangles = mesh.triangles, .vertex_weights = weights};
        CHECK_THROWS_WITH(simplify(view), Catch::StartsWith("vertex 2: weight ") &&
                                              Catch::EndsWith(" is not in [1e-6, 1e6]"));
        CHECK_THROWS_AS(simplify(view), InputError);
    }
    const std::vector<float> few = {1, 1, 1};
    MeshView view{.positions = mesh.positions, .triangles = mesh.triangles, .vertex_weights = few};
    CHECK_THROWS_WITH(simplify(view), "vertex_weights: needs one entry per vertex or none, but has 3 for 4");
}

#include "faqem/detail/simplify/budget_by_cost.hpp"

#include "faqem/compare.hpp"
#include "faqem/options.hpp"
#include "support/catch.hpp"
#include "support/meshes.hpp"

using namespace faqem;
using detail::CostCurve;
using detail::distribute_face_budget;

namespace {

using Shares = std::vector<std::uint64_t>;

CostCurve curve_of(const TriangleMesh& mesh, const Options& options = {}) {
    return detail::cost_curve(mesh.view(), options, engine::RunContext(options));
}

// A curve from 12 faces to 4 in steps of two with the given costs.
CostCurve stairs(std::array<double, 4> costs, double diagonal = 1) {
    return {{{12, costs[0]}, {10, costs[1]}, {8, costs[2]}, {6, costs[3]}}, 4, diagonal};
}

}  // namespace

TEST_CASE("cost curve: face counts descend and costs ascend") {
    const TriangleMesh mesh = test::shaken(test::torus(14, 9), 0.05, 1);
    const CostCurve curve = curve_of(mesh);
    REQUIRE(curve.stop == StopReason::reached_target);
    CHECK(curve.steps.front().faces == mesh.triangles.size());
    CHECK(curve.min_faces <= 4);
    for (std::size_t i = 1; i < curve.steps.size(); ++i) {
        CHECK(curve.steps[i].faces < curve.steps[i - 1].faces);
        CHECK(curve.steps[i].cost >= curve.steps[i - 1].cost);
    }
    CHECK(curve.diagonal == Approx(info(mesh.view()).diagonal));
}

TEST_CASE("cost curve: flat surfaces have zero cost at any scale") {
    const CostCurve flat = curve_of(test::scaled(test::grid(8), 1e6));
    REQUIRE(!flat.steps.empty());
    CHECK(flat.steps[flat.steps.size() / 2].cost < 1e-20);
    const CostCurve bumpy = curve_of(test::shaken(test::grid(8), 0.3, 1));
    CHECK(bumpy.steps[bumpy.steps.size() / 2].cost > 1e-8);
}

TEST_CASE("cost curve: locked vertices limit the number of steps") {
    Options options{.topology = {.boundary = Boundary::locked}};
    // A fan of six triangles of which only the centre vertex is free.
    const CostCurve curve = curve_of(test::fan(6), options);
    CHECK(curve.steps.size() <= 1);
    CHECK(curve.min_faces >= 4);
}

TEST_CASE("cost curve: a cancelled curve is incomplete") {
    Options options{.progress = [](Phase, double) { return Continue::cancel; }};
    CHECK(curve_of(test::icosphere(4), options).stop == StopReason::cancelled);
}

TEST_CASE("face budget: the cheapest steps of all meshes are taken first") {
    const std::vector<CostCurve> curves = {stairs({1, 2, 5, 9}), stairs({3, 4, 6, 7})};
    const std::vector<double> weights = {1, 1};
    CHECK(distribute_face_budget(curves, weights, 24) == Shares{12, 12});
    CHECK(distribute_face_budget(curves, weights, 20) == Shares{8, 12});
    CHECK(distribute_face_budget(curves, weights, 16) == Shares{8, 8});
    CHECK(distribute_face_budget(curves, weights, 14) == Shares{6, 8});
    CHECK(distribute_face_budget(curves, weights, 10) == Shares{6, 4});
}

TEST_CASE("face budget: the budget is used completely") {
    const std::vector<CostCurve> curves = {stairs({1, 2, 5, 9}), stairs({3, 4, 6, 7})};
    const std::vector<double> weights = {1, 1};
    for (std::uint64_t goal = 8; goal <= 24; ++goal) {
        const Shares share = distribute_face_budget(curves, weights, goal);
        CHECK(share[0] + share[1] == goal);
    }
    CHECK(distribute_face_budget(curves, weights, 100) == Shares{12, 12});
}

TEST_CASE("face budget: each mesh keeps at least four faces") {
    std::vector<CostCurve> curves = {stairs({1, 2, 5, 9}), stairs({3, 4, 6, 7})};
    curves[0].min_faces = 2;
    curves.push_back({{}, 2, 1});  // a mesh of two faces
    const std::vector<double> weights = {1, 1, 1};
    CHECK(distribute_face_budget(curves, weights, 0) == Shares{4, 4, 2});
}

TEST_CASE("face budget: costs scale with the fourth power of the size and with the weight") {
    // The second mesh is twice as large: its first step costs 16 times as much as that of the first mesh.
    const std::vector<CostCurve> curves = {stairs({1, 17, 18, 19}), stairs({1, 2, 3, 4}, 2)};
    const std::vector<double> weights = {1, 1}, seen_twice = {1, 1.0 / 32};
    CHECK(distribute_face_budget(curves, weights, 22) == Shares{10, 12});
    CHECK(distribute_face_budget(curves, weights, 20) == Shares{10, 10});
    CHECK(distribute_face_budget(curves, seen_twice, 22) == Shares{12, 10});
}

TEST_CASE("face budget: a mesh keeps its floor, however cheap its collapses are beside those of others") {
    const std::vector<CostCurve> curves = {stairs({1, 2, 5, 9}), stairs({3, 4, 6, 7}, 1000)};
    const std::vector<double> weights = {1, 1};
    CHECK(distribute_face_budget(curves, weights, 16) == Shares{4, 12});
    CHECK(distribute_face_budget(curves, weights, 16, Shares{8, 8}) == Shares{8, 8});
    CHECK(distribute_face_budget(curves, weights, 16, Shares{7, 7}) == Shares{8, 8});
    CHECK(distribute_face_budget(curves, weights, 16, Shares{6, 6}) == Shares{6, 10});
    CHECK(distribute_face_budget(curves, weights, 16, Shares{0, 0}) == Shares{4, 12});
}

TEST_CASE("face budget: floors that do not fit in the budget are not kept") {
    const std::vector<CostCurve> curves = {stairs({1, 2, 5, 9}), stairs({3, 4, 6, 7})};
    CHECK(distribute_face_budget(curves, std::vector<double>{1, 1}, 14, Shares{10, 10}) == Shares{6, 8});
}

TEST_CASE("face budget: flat collapses are taken below the floor, up to the first that is not flat") {
    // Six faces of area 1 / 12 that move by a distance d.
    const auto cost = [](double d) { return 0.5 * d * d; };
    const double flat = 0.9 * detail::flat_distance, bent = 2 * detail::flat_distance;
    const std::vector<CostCurve> curves = {stairs({cost(flat), cost(flat), cost(bent), cost(bent)}, 1e-3),
                                           stairs({3, 4, 6, 7})};
    CHECK(distribute_face_budget(curves, std::vector<double>{1, 1}, 16, Shares{12, 8}) == Shares{8, 8});
}

TEST_CASE("face budget: sizes of 1e-150 and 1e150 neither overflow nor underflow") {
    const std::vector<double> weights = {1, 1};
    for (const double unit : {1e-150, 1.0, 1e150}) {
        CHECK(distribute_face_budget(std::vector{stairs({1, 2, 5, 9}, unit), stairs({3, 4, 6, 7}, unit)},
                                     weights, 14) == Shares{6, 8});
    }
}

TEST_CASE("face budget: no meshes and empty meshes are allowed") {
    CHECK(distribute_face_budget({}, {}, 10).empty());
    CHECK(distribute_face_budget(std::vector<CostCurve>(2), std::vector<double>{1, 1}, 10) == Shares{0, 0});
}

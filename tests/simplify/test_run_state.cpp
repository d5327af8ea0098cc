#include "faqem/detail/simplify/run_state.hpp"

#include <cmath>

#include "faqem/options.hpp"
#include "support/applied_steps.hpp"
#include "support/catch.hpp"
#include "support/meshes.hpp"

using namespace faqem;
using namespace faqem::detail;

namespace {

RunState state_of(const TriangleMesh& mesh, const std::vector<std::uint8_t>& locked,
                  Boundary boundary = Boundary::free) {
    return RunState(preprocess(mesh.view(), settings({})), locked, boundary);
}

}  // namespace

TEST_CASE("run state: locks follow the reordered vertices and can include boundary vertices") {
    const TriangleMesh mesh = test::grid(2);
    std::vector<std::uint8_t> locked(9, 0);
    locked[4] = 1;
    const RunState free = state_of(mesh, locked);
    for (Index v = 0; v < 9; ++v) CHECK(free.locked()[v] == (free.mesh().vertex[v] == 4));
    const RunState held = state_of(mesh, locked, Boundary::locked);
    CHECK(held.locked() == std::vector<std::uint8_t>(9, 1));
    CHECK(free.source_vertices() == free.mesh().vertex);
}

TEST_CASE("run state: vertex maps and locks stay correct after two rounds of collapses") {
    // A strip of four quads, x = 0 ... 4. Each round collapses vertices to the left.
    TriangleMesh mesh = test::make({}, {});
    for (Index x = 0; x <= 4; ++x) {
        for (Index y = 0; y < 2; ++y) mesh.positions.push_back({double(x), double(y), 0});
    }
    for (Index x = 0; x < 4; ++x) {
        mesh.triangles.push_back({2 * x, 2 * x + 2, 2 * x + 3});
        mesh.triangles.push_back({2 * x, 2 * x + 3, 2 * x + 1});
    }
    RunState state = state_of(mesh, {0, 0, 0, 0, 0, 0, 0, 0, 1, 0});
    state.track_original();
    const std::vector<engine::Vector3> original = state.mesh().positions;
    const std::vector<Index> vertex = state.mesh().vertex;
    const double area = state.area();
    const auto join = [&](double from,
                          double to) {  // collapses both vertices at x = from into those at x = to
        const auto at = [&](double x, double y) {
            for (Index v = 0; v < state.mesh().vertex.size(); ++v) {
                const Vec3& p = mesh.positions[state.mesh().vertex[v]];
                if (p[0] == x && p[1] == y) return v;
            }
            return no_index;
        };
        std::vector<RoundStep> steps;
        for (const double y : {0.0, 1.0}) {
            const Index survivor = at(to, y);
            steps.push_back({survivor, at(from, y), state.mesh().positions[survivor]});
        }
        state.advance_to(test::applied(state.mesh().positions, state.mesh().triangles, steps));
    };
    join(1, 0);
    CHECK(state.mesh().triangles.size() == 6);
    join(3, 2);
    CHECK(state.mesh().triangles.size() == 4);
    CHECK(state.mesh().vertex.size() == 6);
    CHECK(state.area() == Approx(area));
    CHECK(state.source_vertices() == state.mesh().vertex);
    for (Index slot = 0; slot < 6; ++slot) CHECK(state.locked()[slot] == (state.mesh().vertex[slot] == 8));
    for (std::size_t v = 0; v < original.size(); ++v) {
        const Vec3& was = mesh.positions[vertex[v]];
        const Vec3& is = mesh.positions[state.mesh().vertex[state.vertex_map()[v]]];
        CHECK(is[0] == 2 * std::floor(was[0] / 2));
        CHECK(is[1] == was[1]);
        CHECK(state.original()->position(static_cast<Index>(v)) == original[v]);
    }
    CHECK(state.initial_surface().triangles.size() == 8);
    for (const Index f : state.mesh().face) CHECK(f < 8);
}

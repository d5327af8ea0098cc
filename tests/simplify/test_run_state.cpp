#include "faqem/detail/simplify/run_state.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "support/meshes.hpp"

using namespace faqem;
using namespace faqem::detail;

namespace {

Ground ground_of(const TriangleMesh& mesh, const std::vector<std::uint8_t>& locked,
                 Border border = Border::free) {
    return Ground(prepare(mesh.view(), settings({})), locked, border);
}

}  // namespace

TEST_CASE("ground: locks follow their vertices, and the border's are added") {
    const TriangleMesh mesh = test::grid(2);
    std::vector<std::uint8_t> locked(9, 0);
    locked[4] = 1;
    const Ground free = ground_of(mesh, locked);
    for (Index v = 0; v < 9; ++v) CHECK(free.locked()[v] == (free.now().vertex[v] == 4));
    const Ground held = ground_of(mesh, locked, Border::locked);
    CHECK(held.locked() == std::vector<std::uint8_t>(9, 1));
    CHECK(free.places() == free.now().vertex);
}

TEST_CASE("ground: after two rounds of steps everything still knows whose it was") {
    // A strip of four quads, x = 0 ... 4; what each round joins goes to the left.
    TriangleMesh mesh = test::make({}, {});
    for (Index x = 0; x <= 4; ++x) {
        for (Index y = 0; y < 2; ++y) mesh.positions.push_back({double(x), double(y), 0});
    }
    for (Index x = 0; x < 4; ++x) {
        mesh.triangles.push_back({2 * x, 2 * x + 2, 2 * x + 3});
        mesh.triangles.push_back({2 * x, 2 * x + 3, 2 * x + 1});
    }
    Ground ground = ground_of(mesh, {0, 0, 0, 0, 0, 0, 0, 0, 1, 0});
    ground.remember_original();
    const std::vector<engine::Vector3> original = ground.now().positions;
    const std::vector<Index> vertex = ground.now().vertex;
    const double area = ground.area();
    const auto join = [&](double from, double to) {  // both vertices at x = from into those at x = to
        const auto at = [&](double x, double y) {
            for (Index v = 0; v < ground.now().vertex.size(); ++v) {
                const Vec3& p = mesh.positions[ground.now().vertex[v]];
                if (p[0] == x && p[1] == y) return v;
            }
            return no_index;
        };
        std::vector<BlockStep> steps;
        for (const double y : {0.0, 1.0}) {
            const Index survivor = at(to, y);
            steps.push_back({survivor, at(from, y), ground.now().positions[survivor]});
        }
        ground.take(reduce({ground.now().positions, ground.now().triangles, ground.locked(), 10}, steps));
    };
    join(1, 0);
    CHECK(ground.now().triangles.size() == 6);
    join(3, 2);
    CHECK(ground.now().triangles.size() == 4);
    CHECK(ground.now().vertex.size() == 6);
    CHECK(ground.area() == Approx(area));
    CHECK(ground.places() == ground.now().vertex);
    for (Index slot = 0; slot < 6; ++slot) CHECK(ground.locked()[slot] == (ground.now().vertex[slot] == 8));
    for (std::size_t v = 0; v < original.size(); ++v) {
        const Vec3& was = mesh.positions[vertex[v]];
        const Vec3& is = mesh.positions[ground.now().vertex[ground.into()[v]]];
        CHECK(is[0] == 2 * std::floor(was[0] / 2));
        CHECK(is[1] == was[1]);
        CHECK(ground.original()->position(static_cast<Index>(v)) == original[v]);
    }
    CHECK(ground.whole().triangles.size() == 8);
    for (const Index f : ground.now().face) CHECK(f < 8);
}

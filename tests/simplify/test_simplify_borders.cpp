#include <algorithm>

#include "faqem/engine/mesh/boundary_edges.hpp"
#include "faqem/simplify.hpp"
#include "support/catch.hpp"
#include "support/meshes.hpp"

using namespace faqem;

namespace {

// A square of side 1 with n x n rough cells.
TriangleMesh tile(Index n) {
    TriangleMesh mesh = test::square(n, 1, 0);
    test::Random random(5);
    for (Vec3& p : mesh.positions) {
        const double hills = 0.05 * std::sin(9 * p[0] + 4 * p[1]) + 0.03 * std::cos(23 * p[1] - 7 * p[0]);
        p[2] = hills + random.between(-0.1, 0.1) / n;
    }
    return mesh;
}

SimplifyResult simplified(const TriangleMesh& mesh, Preset preset, Target target) {
    return simplify(mesh.view(), {.target = target, .preset = preset});
}

// The largest distance in plan of a boundary vertex from the sides of the unit square.
double farthest_from_sides(const TriangleMesh& mesh) {
    double farthest = 0;
    for (const auto& edge : engine::find_boundary_edges(mesh.triangles, mesh.positions.size())) {
        for (const Index v : edge) {
            const auto [x, y, z] = mesh.positions[v];
            farthest =
                std::max(farthest, std::min({std::abs(x), std::abs(x - 1), std::abs(y), std::abs(y - 1)}));
        }
    }
    return farthest;
}

bool has_position(const TriangleMesh& mesh, const Vec3& p) {
    return std::find(mesh.positions.begin(), mesh.positions.end(), p) != mesh.positions.end();
}

}  // namespace

TEST_CASE("the border of a rough tile stays straight in plan, and its corners stay") {
    const TriangleMesh source = tile(24);
    const Preset preset = GENERATE(Preset::fast, Preset::balanced, Preset::best);
    const double share = GENERATE(0.05, 0.3);
    const SimplifyResult result = simplified(source, preset, ratio(share));
    CHECK(result.report.stop == StopReason::reached_target);
    CHECK(farthest_from_sides(result.mesh) < 1e-14);
    for (const std::size_t corner : {0, 24, 24 * 25, 24 * 25 + 24})
        CHECK(has_position(result.mesh, source.positions[corner]));
}

TEST_CASE("the border of a tile that is split into blocks stays straight") {
    const TriangleMesh source = tile(280);  // 78,961 vertices
    const SimplifyResult result = simplified(source, GENERATE(Preset::fast, Preset::balanced), ratio(0.02));
    CHECK(farthest_from_sides(result.mesh) < 1e-13);
    for (const std::size_t corner : {0, 280, 280 * 281, 280 * 281 + 280})
        CHECK(has_position(result.mesh, source.positions[corner]));
}

TEST_CASE("corners of a border give way to the target") {
    // Sixteen tiles with four corners each need 32 faces.
    TriangleMesh mesh;
    for (int i = 0; i < 16; ++i) mesh = test::both(mesh, test::moved(tile(3), {2.0 * i, 0, 0}));
    const SimplifyResult result = simplified(mesh, Preset::balanced, faces(12));
    CHECK(result.report.stop == StopReason::reached_target);
    CHECK(result.mesh.triangles.size() <= 12);
}

// Cancellation checks in the expensive parts of the baker, whose sources are compiled into this program
// with instrumentation.

#include "bake/atlas/charts.hpp"
#include "bake/atlas/packing.hpp"
#include "bake/atlas/per_triangle.hpp"
#include "bake/atlas/segmentation.hpp"
#include "bake/scene/visibility.hpp"
#include "bake/texture/push_pull.hpp"
#include "bake/transfer/tangents.hpp"
#include "bake/transfer/texture_sampling.hpp"
#include "step_counts/silence.hpp"
#include "support/catch.hpp"
#include "support/chart_meshes.hpp"

using namespace faqem;
using namespace faqem::detail;
using test::longest_silence;
using test::most_steps;

TEST_CASE("cancellation is checked often during the creation of charts") {
    const std::vector<ChartFace> faces = test::chart_faces(test::shaken(test::icosphere(5), 0.01, 1), 200);
    CHECK(longest_silence([&](engine::CancellationCheck check_cancelled) {
              cluster_faces(faces, check_cancelled);
          }) < most_steps);
    // Between these two steps the linear system of a chart is solved, without checks.
    const Charts charts = make_charts(faces, 1);
    CHECK(longest_silence([&](engine::CancellationCheck check_cancelled) {
              pack_charts(charts.charts, faces.size(), 2048, check_cancelled);
          }) < most_steps);
}

TEST_CASE("cancellation is checked often during the layout of single triangles") {
    const TriangleMesh mesh = test::icosphere(6);
    const std::vector<ChartFace> faces = test::chart_faces(mesh, 1);
    std::vector<PairTriangle> triangles(faces.size());
    for (std::size_t f = 0; f < faces.size(); ++f) triangles[f] = {{10, 10, 10}, faces[f].adjacent};
    CHECK(longest_silence([&](engine::CancellationCheck check_cancelled) {
              pair_triangles(triangles, check_cancelled);
          }) < most_steps);
    std::vector<AtlasTriangle> cells(faces.size());
    for (std::size_t f = 0; f < cells.size(); ++f) {
        const double leg = 2 + static_cast<double>(f % 17);
        cells[f] = {0, {leg, leg}, f, no_index};
    }
    CHECK(longest_silence([&](engine::CancellationCheck check_cancelled) {
              pack_triangles(cells, 4096, check_cancelled);
          }) < most_steps);
}

TEST_CASE("cancellation is checked often during image processing") {
    constexpr std::uint32_t side = 1024;
    Pixels pixels{side, side, std::vector<std::uint8_t>(std::size_t{4} * side * side, 99), false};
    CHECK(longest_silence([&](engine::CancellationCheck check_cancelled) {
              MipImage(pixels, TexelEncoding::color, Workers(1, check_cancelled));
          }) < most_steps);
    std::vector<std::uint8_t> known(std::size_t{side} * side, 0);
    for (std::size_t i = 0; i < known.size(); i += 1000) known[i] = 1;
    CHECK(longest_silence([&](engine::CancellationCheck check_cancelled) {
              push_pull(pixels, known, {0, 4}, check_cancelled);
          }) < most_steps);
}

TEST_CASE("cancellation is checked often during the computation of visibility") {
    Asset asset;
    for (const TriangleMesh& mesh : {test::icosphere(6), test::scaled(test::icosphere(2), 2)}) {
        Part& part = asset.parts.emplace_back();
        part.positions = mesh.positions;
        part.triangles = mesh.triangles;
    }
    CHECK(longest_silence([&](engine::CancellationCheck check_cancelled) {
              vertex_visibility(asset, Workers(1, check_cancelled));
          }) < most_steps);
}

TEST_CASE("cancellation is checked often during the computation of tangents") {
    const TriangleMesh mesh = test::icosphere(6);
    std::vector<TangentCorner> corners;
    for (const Triangle& t : mesh.triangles) {
        for (const Index v : t) {
            const Vec3& p = mesh.positions[v];
            const Vec3f at = {static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])};
            corners.push_back({at, at, {at[0], at[1]}});
        }
    }
    CHECK(longest_silence([&](engine::CancellationCheck check_cancelled) {
              mikk_tangents(corners, check_cancelled);
          }) < most_steps);
}

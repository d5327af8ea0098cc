// Cancellation checks in the expensive parts of the baker, whose sources are compiled into this program
// with instrumentation.

#include "bake/atlas/charts.hpp"
#include "bake/atlas/packing.hpp"
#include "bake/atlas/per_triangle.hpp"
#include "bake/atlas/segmentation.hpp"
#include "render/texture_sampling.hpp"
#include "scene/weights/visibility.hpp"
#include "step_counts/silence.hpp"
#include "support/catch.hpp"
#include "support/chart_meshes.hpp"

using namespace faqem;
using namespace faqem::detail;
using test::for_a_million_faces;
using test::longest_silence;
using test::most_steps;

TEST_CASE("cancellation is checked often during the creation of charts") {
    const std::vector<PageTriangle> faces = test::chart_faces(test::shaken(test::icosphere(5), 0.01, 1), 200);
    const std::uint64_t clustering =
        longest_silence([&](const engine::RunContext& context) { cluster_faces(faces, context); });
    CHECK(for_a_million_faces(clustering, faces.size()) < most_steps);
    Charts charts;
    CHECK(longest_silence([&](const engine::RunContext& context) { charts = make_charts(faces, context); }) <
          most_steps);
    CHECK(longest_silence([&](const engine::RunContext& context) {
              pack_charts(charts.charts, faces.size(), 2048, context);
          }) < most_steps);
}

TEST_CASE("cancellation is checked often during the layout of single triangles") {
    const TriangleMesh mesh = test::icosphere(6);
    std::vector<AtlasTriangle> cells(mesh.triangles.size());
    for (std::size_t f = 0; f < cells.size(); ++f) {
        const double leg = 2 + static_cast<double>(f % 17);
        cells[f] = {0, {leg, leg}, f, no_index};
    }
    const std::uint64_t packing =
        longest_silence([&](const engine::RunContext& context) { pack_triangles(cells, 4096, context); });
    CHECK(for_a_million_faces(packing, cells.size()) < most_steps);
}

TEST_CASE("cancellation is checked often during image processing") {
    constexpr std::uint32_t side = 1024;
    const Pixels pixels{side, side, std::vector<std::uint8_t>(std::size_t{4} * side * side, 99), false};
    CHECK(longest_silence([&](const engine::RunContext& context) {
              MipImage(pixels, TexelEncoding::color, context);
          }) < most_steps);
}

TEST_CASE("cancellation is checked often during the computation of visibility") {
    Asset asset;
    for (const TriangleMesh& mesh : {test::icosphere(5), test::scaled(test::icosphere(2), 2)}) {
        Part& part = asset.parts.emplace_back();
        part.positions = mesh.positions;
        part.triangles = mesh.triangles;
    }
    CHECK(longest_silence([&](const engine::RunContext& context) { vertex_visibility(asset, context); }) <
          most_steps);
}

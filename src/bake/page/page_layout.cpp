#include "bake/page/page_layout.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

#include "bake/atlas/charts.hpp"
#include "faqem/engine/mesh/vector.hpp"

namespace faqem::detail {
namespace {

using engine::to_eigen;

// Placing so many charts takes several times as long as placing cells of single triangles. These look nearly as good
// where charts have few faces.
constexpr std::size_t many_charts = 5000, few_faces_per_chart = 3;

AtlasTriangle atlas_triangle(const PageTriangle& triangle, std::uint64_t order) {
    std::array<double, 3> edges;  // by opposite corner
    for (std::size_t c = 0; c < 3; ++c) {
        const auto &p = triangle.corners[(c + 1) % 3], &q = triangle.corners[(c + 2) % 3];
        edges[c] = triangle.density * (to_eigen(p) - to_eigen(q)).norm();
    }
    const auto c = static_cast<std::size_t>(std::max_element(edges.begin(), edges.end()) - edges.begin());
    return {static_cast<std::uint8_t>(c), {edges[(c + 2) % 3], edges[(c + 1) % 3]}, order};
}

std::optional<PageLayout> layout_triangles(const PageMesh& mesh, std::uint32_t texture_size,
                                           const RunContext& context) {
    std::vector<AtlasTriangle> triangles;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
        triangles.push_back(atlas_triangle(mesh.triangles[i], mesh.order[i]));
    std::optional<Atlas> atlas = pack_triangles(triangles, texture_size, context);
    if (!atlas) return std::nullopt;
    PageLayout result{*std::move(atlas), {}, {}, {}};
    result.summary.kind = Bake::per_triangle;
    result.summary.charts = result.atlas.cells.size();
    return result;
}

// Mean stretch of charts, weighted by their texels.
double mean_stretch(std::span<const Chart> charts) {
    double stretch = 0, texels = 0;
    for (const Chart& chart : charts) {
        stretch += chart.stretch * chart.texels;
        texels += chart.texels;
    }
    return texels > 0 ? stretch / texels : BakedPage{}.stretch;
}

std::optional<PageLayout> layout_charts(const PageMesh& mesh, const Charts& charts,
                                        std::uint32_t texture_size, const RunContext& context) {
    std::optional<ChartPage> page = pack_charts(charts.charts, mesh.triangles.size(), texture_size, context);
    if (!page) return std::nullopt;
    PageLayout result{std::move(page->atlas), std::move(page->charts), {}, {}};
    result.tiles = split_into_tiles(result.charts);
    result.summary.kind = Bake::atlas;
    result.summary.charts = charts.charts.size();
    result.summary.faces_outside_charts = charts.faces_over_work_limit;
    result.summary.stretch = mean_stretch(charts.charts);
    return result;
}

std::optional<PageLayout> layout_by_kind(const PageMesh& mesh, Bake kind, std::uint32_t texture_size,
                                         const RunContext& context) {
    if (kind == Bake::per_triangle) return layout_triangles(mesh, texture_size, context);
    const Charts charts = make_charts(mesh.triangles, context);
    const bool takes_triangles = kind == Bake::automatic && charts.charts.size() > many_charts &&
                                 mesh.triangles.size() < few_faces_per_chart * charts.charts.size();
    return takes_triangles ? layout_triangles(mesh, texture_size, context)
                           : layout_charts(mesh, charts, texture_size, context);
}

}  // namespace

std::optional<PageLayout> layout_page(const PageMesh& mesh, Bake kind, std::uint32_t texture_size,
                                      const RunContext& context) {
    std::optional<PageLayout> result = layout_by_kind(mesh, kind, texture_size, context);
    if (!result) return std::nullopt;
    result->summary.width = result->atlas.width;
    result->summary.height = result->atlas.height;
    result->summary.faces = mesh.triangles.size();
    return result;
}

}  // namespace faqem::detail

#include "bake/page/page_layout.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "bake/atlas/charts.hpp"
#include "bake/atlas/triangle_pairs.hpp"
#include "faqem/detail/base/vector.hpp"

namespace faqem::detail {
namespace {

// With fewer faces, charts have more gutter than the cells of a per-triangle atlas.
constexpr std::size_t min_mean_faces_per_chart = 3;

std::uint8_t opposite_longest_edge(const PairTriangle& triangle) {
    const auto longest = std::max_element(triangle.edges.begin(), triangle.edges.end());
    return static_cast<std::uint8_t>(longest - triangle.edges.begin());
}

PairTriangle pair_triangle(const PageTriangle& triangle) {
    PairTriangle result{{}, triangle.adjacent};
    for (std::size_t c = 0; c < 3; ++c) {
        const auto &p = triangle.corners[(c + 1) % 3], &q = triangle.corners[(c + 2) % 3];
        result.edges[c] = triangle.density * (to_eigen(p) - to_eigen(q)).norm();
    }
    return result;
}

std::optional<PageLayout> layout_triangles(const PageMesh& mesh, std::uint32_t texture_size,
                                           const RunContext& context) {
    std::vector<PairTriangle> shapes(mesh.triangles.size());
    std::transform(mesh.triangles.begin(), mesh.triangles.end(), shapes.begin(), pair_triangle);
    const std::vector<std::uint8_t> corner = pair_triangles(shapes);
    std::vector<AtlasTriangle> triangles(shapes.size());
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        AtlasTriangle& t = triangles[i];
        t.right_angle_corner = corner[i] < 3 ? corner[i] : opposite_longest_edge(shapes[i]);
        t.legs = {shapes[i].edges[(t.right_angle_corner + 2) % 3],
                  shapes[i].edges[(t.right_angle_corner + 1) % 3]};
        t.order = mesh.order[i];
        if (corner[i] < 3) t.partner = shapes[i].adjacent[corner[i]].triangle;
    }
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

// One chart of all triangles that cover texels. Samples between them belong to the closest one within two blocks.
PageLayout layout_given(const PageMesh& mesh, std::span<const Triangle2> given, std::uint32_t texture_size) {
    constexpr std::uint32_t least_side = 64, block = 4;
    double area = 0, texels = 0;
    for (std::size_t i = 0; i < given.size(); ++i) {
        area += std::abs(twice_signed_area(given[i][0], given[i][1], given[i][2])) / 2;
        const double wanted = wanted_texels(mesh.triangles[i]);
        if (std::isfinite(wanted)) texels += wanted;
    }
    std::uint32_t side = least_side;
    while (side < texture_size && side * side * area < texels) side *= 2;
    PageLayout result;
    result.atlas.width = result.atlas.height = side;
    AtlasChart& chart = result.charts.emplace_back();
    chart.block_size = block;
    chart.mask.columns = chart.mask.rows = side / block;
    chart.mask.blocks.assign(std::size_t{chart.mask.columns} * chart.mask.rows, 1);
    chart.is_given = true;
    for (std::size_t i = 0; i < given.size(); ++i) {
        const Triangle2& uv = given[i];
        result.atlas.placements.push_back({uv[0] * side, uv[1] * side, uv[2] * side});
        if (twice_signed_area(uv[0], uv[1], uv[2]) != 0) chart.triangles.push_back(static_cast<Index>(i));
    }
    result.tiles = split_into_tiles(result.charts);
    result.summary.kind = Bake::atlas;
    result.summary.charts = 1;
    return result;
}

std::optional<PageLayout> layout_by_kind(const PageMesh& mesh, Bake kind, std::uint32_t texture_size,
                                         const RunContext& context) {
    if (kind == Bake::per_triangle) return layout_triangles(mesh, texture_size, context);
    const Charts charts = make_charts(mesh.triangles, context);
    const bool has_small_charts = min_mean_faces_per_chart * charts.charts.size() > mesh.triangles.size();
    return kind == Bake::automatic && has_small_charts ? layout_triangles(mesh, texture_size, context)
                                                       : layout_charts(mesh, charts, texture_size, context);
}

}  // namespace

std::optional<PageLayout> layout_page(const PageMesh& mesh, std::span<const Triangle2> given, Bake kind,
                                      std::uint32_t texture_size, const RunContext& context) {
    std::optional<PageLayout> result = given.empty() ? layout_by_kind(mesh, kind, texture_size, context)
                                                     : layout_given(mesh, given, texture_size);
    if (!result) return std::nullopt;
    result->summary.width = result->atlas.width;
    result->summary.height = result->atlas.height;
    result->summary.faces = mesh.triangles.size();
    return result;
}

}  // namespace faqem::detail

#include "bake/page/page_baker.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "bake/page/texel_projector.hpp"
#include "faqem/engine/mesh/vector.hpp"

namespace faqem::detail {
namespace {

using engine::Vector3;

// Adds the extension textures at a sample. Samples of another material, on a neighbouring face, are skipped: they
// have no value for these.
void add_layers(const PageRequest& page, const TexelProjector& projector, const TexelSample& at,
                const SurfacePoint& point, TexelSums& sum) {
    const Index part = projector.part();
    if (page.layers.empty() || page.sampler.material(part, point) != page.material) return;
    ++sum.layer_samples;
    const double spacing = projector.spacing();
    for (std::size_t i = 0; i < page.layers.size(); ++i) {
        const ExtensionLayer& layer = page.layers[i];
        if (!layer.is_normal_map()) {
            sum.add_layer(i, page.sampler.layer(part, point, spacing, layer));
            continue;
        }
        const Vector3 normal = projector.to_tangent_space(
            at, page.sampler.layer_normal(part, point, spacing, projector.face_normal(at), layer));
        sum.add_layer(i, {static_cast<float>(normal.x()), static_cast<float>(normal.y()),
                          static_cast<float>(normal.z()), 0});
    }
}

// Adds the source at a sample in texel (x, y).
void add_sample(const PageRequest& page, TexelProjector& projector, std::uint32_t x, std::uint32_t y,
                const TexelSample& at, TexelSums& sum) {
    const Index part = projector.part();
    const SurfacePoint point = projector.project_to_source(at, x, y);
    ++sum.steps[static_cast<std::size_t>(point.step)];
    sum.add(page.sampler.sample(part, point, projector.spacing()),
            1.0f / static_cast<float>(page.samples * page.samples));
    const double dx = at.x - x - 0.5, dy = at.y - y - 0.5, squared_distance = dx * dx + dy * dy;
    if (squared_distance < sum.squared_distance) {
        sum.squared_distance = squared_distance;
        sum.origin = {part, point};
    }
    if (page.channels.normal) {
        sum.normal += projector.to_tangent_space(
            at, page.sampler.normal(part, point, projector.spacing(), projector.face_normal(at)));
    }
    add_layers(page, projector, at, point, sum);
}

// Bakes texel (x, y).
// \param projector_of  the projector of sample (i, j), which is at (s, t) in the texel: projector_of(i, j, s, t)
template <class ProjectorOf>
void bake_texel(const PageRequest& page, std::uint32_t x, std::uint32_t y, const ProjectorOf& projector_of,
                PageCanvas& canvas) {
    TexelSums sum(page.layers.size());
    for (std::uint32_t j = 0; j < page.samples; ++j) {
        for (std::uint32_t i = 0; i < page.samples; ++i) {
            const double s = (i + 0.5) / page.samples, t = (j + 0.5) / page.samples;
            TexelProjector& projector = projector_of(i, j, s, t);
            add_sample(page, projector, x, y, projector.point(x, y, s, t), sum);
        }
    }
    canvas.write(x, y, sum);
}

// Bakes a cell. Between two triangles that are not partners a texel belongs to one of them. On the shared hypotenuse
// of partners a texel can have samples of both.
void bake_piece(const PageRequest& page, const AtlasCell& cell, PageCanvas& canvas,
                CancellationCheck check_cancelled) {
    std::vector<TexelProjector> projectors;
    projectors.reserve(2);
    for (const Index triangle : {cell.first, cell.second})
        if (triangle != no_index) projectors.emplace_back(page, triangle);
    // The two triangles have equal legs and adjacent hypotenuses: the one with the larger barycentric coordinate of
    // the right-angle corner is closer.
    const auto projector_at = [&](double x, double y) -> TexelProjector& {
        const bool is_second = projectors.size() > 1 && projectors[1].right_angle_weight(x, y) >
                                                            projectors[0].right_angle_weight(x, y);
        return projectors[is_second ? 1 : 0];
    };
    for (std::uint32_t y = cell.y; y < cell.y + cell.height; ++y) {
        check_cancelled(std::uint64_t{cell.width} * page.samples * page.samples);
        for (std::uint32_t x = cell.x; x < cell.x + cell.width; ++x) {
            const auto projector_of = [&](std::uint32_t, std::uint32_t, double s,
                                          double t) -> TexelProjector& {
                return cell.has_shared_hypotenuse ? projector_at(x + s, y + t)
                                                  : projector_at(x + 0.5, y + 0.5);
            };
            bake_texel(page, x, y, projector_of, canvas);
        }
    }
}

// Bakes a tile of a chart.
void bake_piece(const PageRequest& page, const ChartTile& tile, PageCanvas& canvas,
                CancellationCheck check_cancelled) {
    const PageLayout& layout = page.layout;
    const TileOwners owned =
        tile_owners(layout.atlas, layout.charts[tile.chart], page.mesh.triangles, tile, page.samples);
    std::vector<TexelProjector> projectors;
    projectors.reserve(owned.triangles.size());
    for (const Index triangle : owned.triangles) projectors.emplace_back(page, triangle);
    const std::size_t row = std::size_t{tile.width} * page.samples;
    for (std::uint32_t y = 0; y < tile.height; ++y) {
        check_cancelled(row * page.samples);
        for (std::uint32_t x = 0; x < tile.width; ++x) {
            const std::uint32_t* const owners = &owned.owners[(y * row + x) * page.samples];
            if (*owners == TileOwners::none) continue;
            const auto projector_of = [&](std::uint32_t i, std::uint32_t j, double,
                                          double) -> TexelProjector& {
                return projectors[owners[j * row + i]];
            };
            bake_texel(page, tile.x + x, tile.y + y, projector_of, canvas);
        }
    }
}

}  // namespace

PageImages bake_page(const PageRequest& page, BakeProgress& progress) {
    PageCanvas canvas(page);
    const auto bake_all = [&](const auto& pieces, std::size_t block) {
        progress.run_blocks(pieces.size(), block,
                            [&](std::size_t begin, std::size_t end, CancellationCheck check_cancelled) {
                                for (std::size_t i = begin; i < end; ++i)
                                    bake_piece(page, pieces[i], canvas, check_cancelled);
                            });
    };
    // Cells are in descending order. Blocks of several small ones cost little to hand out, but every block has to be
    // small compared with the work of a thread.
    const std::vector<AtlasCell>& cells = page.layout.atlas.cells;
    bake_all(cells, std::clamp<std::size_t>(cells.size() / 256, 1, 4));
    bake_all(page.layout.tiles, 1);
    return std::move(canvas).finish(progress.workers());
}

}  // namespace faqem::detail

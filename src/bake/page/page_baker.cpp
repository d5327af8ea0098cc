#include "bake/page/page_baker.hpp"

#include <algorithm>
#include <utility>

#include "bake/page/texel_projector.hpp"
#include "bake/page/texel_values.hpp"
#include "faqem/detail/base/vector.hpp"

namespace faqem::detail {
namespace {

using Places = std::vector<std::array<std::uint32_t, 2>>;

// The first samples, then the others row by row.
std::vector<SamplePlace> sample_places(std::uint32_t samples, Places places) {
    for (std::uint32_t row = 0; row < samples; ++row)
        for (std::uint32_t column = 0; column < samples; ++column)
            if (std::find(places.begin(), places.end(), std::array{column, row}) == places.end())
                places.push_back({column, row});
    std::vector<SamplePlace> result;
    for (const auto& [column, row] : places)
        result.push_back({column, row, (column + 0.5) / samples, (row + 0.5) / samples});
    return result;
}

// The extension textures at a sample. Samples of another material, on a neighbouring face, have no value for these.
void sample_layers(const PageRequest& page, const TexelProjector& projector, const TexelSample& at,
                   SampleValues& to) {
    const auto& [part, point] = to.origin;
    to.has_layers = !page.layers.empty() && page.sampler.material(part, point) == page.material;
    if (!to.has_layers) return;
    const double spacing = projector.spacing();
    to.layers.resize(page.layers.size());
    for (std::size_t i = 0; i < page.layers.size(); ++i) {
        const ExtensionLayer& layer = page.layers[i];
        if (!layer.is_normal_map()) {
            to.layers[i] = page.sampler.layer(part, point, spacing, layer);
            continue;
        }
        const Vector3 normal = projector.to_tangent_space(
            at, page.sampler.layer_normal(part, point, spacing, projector.face_normal(at), layer));
        to.layers[i] = {static_cast<float>(normal.x()), static_cast<float>(normal.y()),
                        static_cast<float>(normal.z()), 0};
    }
}

// The source at a sample in texel (x, y). \return false if the source has nothing there
bool take_sample(const PageRequest& page, TexelProjector& projector, std::uint32_t x, std::uint32_t y,
                 const TexelSample& at, SampleValues& to) {
    const Index part = projector.part();
    const SurfacePoint point = projector.project_to_source(at, x, y);
    if (point.face == no_index) return false;
    to.origin = {part, point};
    const double dx = at.x - x - 0.5, dy = at.y - y - 0.5;
    to.squared_distance = dx * dx + dy * dy;
    to.appearance = page.sampler.sample(part, point, projector.spacing());
    if (page.channels[CoreTexture::normal])
        to.normal = projector.to_tangent_space(
            at, page.sampler.normal(part, point, projector.spacing(), projector.face_normal(at)));
    sample_layers(page, projector, at, to);
    return true;
}

// Bakes texel (x, y). Its other samples are taken only if the first ones differ, and not in the gutter, which is read
// with small weights at the edges of triangles.
// \param projector_of  the projector of a sample: projector_of(SamplePlace)
template <class ProjectorOf>
void bake_texel(const PageRequest& page, const SampleOrder& order, std::uint32_t x, std::uint32_t y,
                const ProjectorOf& projector_of, PageCanvas& canvas) {
    TexelSums sum(page.layers.size());
    SampleValues first, next;
    bool varies = false, shows_triangle = false;
    for (const SamplePlace& place : order.of(x, y)) {
        if (sum.samples == order.first_samples() && !(varies && shows_triangle)) break;
        TexelProjector& projector = projector_of(place);
        SampleValues& values = sum.samples == 0 ? first : next;
        const TexelSample at = projector.point(x, y, place.s, place.t);
        if (!take_sample(page, projector, x, y, at, values)) continue;
        shows_triangle = shows_triangle || at.on_own_triangle;
        varies = varies || (sum.samples > 0 && differ_visibly(page.channels, page.layers, first, values));
        sum.add(values);
    }
    if (sum.samples > 0) canvas.write(x, y, sum);
}

// Bakes a cell. Between two triangles that are not partners a texel belongs to one of them. On the shared hypotenuse
// of partners a texel can have samples of both.
void bake_piece(const PageRequest& page, const SampleOrder& order, const AtlasCell& cell, PageCanvas& canvas,
                const RunContext& context) {
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
        context.count(std::uint64_t{cell.width} * page.samples * page.samples);
        for (std::uint32_t x = cell.x; x < cell.x + cell.width; ++x) {
            const auto projector_of = [&](const SamplePlace& place) -> TexelProjector& {
                return cell.has_shared_hypotenuse ? projector_at(x + place.s, y + place.t)
                                                  : projector_at(x + 0.5, y + 0.5);
            };
            bake_texel(page, order, x, y, projector_of, canvas);
        }
    }
}

// Bakes a tile of a chart.
void bake_piece(const PageRequest& page, const SampleOrder& order, const ChartTile& tile, PageCanvas& canvas,
                const RunContext& context) {
    const PageLayout& layout = page.layout;
    const TileOwners owned =
        tile_owners(layout.atlas, layout.charts[tile.chart], page.mesh.triangles, tile, page.samples);
    std::vector<TexelProjector> projectors;
    projectors.reserve(owned.triangles.size());
    for (const Index triangle : owned.triangles) projectors.emplace_back(page, triangle);
    const std::size_t row = std::size_t{tile.width} * page.samples;
    for (std::uint32_t y = 0; y < tile.height; ++y) {
        context.count(row * page.samples);
        for (std::uint32_t x = 0; x < tile.width; ++x) {
            const std::uint32_t* const owners = &owned.owners[(y * row + x) * page.samples];
            bool is_owned = true;
            for (std::uint32_t j = 0; j < page.samples; ++j)
                is_owned = is_owned && std::find(owners + j * row, owners + j * row + page.samples,
                                                 TileOwners::none) == owners + j * row + page.samples;
            if (!is_owned) continue;
            const auto projector_of = [&](const SamplePlace& place) -> TexelProjector& {
                return projectors[owners[place.row * row + place.column]];
            };
            bake_texel(page, order, tile.x + x, tile.y + y, projector_of, canvas);
        }
    }
}

}  // namespace

SampleOrder::SampleOrder(std::uint32_t samples) {
    const std::uint32_t last = samples - 1, middle = last / 2;
    std::array<Places, 2> first;
    if (samples == 1)
        first = {{{{0, 0}}, {{0, 0}}}};
    else if (samples == 2)
        first = {{{{0, 0}, {1, 1}}, {{1, 0}, {0, 1}}}};
    else
        first[0] = first[1] = {{middle, middle}, {0, 0}, {last, 0}, {0, last}, {last, last}};
    first_samples_ = first[0].size();
    for (std::size_t i = 0; i < 2; ++i) orders_[i] = sample_places(samples, first[i]);
}

PageImages bake_page(const PageRequest& page, double from, double to, const RunContext& context) {
    PageCanvas canvas(page);
    const SampleOrder order(page.samples);
    const auto bake_all = [&](const auto& pieces, std::size_t block, double begin_at, double end_at) {
        reported_blocks(pieces.size(), block, context, Phase::bake, begin_at, end_at,
                        [&](std::size_t begin, std::size_t end, const RunContext& block_context) {
                            for (std::size_t i = begin; i < end; ++i)
                                bake_piece(page, order, pieces[i], canvas, block_context);
                        });
    };
    // Cells are in descending order. Blocks of several small ones cost little to hand out, but every block has to be
    // small compared with the work of a thread.
    const std::vector<AtlasCell>& cells = page.layout.atlas.cells;
    const double middle =
        from + (to - from) * static_cast<double>(cells.size()) / static_cast<double>(page.layout.pieces());
    bake_all(cells, std::clamp<std::size_t>(cells.size() / 256, 1, 4), from, middle);
    bake_all(page.layout.tiles, 1, middle, to);
    return std::move(canvas).finish(context);
}

}  // namespace faqem::detail

#include "bake/texture/page_baker.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "bake/texture/push_pull.hpp"
#include "bake/texture/shown_texels.hpp"
#include "bake/texture/texel_projector.hpp"
#include "faqem/engine/mesh/vector.hpp"

namespace faqem::detail {
namespace {

using engine::Vector3;

// Texels with a lower alpha take their colour from the texels around them, if their material has visible ones.
constexpr float min_visible_alpha = 1.0f / 512;

Pixels blank(const Atlas& atlas, bool wanted, bool has_alpha) {
    if (!wanted) return {};
    const std::size_t texels = std::size_t{atlas.width} * atlas.height;
    return {atlas.width, atlas.height, std::vector<std::uint8_t>(4 * texels, 255), has_alpha};
}

// Sums over the samples of one texel.
struct TexelSums {
    explicit TexelSums(std::size_t layer_count) : layers(layer_count) {}

    LinearColor base{};
    std::array<float, 3> orm{};
    Vec3f emissive{};
    Vector3 normal = Vector3::Zero();  // in tangent space
    std::vector<LinearColor> layers;   // of the page's own material; normals in tangent space in RGB
    std::uint32_t layer_samples = 0;
    std::array<std::uint8_t, 3> steps{};  // samples by MapStep
    TexelOrigin origin;                   // of the sample closest to the centre, at squared_distance from it
    double squared_distance = std::numeric_limits<double>::infinity();

    void add(const Appearance& a, float share) {
        for (std::size_t k = 0; k < 4; ++k) base[k] += share * a.base[k];
        orm[0] += share * a.occlusion;
        orm[1] += share * a.roughness;
        orm[2] += share * a.metallic;
        for (std::size_t k = 0; k < 3; ++k) emissive[k] += share * a.emissive[k];
    }

    void add_layer(std::size_t layer, const LinearColor& value) {
        for (std::size_t k = 0; k < 4; ++k) layers[layer][k] += value[k];
    }
};

// Encodes the direction of `sum` in three bytes; (0, 0, 1) if its length is zero.
void write_normal(const Vector3& sum, std::uint8_t* to) {
    const double length = sum.norm();
    const Vector3 n = length > 1e-6 ? Vector3(sum / length) : Vector3(0, 0, 1);
    for (Eigen::Index k = 0; k < 3; ++k) to[k] = linear_byte((n[k] + 1) / 2);
}

class PageBaker {
public:
    PageBaker(const BakeJob& job, const SourceSampler& sampler, const PageRequest& request)
        : job_(job), sampler_(sampler), request_(request), samples_(job.options.bake.samples) {
        const Atlas& atlas = request.atlas;
        const Channels& channels = request.channels;
        images_.base = blank(atlas, channels.base, request.alpha_mode != AlphaMode::opaque);
        images_.occlusion_roughness_metallic =
            blank(atlas, channels.occlusion || channels.metallic_roughness, false);
        images_.emissive = blank(atlas, channels.emissive, false);
        images_.normal = blank(atlas, channels.normal, false);
        for (const ExtensionLayer& layer : request.layers)
            images_.layers.push_back(blank(atlas, true, layer.has_alpha()));
        is_covered_.assign(std::size_t{atlas.width} * atlas.height, 0);
        approximate_samples_.assign(is_covered_.size(), 0);
        closest_samples_.assign(is_covered_.size(), 0);
        if (job.options.bake.correspondence == Recording::on) images_.origins.resize(is_covered_.size());
        if (images_.base.has_alpha) {
            has_color_.assign(is_covered_.size(), 0);
            material_.resize(is_covered_.size());
        }
        if (!request.layers.empty()) has_layer_samples_.assign(is_covered_.size(), 0);
    }

    void bake(const AtlasCell& cell, CancellationCheck check_cancelled) {
        TexelProjector first = projector(cell.first);
        if (cell.second == no_index) {
            bake_texels(cell, check_cancelled, [&](double, double) -> TexelProjector& { return first; });
            return;
        }
        // The two triangles have equal legs and adjacent hypotenuses: the one with the larger barycentric
        // coordinate of the right-angle corner is closer.
        TexelProjector second = projector(cell.second);
        bake_texels(cell, check_cancelled, [&](double x, double y) -> TexelProjector& {
            return second.right_angle_weight(x, y) > first.right_angle_weight(x, y) ? second : first;
        });
    }

    void bake(const ChartTile& tile, CancellationCheck check_cancelled) {
        const TileOwners owned =
            tile_owners(request_.atlas, request_.charts[tile.chart], request_.adjacent, tile, samples_);
        std::vector<TexelProjector> projectors;
        projectors.reserve(owned.triangles.size());
        for (Index t : owned.triangles) projectors.push_back(projector(t));
        for (std::uint32_t y = 0; y < tile.height; ++y) {
            check_cancelled(std::uint64_t{tile.width} * samples_ * samples_);
            for (std::uint32_t x = 0; x < tile.width; ++x) {
                const std::size_t first = (std::size_t{y} * tile.width * samples_ + x) * samples_;
                if (owned.owners[first] == TileOwners::none) continue;
                TexelSums sum(request_.layers.size());
                for (std::uint32_t j = 0; j < samples_; ++j) {
                    for (std::uint32_t i = 0; i < samples_; ++i) {
                        const double s = (i + 0.5) / samples_, t = (j + 0.5) / samples_;
                        TexelProjector& projector =
                            projectors[owned.owners[first + std::size_t{j} * tile.width * samples_ + i]];
                        add_sample(sum, projector, tile.x + x, tile.y + y,
                                   projector.point(tile.x + x, tile.y + y, s, t));
                    }
                }
                write(tile.x + x, tile.y + y, sum);
            }
        }
    }

    PageImages finish() {
        count_samples();
        keep_colors_of_hidden_materials();
        struct Filled {
            Pixels& image;
            const std::vector<std::uint8_t>&known, &known_alpha;
        };
        std::vector<Filled> all = {
            {images_.base, images_.base.has_alpha ? has_color_ : is_covered_, is_covered_},
            {images_.occlusion_roughness_metallic, is_covered_, is_covered_},
            {images_.emissive, is_covered_, is_covered_},
            {images_.normal, is_covered_, is_covered_}};
        for (Pixels& layer : images_.layers) all.push_back({layer, has_layer_samples_, has_layer_samples_});
        parallel_blocks(all.size(), 1, job_.workers(), [&](std::size_t i, std::size_t) {
            auto& [image, known, known_alpha] = all[i];
            if (image.rgba.empty()) return;
            push_pull(image, known, {0, 3});
            if (image.has_alpha) push_pull(image, known_alpha, {3, 4});
        });
        images_.known = shown_texels(request_.atlas);
        images_.known_layers = std::move(has_layer_samples_);
        for (std::size_t i = 0; i < images_.known_layers.size(); ++i)
            images_.known_layers[i] = images_.known_layers[i] && images_.known[i];
        return std::move(images_);
    }

private:
    TexelProjector projector(Index triangle) const {
        return {
            job_, {request_.atlas, request_.adjacent, request_.faces, request_.tangents}, triangle, samples_};
    }

    // Between two triangles that are not partners a texel belongs to one of them. On the shared hypotenuse of
    // partners a texel can have samples of both.
    template <class Choose>
    void bake_texels(const AtlasCell& cell, CancellationCheck check_cancelled, Choose&& choose) {
        for (std::uint32_t y = cell.y; y < cell.y + cell.height; ++y) {
            check_cancelled(std::uint64_t{cell.width} * samples_ * samples_);
            for (std::uint32_t x = cell.x; x < cell.x + cell.width; ++x) {
                TexelSums sum(request_.layers.size());
                for (std::uint32_t j = 0; j < samples_; ++j) {
                    for (std::uint32_t i = 0; i < samples_; ++i) {
                        const double s = (i + 0.5) / samples_, t = (j + 0.5) / samples_;
                        TexelProjector& projector =
                            cell.has_shared_hypotenuse ? choose(x + s, y + t) : choose(x + 0.5, y + 0.5);
                        add_sample(sum, projector, x, y, projector.point(x, y, s, t));
                    }
                }
                write(x, y, sum);
            }
        }
    }

    void add_sample(TexelSums& sum, TexelProjector& projector, std::uint32_t x, std::uint32_t y,
                    const TexelSample& at) const {
        const SurfacePoint point = projector.project_to_source(at, x, y);
        ++sum.steps[static_cast<std::size_t>(point.step)];
        sum.add(sampler_.sample(projector.part(), point, projector.spacing()),
                1.0f / static_cast<float>(samples_ * samples_));
        const double dx = at.x - x - 0.5, dy = at.y - y - 0.5, squared_distance = dx * dx + dy * dy;
        if (squared_distance < sum.squared_distance) {
            sum.squared_distance = squared_distance;
            sum.origin = {projector.part(), point};
        }
        if (request_.channels.normal) {
            sum.normal += projector.to_tangent_space(
                at, sampler_.normal(projector.part(), point, projector.spacing(), projector.face_normal(at)));
        }
        add_layers(sum, projector, at, point);
    }

    // Samples of another material, on a neighbouring face, are skipped: they have no value for these layers.
    void add_layers(TexelSums& sum, const TexelProjector& projector, const TexelSample& at,
                    const SurfacePoint& point) const {
        if (request_.layers.empty() || sampler_.material(projector.part(), point) != request_.material)
            return;
        ++sum.layer_samples;
        const double spacing = projector.spacing();
        for (std::size_t i = 0; i < request_.layers.size(); ++i) {
            const ExtensionLayer& layer = request_.layers[i];
            if (!layer.is_normal_map()) {
                sum.add_layer(i, sampler_.layer(projector.part(), point, spacing, layer));
                continue;
            }
            const Vector3 normal = projector.to_tangent_space(
                at,
                sampler_.layer_normal(projector.part(), point, spacing, projector.face_normal(at), layer));
            sum.add_layer(i, {static_cast<float>(normal.x()), static_cast<float>(normal.y()),
                              static_cast<float>(normal.z()), 0});
        }
    }

    void write(std::uint32_t x, std::uint32_t y, const TexelSums& texel) {
        const std::size_t at = std::size_t{y} * request_.atlas.width + x;
        is_covered_[at] = 1;
        approximate_samples_[at] = texel.steps[static_cast<std::size_t>(MapStep::approximate)];
        closest_samples_[at] = texel.steps[static_cast<std::size_t>(MapStep::closest)];
        if (!images_.origins.empty()) images_.origins[at] = texel.origin;
        if (request_.channels.base) {
            write_base(at, texel);
        }
        if (!images_.occlusion_roughness_metallic.rgba.empty()) {
            std::uint8_t* p = &images_.occlusion_roughness_metallic.rgba[4 * at];
            for (std::size_t k = 0; k < 3; ++k) p[k] = linear_byte(texel.orm[k]);
        }
        if (request_.channels.emissive) {
            std::uint8_t* p = &images_.emissive.rgba[4 * at];
            for (std::size_t k = 0; k < 3; ++k) p[k] = srgb_byte(texel.emissive[k]);
        }
        if (request_.channels.normal) write_normal(texel.normal, &images_.normal.rgba[4 * at]);
        if (texel.layer_samples == 0) return;
        has_layer_samples_[at] = 1;
        for (std::size_t i = 0; i < request_.layers.size(); ++i)
            write_layer(request_.layers[i], texel.layers[i], 1.0f / static_cast<float>(texel.layer_samples),
                        &images_.layers[i].rgba[4 * at]);
    }

    void write_base(std::size_t at, const TexelSums& texel) {
        const float alpha = texel.base[3];
        const bool is_visible = alpha > min_visible_alpha;
        std::uint8_t* p = &images_.base.rgba[4 * at];
        if (is_visible) {
            for (std::size_t k = 0; k < 3; ++k) p[k] = srgb_byte(texel.base[k] / alpha);
        } else {
            const Vec3f stored = sampler_.stored_base_color(texel.origin.part, texel.origin.point);
            for (std::size_t k = 0; k < 3; ++k) p[k] = srgb_byte(stored[k]);
        }
        p[3] = linear_byte(alpha);
        if (has_color_.empty()) return;
        has_color_[at] = is_visible;
        material_[at] = sampler_.material(texel.origin.part, texel.origin.point);
    }

    // The texels of a material without any visible texel keep the colours that were stored under its alpha.
    void keep_colors_of_hidden_materials() {
        if (has_color_.empty()) return;
        const std::size_t count = job_.source.materials.size();
        const auto slot = [&](Index material) { return std::min<std::size_t>(material, count); };
        std::vector<std::uint8_t> is_visible(count + 1, 0);
        for (std::size_t i = 0; i < is_covered_.size(); ++i)
            if (has_color_[i]) is_visible[slot(material_[i])] = 1;
        for (std::size_t i = 0; i < is_covered_.size(); ++i)
            if (is_covered_[i] && !is_visible[slot(material_[i])]) has_color_[i] = 1;
    }

    static void write_layer(const ExtensionLayer& layer, const LinearColor& sum, float share,
                            std::uint8_t* to) {
        if (layer.is_normal_map()) return write_normal(Vector3(sum[0], sum[1], sum[2]), to);
        const bool is_color = layer.encoding() == TexelEncoding::color_and_data_alpha;
        for (std::size_t k = 0; k < 3 && layer.has_color(); ++k)
            to[k] = is_color ? srgb_byte(sum[k] * share) : linear_byte(sum[k] * share);
        if (layer.has_alpha()) to[3] = linear_byte(sum[3] * share);
    }

    void count_samples() {
        auto& [history, approximate, closest] = images_.samples;
        for (std::size_t i = 0; i < is_covered_.size(); ++i) {
            images_.texels += is_covered_[i];
            history += is_covered_[i] *
                       (std::uint64_t{samples_} * samples_ - approximate_samples_[i] - closest_samples_[i]);
            approximate += approximate_samples_[i];
            closest += closest_samples_[i];
            images_.uncertain_texels += approximate_samples_[i] + closest_samples_[i] > 0;
        }
    }

    const BakeJob& job_;
    const SourceSampler& sampler_;
    const PageRequest& request_;
    std::uint32_t samples_;
    PageImages images_;
    // By texel: number of samples with MapStep::approximate and MapStep::closest.
    std::vector<std::uint8_t> approximate_samples_, closest_samples_;
    std::vector<std::uint8_t> is_covered_;         // by texel: in a cell or chart
    std::vector<std::uint8_t> has_color_;          // by texel: its colour is its own; empty without alpha
    std::vector<Index> material_;                  // by covered texel: in the source; empty without alpha
    std::vector<std::uint8_t> has_layer_samples_;  // by texel: has samples of the page's own material
};

}  // namespace

PageImages bake_page(const BakeJob& job, const SourceSampler& sampler, const PageRequest& request,
                     double done, double total) {
    PageBaker page(job, sampler, request);
    const auto bake_all = [&](const auto& pieces, std::size_t block) {
        parallel_blocks_with_progress(
            job, Phase::bake, pieces.size(), block, done, total,
            [&](std::size_t begin, std::size_t end, CancellationCheck check_cancelled) {
                for (std::size_t i = begin; i < end; ++i) page.bake(pieces[i], check_cancelled);
            });
        done += static_cast<double>(pieces.size());
    };
    // Cells are in descending order. Blocks of several small ones cost little to hand out, but every block has to be
    // small compared with the work of a thread.
    bake_all(request.atlas.cells, std::clamp<std::size_t>(request.atlas.cells.size() / 256, 1, 4));
    bake_all(request.tiles, 1);
    return page.finish();
}

}  // namespace faqem::detail

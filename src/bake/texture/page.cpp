#include "bake/texture/page.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "bake/texture/push_pull.hpp"
#include "bake/texture/texel_projector.hpp"
#include "faqem/engine/mesh/vector.hpp"

namespace faqem::detail {
namespace {

using engine::Vector3;

// Below this a texel's colour is that of texels around it.
constexpr float clear = 1.0f / 512;

constexpr std::size_t texels_per_poll = 4096;

Pixels blank(const Atlas& atlas, bool wanted, bool has_alpha, Poll poll) {
    if (!wanted) return {};
    poll.now();
    const std::size_t texels = std::size_t{atlas.width} * atlas.height;
    return {atlas.width, atlas.height, std::vector<std::uint8_t>(4 * texels, 255), has_alpha};
}

// Sums of samples.
struct Texel {
    explicit Texel(std::size_t layer_count) : layers(layer_count) {}

    Linear base{};
    std::array<float, 3> orm{};
    Vec3f emissive{};
    Vector3 normal = Vector3::Zero();  // in tangent space
    std::vector<Linear> layers;        // of the page's own material; normals in tangent space in RGB
    std::uint32_t layer_samples = 0;
    std::array<std::uint8_t, 3> steps{};  // samples by MapStep
    TexelOrigin origin;                   // of the sample next to the middle
    double off_middle = std::numeric_limits<double>::infinity();

    void add(const Appearance& a, float share) {
        for (std::size_t k = 0; k < 4; ++k) base[k] += share * a.base[k];
        orm[0] += share * a.occlusion;
        orm[1] += share * a.roughness;
        orm[2] += share * a.metallic;
        for (std::size_t k = 0; k < 3; ++k) emissive[k] += share * a.emissive[k];
    }

    void add_layer(std::size_t layer, const Linear& value) {
        for (std::size_t k = 0; k < 4; ++k) layers[layer][k] += value[k];
    }
};

// The bytes of a direction; of straight up where there is none.
void write_normal(const Vector3& sum, std::uint8_t* to) {
    const double length = sum.norm();
    const Vector3 n = length > 1e-6 ? Vector3(sum / length) : Vector3(0, 0, 1);
    for (Eigen::Index k = 0; k < 3; ++k) to[k] = linear_byte((n[k] + 1) / 2);
}

class Page {
public:
    Page(const BakeJob& job, const SourceSurface& surface, const PageRequest& request)
        : job_(job), surface_(surface), request_(request), samples_(job.options.bake.samples) {
        const Atlas& atlas = request.atlas;
        const Channels& channels = request.channels;
        const Poll poll = job.poll();
        images_.base = blank(atlas, channels.base, request.alpha_mode != AlphaMode::opaque, poll);
        images_.occlusion_roughness_metallic =
            blank(atlas, channels.occlusion || channels.metallic_roughness, false, poll);
        images_.emissive = blank(atlas, channels.emissive, false, poll);
        images_.normal = blank(atlas, channels.normal, false, poll);
        for (const ExtensionLayer& layer : request.layers)
            images_.layers.push_back(blank(atlas, true, layer.has_alpha(), poll));
        known_.assign(std::size_t{atlas.width} * atlas.height, 0);
        relaxed_.assign(known_.size(), 0);
        closest_.assign(known_.size(), 0);
        if (job.options.bake.correspondence == Recording::on) images_.origins.resize(known_.size());
        if (images_.base.has_alpha) opaque_.assign(known_.size(), 0);
        if (!request.layers.empty()) own_.assign(known_.size(), 0);
    }

    void bake(const AtlasCell& cell, Poll poll) {
        Painter first = painter(cell.first);
        if (cell.second == no_index) {
            bake_texels(cell, poll, [&](double, double) -> Painter& { return first; });
            return;
        }
        // The two face each other with their hypotenuses and have the same legs: the weights of their right
        // corners tell which one is nearer.
        Painter second = painter(cell.second);
        bake_texels(cell, poll, [&](double x, double y) -> Painter& {
            return second.right_weight(x, y) > first.right_weight(x, y) ? second : first;
        });
    }

    void bake(const ChartTile& tile, Poll poll) {
        const TileOwners owned =
            tile_owners(request_.atlas, request_.charts[tile.chart], request_.across, tile, samples_);
        std::vector<Painter> painters;
        painters.reserve(owned.triangles.size());
        for (Index t : owned.triangles) painters.push_back(painter(t));
        for (std::uint32_t y = 0; y < tile.height; ++y) {
            for (std::uint32_t x = 0; x < tile.width; ++x) {
                const std::size_t first = (std::size_t{y} * tile.width * samples_ + x) * samples_;
                if (owned.owners[first] == TileOwners::none) continue;
                poll(std::uint64_t{samples_} * samples_);
                Texel sum(request_.layers.size());
                for (std::uint32_t j = 0; j < samples_; ++j) {
                    for (std::uint32_t i = 0; i < samples_; ++i) {
                        const double s = (i + 0.5) / samples_, t = (j + 0.5) / samples_;
                        Painter& painter =
                            painters[owned.owners[first + std::size_t{j} * tile.width * samples_ + i]];
                        add_sample(sum, painter, tile.x + x, tile.y + y,
                                   painter.point(tile.x + x, tile.y + y, s, t));
                    }
                }
                write(tile.x + x, tile.y + y, sum);
            }
        }
    }

    PageImages finish() {
        count_samples();
        struct Filled {
            Pixels& image;
            const std::vector<std::uint8_t>&known, &known_alpha;
        };
        std::vector<Filled> all = {{images_.base, images_.base.has_alpha ? opaque_ : known_, known_},
                                   {images_.occlusion_roughness_metallic, known_, known_},
                                   {images_.emissive, known_, known_},
                                   {images_.normal, known_, known_}};
        for (Pixels& layer : images_.layers) all.push_back({layer, own_, own_});
        parallel_blocks(all.size(), 1, job_.workers(), [&](std::size_t i, std::size_t, Poll poll) {
            auto& [image, known, known_alpha] = all[i];
            if (image.rgba.empty()) return;
            push_pull(image, known, {0, 3}, poll);
            if (image.has_alpha) push_pull(image, known_alpha, {3, 4}, poll);
        });
        return std::move(images_);
    }

private:
    Painter painter(Index triangle) const {
        return {
            job_, {request_.atlas, request_.across, request_.faces, request_.tangents}, triangle, samples_};
    }

    // Texels between strangers belong to one of them; one on the hypotenuse of partners is both's.
    template <class Choose>
    void bake_texels(const AtlasCell& cell, Poll poll, Choose&& choose) {
        for (std::uint32_t y = cell.y; y < cell.y + cell.height; ++y) {
            for (std::uint32_t x = cell.x; x < cell.x + cell.width; ++x) {
                poll(std::uint64_t{samples_} * samples_);
                Texel sum(request_.layers.size());
                for (std::uint32_t j = 0; j < samples_; ++j) {
                    for (std::uint32_t i = 0; i < samples_; ++i) {
                        const double s = (i + 0.5) / samples_, t = (j + 0.5) / samples_;
                        Painter& painter = cell.joined ? choose(x + s, y + t) : choose(x + 0.5, y + 0.5);
                        add_sample(sum, painter, x, y, painter.point(x, y, s, t));
                    }
                }
                write(x, y, sum);
            }
        }
    }

    void add_sample(Texel& sum, Painter& painter, std::uint32_t x, std::uint32_t y,
                    const SmallPoint& at) const {
        const SurfacePoint point = painter.on_original(at, x, y);
        ++sum.steps[static_cast<std::size_t>(point.step)];
        sum.add(surface_.sample(painter.part(), point, painter.spacing()),
                1.0f / static_cast<float>(samples_ * samples_));
        const double off_middle = std::hypot(at.x - x - 0.5, at.y - y - 0.5);
        if (off_middle < sum.off_middle) {
            sum.off_middle = off_middle;
            sum.origin = {painter.part(), point};
        }
        if (request_.channels.normal) {
            sum.normal += painter.in_tangent_space(
                at, surface_.normal(painter.part(), point, painter.spacing(), painter.side(at)));
        }
        add_layers(sum, painter, at, point);
    }

    // What a neighbour of another material shows has nothing to do with this one's extensions.
    void add_layers(Texel& sum, const Painter& painter, const SmallPoint& at,
                    const SurfacePoint& point) const {
        if (request_.layers.empty() || surface_.material(painter.part(), point) != request_.material) return;
        ++sum.layer_samples;
        const double spacing = painter.spacing();
        for (std::size_t i = 0; i < request_.layers.size(); ++i) {
            const ExtensionLayer& layer = request_.layers[i];
            if (!layer.is_normal()) {
                sum.add_layer(i, surface_.layer(painter.part(), point, spacing, layer));
                continue;
            }
            const Vector3 normal = painter.in_tangent_space(
                at, surface_.layer_normal(painter.part(), point, spacing, painter.side(at), layer));
            sum.add_layer(i, {static_cast<float>(normal.x()), static_cast<float>(normal.y()),
                              static_cast<float>(normal.z()), 0});
        }
    }

    void write(std::uint32_t x, std::uint32_t y, const Texel& texel) {
        const std::size_t at = std::size_t{y} * request_.atlas.width + x;
        known_[at] = 1;
        relaxed_[at] = texel.steps[static_cast<std::size_t>(MapStep::relaxed)];
        closest_[at] = texel.steps[static_cast<std::size_t>(MapStep::closest)];
        if (!images_.origins.empty()) images_.origins[at] = texel.origin;
        if (request_.channels.base) {
            const float alpha = texel.base[3];
            std::uint8_t* p = &images_.base.rgba[4 * at];
            for (std::size_t k = 0; k < 3; ++k) p[k] = alpha > clear ? srgb_byte(texel.base[k] / alpha) : 0;
            p[3] = linear_byte(alpha);
            if (!opaque_.empty()) opaque_[at] = alpha > clear;
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
        own_[at] = 1;
        for (std::size_t i = 0; i < request_.layers.size(); ++i)
            write_layer(request_.layers[i], texel.layers[i], 1.0f / static_cast<float>(texel.layer_samples),
                        &images_.layers[i].rgba[4 * at]);
    }

    static void write_layer(const ExtensionLayer& layer, const Linear& sum, float share, std::uint8_t* to) {
        if (layer.is_normal()) return write_normal(Vector3(sum[0], sum[1], sum[2]), to);
        const bool is_colour = layer.encoding() == Encoding::colour_and_number;
        for (std::size_t k = 0; k < 3 && layer.has_colour(); ++k)
            to[k] = is_colour ? srgb_byte(sum[k] * share) : linear_byte(sum[k] * share);
        if (layer.has_alpha()) to[3] = linear_byte(sum[3] * share);
    }

    void count_samples() {
        const Poll poll = job_.poll();
        auto& [history, relaxed, closest] = images_.samples;
        for (std::size_t i = 0; i < known_.size(); ++i) {
            if (i % texels_per_poll == 0) poll(texels_per_poll / 16);
            images_.texels += known_[i];
            history += known_[i] * (std::uint64_t{samples_} * samples_ - relaxed_[i] - closest_[i]);
            relaxed += relaxed_[i];
            closest += closest_[i];
            images_.uncertain_texels += relaxed_[i] + closest_[i] > 0;
        }
    }

    const BakeJob& job_;
    const SourceSurface& surface_;
    const PageRequest& request_;
    std::uint32_t samples_;
    PageImages images_;
    std::vector<std::uint8_t> relaxed_, closest_;  // samples of each texel that were found so
    std::vector<std::uint8_t> known_;              // texels in cells
    std::vector<std::uint8_t> opaque_;             // those with a colour
    std::vector<std::uint8_t> own_;                // those with samples of the page's own material
};

}  // namespace

PageImages bake_page(const BakeJob& job, const SourceSurface& surface, const PageRequest& request,
                     double done, double total) {
    Page page(job, surface, request);
    const auto bake_all = [&](const auto& pieces, std::size_t block) {
        polled_blocks(job, Phase::bake, pieces.size(), block, done, total,
                      [&](std::size_t begin, std::size_t end, Poll poll) {
                          for (std::size_t i = begin; i < end; ++i) page.bake(pieces[i], poll);
                      });
        done += static_cast<double>(pieces.size());
    };
    bake_all(request.atlas.cells, 4);
    bake_all(request.tiles, 1);
    return page.finish();
}

}  // namespace faqem::detail

#include "bake/keep/picture_loss.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "asset/image/srgb.hpp"
#include "bake/keep/seen_points.hpp"
#include "bake/parts/corner_normals.hpp"
#include "bake/source/source_normals.hpp"
#include "scene/vector_conversion.hpp"

namespace faqem::detail {
namespace {

using engine::to_eigen;
using engine::Vector3;

constexpr std::size_t view_count = 6;

// What is seen at a pixel, unlit and lit, as sRGB values in [0, 1].
struct Shade {
    std::array<double, 3> unlit, lit;
};

// By compared size.
using SizedShades = std::array<Shade, 2>;

// Grey, so that neither dark nor bright surfaces stand out.
constexpr Shade background = {{0.5, 0.5, 0.5}, {0.5, 0.5, 0.5}};

// The transform of normals of a part into the scene.
struct Placement {
    Eigen::Matrix4d transform = Eigen::Matrix4d::Identity();
    Eigen::Matrix3d normals = Eigen::Matrix3d::Identity();
    double scale = 1;  // of lengths, the mean over the axes
};

Placement placement_of(const std::array<double, 16>& matrix) {
    Placement result;
    result.transform = Eigen::Map<const Eigen::Matrix4d>(matrix.data());
    const Eigen::Matrix3d linear = result.transform.topLeftCorner<3, 3>();
    const double volume = linear.determinant();
    if (!(std::abs(volume) > 0) || !std::isfinite(volume)) return result;
    result.normals = linear.inverse().transpose();
    result.scale = std::cbrt(std::abs(volume));
    return result;
}

PlacedMesh placed_mesh(Index part, std::span<const Vec3> positions, std::span<const Triangle> triangles,
                       const Placement& at) {
    PlacedMesh result{part, triangles, {}};
    result.positions.reserve(positions.size());
    for (const Vec3& p : positions)
        result.positions.push_back((at.transform * to_eigen(p).homogeneous()).head<3>());
    return result;
}

// The colour of a surface under one light from the upper left of the camera, with a highlight.
Shade shade(const LinearColor& base, Vector3 normal, const Vector3& winding, const Placement& at,
            const View& view) {
    normal = (at.normals * normal).stableNormalized();
    if ((at.normals * winding).dot(view.back) < 0) normal = -normal;
    const Vector3 light = (view.back + 0.5 * view.up - 0.4 * view.right).normalized();
    const double diffuse = 0.25 + 0.75 * std::max(0.0, normal.dot(light));
    const double shine = std::max(0.0, normal.dot((light + view.back).normalized()));
    const double highlight = 0.1 * std::pow(shine, 24);
    Shade result{};
    for (std::size_t k = 0; k < 3; ++k) {
        // The background shows through: base colours are premultiplied.
        const double behind = 0.2 * (1 - static_cast<double>(base[3]));
        const auto own = static_cast<double>(base[k]);
        result.unlit[k] = srgb_from_linear(std::clamp(own + behind, 0.0, 1.0));
        result.lit[k] = srgb_from_linear(std::clamp(own * diffuse + highlight * base[3] + behind, 0.0, 1.0));
    }
    return result;
}

// Longer side of a pixel's area on a face, in the part's units, for a picture of one of the compared sizes. Viewers
// filter textures by it. It is limited to ten times that of a face parallel to the picture.
double pixel_on_surface(std::size_t size, const Vector3& winding, const Placement& at, const View& view) {
    const double slope = std::abs((at.normals * winding).stableNormalized().dot(view.back));
    return view.pixel * view.size / compared_sizes[size] / at.scale / std::max(0.1, slope);
}

void add_squares(PictureDifference& sum, const Shade& a, const Shade& b) {
    for (std::size_t k = 0; k < 3; ++k) {
        sum.unlit += (a.unlit[k] - b.unlit[k]) * (a.unlit[k] - b.unlit[k]);
        sum.lit += (a.lit[k] - b.lit[k]) * (a.lit[k] - b.lit[k]);
    }
}

// The pictures of one set of parts.
class Pictures {
public:
    Pictures(const ComparedScenes& scenes, std::span<const Index> parts) : scenes_(scenes) {
        std::vector<const Instance*> first(scenes.source.parts.size(), nullptr);
        const std::vector<Instance> all = instances(scenes.source);
        for (const Instance& instance : all)
            if (!first[instance.part]) first[instance.part] = &instance;
        for (const Index p : parts) {
            placements_.push_back(first[p] ? placement_of(first[p]->transform) : Placement{});
            const Placement& at = placements_.back();
            const Part &part = scenes.source.parts[p], &kept = scenes.kept.parts[p];
            const TriangleMesh& baked = scenes.parts[p].simplified->mesh;
            source_.push_back(placed_mesh(p, part.positions, part.triangles, at));
            kept_.push_back(placed_mesh(p, kept.positions, kept.triangles, at));
            baked_.push_back(placed_mesh(p, baked.positions, baked.triangles, at));
        }
    }

    ComparedPictures compare(std::uint32_t size, const RunContext& context) const {
        const std::vector<View> views = views_around(source_, view_count, size);
        std::vector<ComparedPictures> sums(view_count);
        parallel_blocks(view_count, 1, context,
                        [&](std::size_t v, std::size_t, const RunContext& block_context) {
                            sums[v] = squares_of_view(views[v], block_context);
                        });
        ComparedPictures result;
        for (const ComparedPictures& sum : sums) result.points += sum.points;
        const double share = 1 / (3 * static_cast<double>(result.points));
        for (std::size_t i = 0; i < result.differences.size(); ++i) {
            auto& [kept, baked] = result.differences[i];
            for (const ComparedPictures& sum : sums) {
                kept += sum.differences[i].kept;
                baked += sum.differences[i].baked;
            }
            kept = kept * share;
            baked = baked * share;
        }
        return result;
    }

private:
    ComparedPictures squares_of_view(const View& view, const RunContext& context) const {
        const std::vector<SeenPoint> of_source = seen_points(source_, view);
        const std::vector<SeenPoint> of_kept = seen_points(kept_, view);
        const std::vector<SeenPoint> of_baked = seen_points(baked_, view);
        ComparedPictures sums;
        for (std::size_t i = 0; i < of_source.size(); ++i) {
            const SeenPoint &source = of_source[i], &kept = of_kept[i], &baked = of_baked[i];
            const bool is_empty = source.mesh == no_index && kept.mesh == no_index && baked.mesh == no_index;
            if (is_empty) continue;
            context.count(8 * map_query_cost);
            const auto wanted = shade_original(scenes_.source_sampler, scenes_.source, source, view);
            const auto with_kept = shade_original(scenes_.kept_sampler, scenes_.kept, kept, view);
            const auto with_baked = shade_baked(baked, view);
            for (std::size_t s = 0; s < sums.differences.size(); ++s) {
                add_squares(sums.differences[s].kept, wanted[s], with_kept[s]);
                add_squares(sums.differences[s].baked, wanted[s], with_baked[s]);
            }
            ++sums.points;
        }
        return sums;
    }

    // A point of an asset that has the sampler's images.
    SizedShades shade_original(const SourceSampler& sampler, const Asset& asset, const SeenPoint& seen,
                               const View& view) const {
        if (seen.mesh == no_index) return {background, background};
        const Index p = source_[seen.mesh].part;
        const Placement& at = placements_[seen.mesh];
        const SurfacePoint point{seen.face, seen.barycentric};
        const Vector3 winding = winding_normal(asset.parts[p].positions, asset.parts[p].triangles[seen.face]);
        SizedShades result;
        for (std::size_t s = 0; s < result.size(); ++s) {
            const double spacing = pixel_on_surface(s, winding, at, view);
            result[s] = shade(sampler.sample(p, point, spacing).base,
                              sampler.normal(p, point, spacing, winding), winding, at, view);
        }
        return result;
    }

    // A point of a mesh that would be baked.
    SizedShades shade_baked(const SeenPoint& seen, const View& view) const {
        if (seen.mesh == no_index) return {background, background};
        const Index p = source_[seen.mesh].part;
        const Placement& at = placements_[seen.mesh];
        const BakePart& part = scenes_.parts[p];
        const SurfacePoint point = part.map->map(seen.face, seen.barycentric);
        const Vector3 winding = oriented_face_normal(part, seen.face);
        Vector3 own_normal = Vector3::Zero();
        for (std::size_t k = 0; k < 3; ++k)
            own_normal +=
                seen.barycentric[k] * to_vector(part.normals.normals[std::size_t{3} * seen.face + k]);
        SizedShades result;
        for (std::size_t s = 0; s < result.size(); ++s) {
            const double spacing = pixel_on_surface(s, winding, at, view) + scenes_.page_texels[p];
            const Vector3 normal = scenes_.gets_normal_map[p]
                                       ? scenes_.source_sampler.normal(p, point, spacing, winding)
                                       : own_normal;
            result[s] =
                shade(scenes_.source_sampler.sample(p, point, spacing).base, normal, winding, at, view);
        }
        return result;
    }

    const ComparedScenes& scenes_;
    std::vector<Placement> placements_;  // by mesh of the pictures
    std::vector<PlacedMesh> source_, kept_, baked_;
};

}  // namespace

ComparedPictures compare_pictures(const ComparedScenes& scenes, std::span<const Index> parts,
                                  std::uint32_t size, const RunContext& context) {
    return Pictures(scenes, parts).compare(size, context);
}

}  // namespace faqem::detail

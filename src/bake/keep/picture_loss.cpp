#include "bake/keep/picture_loss.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <vector>

#include "asset/image/srgb.hpp"
#include "asset/scene/affine.hpp"
#include "bake/parts/corner_normals.hpp"
#include "bake/source/source_normals.hpp"
#include "render/visible_points.hpp"
#include "scene/material_groups.hpp"
#include "scene/placed_parts.hpp"
#include "scene/vector_conversion.hpp"

namespace faqem::detail {
namespace {

using engine::Vector3;
using render::Camera;
using render::VisiblePoint;

constexpr std::size_t view_count = 6;

// What is seen at a pixel, unlit and lit, as sRGB values in [0, 1].
struct Shade {
    std::array<double, 3> unlit, lit;
};

// By compared size.
using SizedShades = std::array<Shade, 2>;

// Grey, so that neither dark nor bright surfaces stand out.
constexpr Shade background = {{0.5, 0.5, 0.5}, {0.5, 0.5, 0.5}};

// Where a part is in the scene.
struct Placement {
    explicit Placement(const std::array<double, 16>& transform) : matrix(transform), normals(transform) {
        const Eigen::Map<const Eigen::Matrix4d> m(matrix.data());
        const double volume = std::abs(m.topLeftCorner<3, 3>().determinant());
        if (volume > 0 && std::isfinite(volume)) scale = std::cbrt(volume);
    }

    Vector3 unit_normal(const Vector3& n) const { return to_vector(normals(to_vec3f(n))); }

    std::array<double, 16> matrix;
    NormalTransform normals;
    double scale = 1;  // of lengths, the mean over the axes
};

// How the surface at a point is seen.
struct SeenSurface {
    // \param own_winding  normal of the face in its part
    SeenSurface(const render::PlacedMesh& mesh, const VisiblePoint& seen, const Vector3& own_winding,
                const Placement& at, const Camera& seen_from)
        : placement(at), camera(seen_from), winding(at.unit_normal(own_winding)) {
        Vector3 from_eye = -camera.eye;
        for (std::size_t k = 0; k < 3; ++k)
            from_eye += seen.barycentric[k] * mesh.positions[mesh.triangles[seen.face][k]];
        to_eye = -from_eye.stableNormalized();
        const double side = 2 * camera.tan_half_fov * -from_eye.dot(camera.back);
        picture_side = side / at.scale / std::max(0.1, std::abs(winding.dot(to_eye)));
    }

    // Longer side of a pixel's area on the face for a picture of one of the compared sizes.
    double pixel(std::size_t size) const { return picture_side / compared_sizes[size]; }

    const Placement& placement;
    const Camera& camera;
    Vector3 winding, to_eye;  // unit vectors in the scene
    // Longer side of the picture's area on the face, in the part's units. Viewers filter textures by it. It is limited
    // to ten times that of a face parallel to the picture.
    double picture_side;
};

// The colour of a surface under one light from the upper left of the camera, with a highlight.
Shade shade(const LinearColor& base, const Vector3& own_normal, const SeenSurface& at) {
    Vector3 normal = at.placement.unit_normal(own_normal);
    if (at.winding.dot(at.to_eye) < 0) normal = -normal;
    const Vector3 key = (at.camera.back + 0.5 * at.camera.up - 0.4 * at.camera.right).normalized();
    const double diffuse = 0.25 + 0.75 * std::max(0.0, normal.dot(key));
    const double shine = std::max(0.0, normal.dot((key + at.to_eye).normalized()));
    const double highlight = 0.1 * std::pow(shine, 24);
    Shade result{};
    for (std::size_t k = 0; k < 3; ++k) {
        // The background shows through: base colours are premultiplied.
        const double behind = 0.2 * (1 - static_cast<double>(base[3]));
        const double lit = base[k] * diffuse + highlight * base[3];
        result.unlit[k] = srgb_from_linear(std::clamp(base[k] + behind, 0.0, 1.0));
        result.lit[k] = srgb_from_linear(std::clamp(lit + behind, 0.0, 1.0));
    }
    return result;
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
    Pictures(const ComparedScenes& scenes, std::span<const Index> parts) : scenes_(scenes), parts_(parts) {
        std::vector<const Instance*> first(scenes.source.parts.size(), nullptr);
        const std::vector<Instance> all = instances(scenes.source);
        for (const Instance& instance : all)
            if (!first[instance.part]) first[instance.part] = &instance;
        for (const Index p : parts) {
            const Placement& at =
                placements_.emplace_back(first[p] ? first[p]->transform : identity_transform);
            const Part &part = scenes.source.parts[p], &kept = scenes.kept.parts[p];
            const TriangleMesh& baked = scenes.parts[p].simplified->mesh;
            const std::vector<Index>& origin = scenes.parts[p].simplified->history.remaining_faces;
            is_sharp_.push_back(materials_of(part).size() > 1 || shows_single_texels(scenes.source, part));
            source_.add(part.positions, part.triangles, at.matrix, scenes.source,
                        [&](std::size_t f) { return face_material(part, f); });
            kept_.add(kept.positions, kept.triangles, at.matrix, scenes.kept,
                      [&](std::size_t f) { return face_material(kept, f); });
            baked_.add(baked.positions, baked.triangles, at.matrix, scenes.source,
                       [&](std::size_t f) { return face_material(part, origin[f]); });
        }
    }

    ComparedPictures compare(std::uint32_t size, const RunContext& context) const {
        const std::vector<Camera> cameras = render::cameras_around(source_.meshes, view_count);
        std::vector<ComparedPictures> sums(view_count);
        parallel_blocks(view_count, 1, context,
                        [&](std::size_t v, std::size_t, const RunContext& block_context) {
                            sums[v] = squares_of_view(cameras[v], size, block_context);
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
    ComparedPictures squares_of_view(const Camera& camera, std::uint32_t size,
                                     const RunContext& context) const {
        const std::vector<VisiblePoint> of_source = render::visible_points(source_.meshes, camera, size);
        const std::vector<VisiblePoint> of_kept = render::visible_points(kept_.meshes, camera, size);
        const std::vector<VisiblePoint> of_baked = render::visible_points(baked_.meshes, camera, size);
        ComparedPictures sums;
        for (std::size_t i = 0; i < of_source.size(); ++i) {
            const VisiblePoint &source = of_source[i], &kept = of_kept[i], &baked = of_baked[i];
            const bool is_empty = source.mesh == no_index && kept.mesh == no_index && baked.mesh == no_index;
            if (is_empty) continue;
            context.count(8 * map_query_cost);
            const auto wanted =
                shade_original(scenes_.source_sampler, scenes_.source, source_, source, camera);
            const auto with_kept = shade_original(scenes_.kept_sampler, scenes_.kept, kept_, kept, camera);
            const auto with_baked = shade_baked(baked, camera);
            for (std::size_t s = 0; s < sums.differences.size(); ++s) {
                add_squares(sums.differences[s].kept, wanted[s], with_kept[s]);
                add_squares(sums.differences[s].baked, wanted[s], with_baked[s]);
            }
            ++sums.points;
        }
        return sums;
    }

    // A point of an asset that has the sampler's images.
    SizedShades shade_original(const SourceSampler& sampler, const Asset& asset, const PlacedParts& placed,
                               const VisiblePoint& seen, const Camera& camera) const {
        if (seen.mesh == no_index) return {background, background};
        const Index p = parts_[seen.mesh];
        const SurfacePoint point{seen.face, seen.barycentric};
        const Vector3 winding = winding_normal(asset.parts[p].positions, asset.parts[p].triangles[seen.face]);
        const SeenSurface at(placed.meshes[seen.mesh], seen, winding, placements_[seen.mesh], camera);
        SizedShades result;
        for (std::size_t s = 0; s < result.size(); ++s) {
            const double spacing = at.pixel(s);
            result[s] =
                shade(sampler.sample(p, point, spacing).base, sampler.normal(p, point, spacing, winding), at);
        }
        return result;
    }

    // A point of a mesh that would be baked.
    SizedShades shade_baked(const VisiblePoint& seen, const Camera& camera) const {
        if (seen.mesh == no_index) return {background, background};
        const Index p = parts_[seen.mesh];
        const BakePart& part = scenes_.parts[p];
        const SurfacePoint point = part.map->map(seen.face, seen.barycentric);
        const Vector3 winding = oriented_face_normal(part, seen.face);
        const SeenSurface at(baked_.meshes[seen.mesh], seen, winding, placements_[seen.mesh], camera);
        const Vector3 own_normal = blended_normal(part, seen.face, seen.barycentric);
        SizedShades result;
        for (std::size_t s = 0; s < result.size(); ++s) {
            const double spacing = at.pixel(s) + scenes_.page_texels[p];
            const Vector3 normal = scenes_.gets_normal_map[p]
                                       ? scenes_.source_sampler.normal(p, point, spacing, winding)
                                       : own_normal;
            result[s] = shade(baked_base(p, seen, point, spacing), normal, at);
        }
        return result;
    }

    // The base colour of a new page. It blurs what the source shows sharply: borders of materials and single texels.
    LinearColor baked_base(Index p, const VisiblePoint& seen, const SurfacePoint& point,
                           double spacing) const {
        if (!is_sharp_[seen.mesh]) return scenes_.source_sampler.sample(p, point, spacing).base;
        const TriangleMesh& mesh = scenes_.parts[p].simplified->mesh;
        const auto [a, b, c] = corners_of(mesh.positions, mesh.triangles[seen.face]);
        const Vector3 u = b - a, v = c - a;
        const double area = u.cross(v).norm();
        // The mean of four points, a step to both sides along u and across it. The step is the standard deviation of a
        // linear filter between texels.
        const double step = scenes_.page_texels[p] / std::sqrt(6.0);
        const double along = step / u.norm(), across = step * u.norm() / area;
        const double skew = across * u.dot(v) / u.squaredNorm();
        LinearColor sum{};
        for (const auto& [x, y] : {std::pair(-1, -1), std::pair(-1, 1), std::pair(1, -1), std::pair(1, 1)}) {
            const double second = x * along - y * skew, third = y * across;
            Vec3 moved = {seen.barycentric[0] - second - third, seen.barycentric[1] + second,
                          seen.barycentric[2] + third};
            // Points outside the face are moved to it.
            for (double& w : moved) w = std::max(w, 0.0);
            const double total = moved[0] + moved[1] + moved[2];
            for (double& w : moved) w /= total;
            if (!(total > 0 && std::isfinite(total))) moved = seen.barycentric;
            const LinearColor one =
                scenes_.source_sampler.sample(p, scenes_.parts[p].map->map(seen.face, moved), spacing).base;
            for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += one[k] / 4;
        }
        return sum;
    }

    const ComparedScenes& scenes_;
    std::span<const Index> parts_;       // by mesh of the pictures
    std::vector<Placement> placements_;  // by mesh of the pictures
    std::vector<bool> is_sharp_;         // likewise
    PlacedParts source_, kept_, baked_;
};

}  // namespace

bool shows_single_texels(const Asset& asset, const Part& part) {
    return std::ranges::any_of(materials_of(part), [&](Index m) {
        const TextureRef& texture = asset.materials[m].base_color_texture;
        return texture && texture.filter == Filter::nearest;
    });
}

ComparedPictures compare_pictures(const ComparedScenes& scenes, std::span<const Index> parts,
                                  std::uint32_t size, const RunContext& context) {
    return Pictures(scenes, parts).compare(size, context);
}

}  // namespace faqem::detail

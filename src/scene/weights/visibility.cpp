#include "scene/weights/visibility.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "asset/scene/affine.hpp"
#include "asset/scene/flatten.hpp"
#include "asset/scene/measured_instances.hpp"
#include "asset/scene/source_traits.hpp"
#include "faqem/detail/geometry/bvh.hpp"
#include "faqem/detail/geometry/surface.hpp"
#include "faqem/detail/geometry/vertex_faces.hpp"
#include "faqem/error.hpp"
#include "render/camera.hpp"
#include "scene/material_groups.hpp"

namespace faqem::detail {

namespace {

constexpr std::size_t direction_count = 32;
// Distance of the rays' origins from the surface, relative to the diagonal.
constexpr double ray_offset_ratio = 1.0 / 5000;
// Radius of a patch around its first face, relative to the diagonal.
constexpr double max_patch_radius_ratio = 1.0 / 400;
// Smallest cosine between the normals of a patch's first face and its other faces.
constexpr double min_patch_normal_cosine = 0.8;
// No further large faces around a vertex are sampled once this visibility is reached.
constexpr double sufficient_visibility = 0.5;

// The occluding faces of all instances.
class Occluders {
public:
    Occluders(const Asset& scene, const std::vector<PosedInstance>& all, const RunContext& context) {
        check_size(scene, all);
        const Part placed = flatten(scene, all);
        std::vector<Triangle> triangles;
        for (std::size_t f = 0; f < placed.triangles.size(); ++f) {
            const OccludingSides kind = occluding_sides(scene, face_material(placed, f));
            if (kind == OccludingSides::none) continue;
            triangles.push_back(placed.triangles[f]);
            is_double_sided_.push_back(kind == OccludingSides::both);
        }
        tree_ = Bvh(placed.positions, triangles, context);
    }

    // Whether the point is hidden from a distant viewer in the given direction.
    bool is_occluded(const Vector3& point, const Vector3& direction) const {
        // If the ray hits the back of a face, the viewer sees its front.
        return tree_.any_hit(to_array(point), to_array(direction), [&](Index face, Bvh::Side side) {
            return side == Bvh::Side::back || is_double_sided_[face];
        });
    }

private:
    static void check_size(const Asset& scene, const std::vector<PosedInstance>& all) {
        std::uint64_t faces = 0, vertices = 0;
        for (const PosedInstance& instance : all) {
            faces += scene.parts[instance.part].triangles.size();
            vertices += scene.parts[instance.part].positions.size();
        }
        if (faces >= 1ull << 31 || vertices >= no_index)
            throw InputError({}, "scene",
                             "is too large for visibility: " + std::to_string(faces) +
                                 " faces in all instances, fewer than 2147483648 are supported");
    }

    Bvh tree_;
    std::vector<bool> is_double_sided_;
};

// Samples the visibility of the surface of one instance.
class VisibilitySampler {
public:
    VisibilitySampler(const Surface& surface, const Occluders& occluders, const RunContext& context)
        : surface_(surface),
          occluders_(occluders),
          around_(make_vertex_faces(surface.positions.size(), surface.triangles)),
          diagonal_(surface.diagonal()) {
        sample_patches(context);
    }

    // Visibility by position of the surface: the maximum over the faces around it.
    std::vector<float> by_position(const RunContext& context) const {
        std::vector<float> result(surface_.positions.size());
        parallel_each(result.size(), 64, context, [&](std::size_t v) {
            result[v] = static_cast<float>(visibility_at_position(static_cast<Index>(v)));
        });
        return result;
    }

private:
    double max_patch_radius() const { return max_patch_radius_ratio * diagonal_; }
    Vector3 centroid(Index face) const {
        return (surface_.corner(face, 0) + surface_.corner(face, 1) + surface_.corner(face, 2)) / 3;
    }
    bool is_small(Index face) const {
        double longest = 0;
        for (std::size_t k = 0; k < 3; ++k)
            longest =
                std::max(longest, (surface_.corner(face, (k + 1) % 3) - surface_.corner(face, k)).norm());
        return longest <= max_patch_radius();
    }

    // Combines small neighbouring faces with similar normals into patches, which have the visibility of their
    // first face.
    void sample_patches(const RunContext& context) {
        patch_.assign(surface_.triangles.size(), no_index);
        std::vector<Index> first, todo;
        for (Index f = 0; f < patch_.size(); ++f) {
            if (patch_[f] != no_index || !is_small(f)) continue;
            patch_[f] = static_cast<Index>(first.size());
            first.push_back(f);
            todo.assign(1, f);
            while (!todo.empty()) {
                const Index from = todo.back();
                todo.pop_back();
                for (const Index v : surface_.triangles[from]) grow_patch(v, f, todo);
            }
        }
        patch_visibility_.resize(first.size());
        parallel_each(first.size(), 64, context, [&](std::size_t i) {
            patch_visibility_[i] = visibility_from(first[i], centroid(first[i]));
        });
    }

    // Adds the faces around vertex v that belong to the patch of face `first`.
    void grow_patch(Index v, Index first, std::vector<Index>& todo) {
        for (const Index g : around_[v]) {
            if (patch_[g] != no_index || !is_small(g)) continue;
            if (!((centroid(g) - centroid(first)).norm() <= max_patch_radius())) continue;
            if (!(surface_.normals[g].dot(surface_.normals[first]) >= min_patch_normal_cosine)) continue;
            patch_[g] = patch_[first];
            todo.push_back(g);
        }
    }

    double visibility_at_position(Index position) const {
        double most = 0;
        for (const Index f : around_[position]) {
            if (patch_[f] != no_index) {
                most = std::max(most, patch_visibility_[patch_[f]]);
                continue;
            }
            if (most >= sufficient_visibility) continue;
            most = std::max(
                most, visibility_from(f, 0.55 * to_eigen(surface_.positions[position]) + 0.45 * centroid(f)));
        }
        return most;
    }

    // Visibility of a face at a point: the sum over both of its sides.
    double visibility_from(Index face, const Vector3& point) const {
        const Vector3& normal = surface_.normals[face];
        std::array<double, 2> seen = {}, all = {};  // by side
        for (const Vector3& direction : directions_) {
            const double cosine = normal.dot(direction);
            const bool up = cosine > 0;
            all[up] += std::abs(cosine);
            const Vector3 from = point + (up ? 1 : -1) * ray_offset_ratio * diagonal_ * normal;
            if (!occluders_.is_occluded(from, direction)) seen[up] += std::abs(cosine);
        }
        return std::min(1.0, seen[0] / all[0] + seen[1] / all[1]);
    }

    const Surface& surface_;
    const Occluders& occluders_;
    VertexFaces around_;
    double diagonal_;
    std::vector<Vector3> directions_ = render::even_directions(direction_count);
    std::vector<Index> patch_;  // by face; no_index: large face without a patch
    std::vector<double> patch_visibility_;
};

}  // namespace

OccludingSides occluding_sides(const Asset& scene, Index material) {
    if (material == no_index) return OccludingSides::front;
    const Material& m = scene.materials[material];
    if (m.alpha_mode != AlphaMode::opaque ||
        std::ranges::count(m.extensions, "KHR_materials_transmission") > 0)
        return OccludingSides::none;
    return m.double_sided ? OccludingSides::both : OccludingSides::front;
}

VertexVisibility vertex_visibility(const Asset& scene, const RunContext& context) {
    std::vector<PosedInstance> all;
    for (const Instance& instance : measured_instances(scene))
        all.push_back({instance.part, instance.transform});
    const Occluders occluders(scene, all, context);
    std::vector<std::vector<std::optional<float>>> seen(scene.parts.size());
    for (std::size_t p = 0; p < seen.size(); ++p) seen[p].resize(scene.parts[p].positions.size());
    for (const PosedInstance& instance : all) {
        context.check_now();
        const Part own = flatten(scene, {instance});
        const Surface surface = extract_surface({own.positions, own.triangles});
        const std::vector<float> at = VisibilitySampler(surface, occluders, context).by_position(context);
        for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
            for (std::size_t k = 0; k < 3; ++k) {
                std::optional<float>& most = seen[instance.part][own.triangles[surface.faces[t]][k]];
                most = std::max(most.value_or(0), at[surface.triangles[t][k]]);
            }
        }
    }
    VertexVisibility result;
    for (const auto& part : seen) {
        std::vector<float>& weights = result.weights.emplace_back();
        for (const std::optional<float>& share : part) {
            weights.push_back(std::max(min_visibility, share.value_or(1)));
            result.hidden_vertices += share == 0.0f;
        }
    }
    return result;
}

std::string visibility_warning(const Asset& scene) {
    return is_dynamic(scene)
               ? "visibility: the scene has animations, skins or morph targets, and was evaluated in its "
                 "default pose: surface that is visible in other poses only counts as hidden"
               : "";
}

}  // namespace faqem::detail

#include "scene/weights/hidden_surface.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "asset/scene/affine.hpp"
#include "asset/scene/measured_instances.hpp"
#include "asset/scene/source_traits.hpp"
#include "faqem/detail/base/parallel.hpp"
#include "faqem/detail/geometry/bvh.hpp"
#include "render/visible_points.hpp"
#include "scene/material_groups.hpp"
#include "scene/placed_parts.hpp"
#include "scene/weights/visibility.hpp"

namespace faqem::detail {
namespace {

// Pictures that tell what is deep inside, its distance from what they show, relative to the diagonal and to the length
// of edges of the result, and its factor.
constexpr std::size_t depth_view_count = 24;
constexpr std::uint32_t depth_picture_size = 384;
constexpr double depth_ratio = 0.003, depth_per_edge = 0.1;
constexpr float deep_factor = 0.1f;

// By part and face: whether it is seen in pictures from all sides, or is not opaque.
std::vector<std::vector<std::uint8_t>> faces_in_pictures(const Asset& scene, const std::vector<Instance>& all,
                                                         const RunContext& context) {
    std::vector<std::vector<std::uint8_t>> result;
    for (const Part& part : scene.parts) result.emplace_back(part.triangles.size(), std::uint8_t{0});
    std::vector<std::vector<Triangle>> opaque(all.size());  // and their faces, by instance
    std::vector<std::vector<Index>> face(all.size());
    PlacedParts placed;
    for (std::size_t i = 0; i < all.size(); ++i) {
        const Part& part = scene.parts[all[i].part];
        for (Index f = 0; f < part.triangles.size(); ++f) {
            if (occluding_sides(scene, face_material(part, f)) == OccludingSides::none) {
                result[all[i].part][f] = 1;
            } else {
                opaque[i].push_back(part.triangles[f]);
                face[i].push_back(f);
            }
        }
        placed.add(part.positions, opaque[i], all[i].transform, scene,
                   [&](std::size_t f) { return face_material(part, face[i][f]); });
    }
    const std::vector<render::Camera> cameras = render::cameras_around(placed.meshes, depth_view_count);
    using Seen = std::vector<std::vector<bool>>;  // by mesh and face
    std::vector<Seen> views(depth_view_count);
    parallel_each(depth_view_count, 1, context, [&](std::size_t v) {
        for (const std::vector<Triangle>& of_mesh : opaque) views[v].emplace_back(of_mesh.size());
        for (const render::VisiblePoint& at :
             render::visible_points(placed.meshes, cameras[v], depth_picture_size))
            if (at.mesh != no_index) views[v][at.mesh][at.face] = true;
    });
    for (const Seen& seen : views)
        for (std::size_t i = 0; i < all.size(); ++i)
            for (std::size_t f = 0; f < face[i].size(); ++f)
                if (seen[i][f]) result[all[i].part][face[i][f]] = 1;
    return result;
}

}  // namespace

std::uint64_t lower_hidden_weights(const Asset& scene, double share, std::vector<std::vector<float>>& weights,
                                   const RunContext& context) {
    if (is_dynamic(scene) || !(share > 0 && share < 1)) return 0;
    const std::vector<Instance> all = instances(scene);
    const std::vector<std::vector<std::uint8_t>> is_seen = faces_in_pictures(scene, all, context);
    std::vector<Vec3> positions;
    std::vector<Triangle> triangles;  // that are seen
    Eigen::AlignedBox3d box;
    double area = 0;
    std::vector<std::vector<std::uint8_t>> is_near(scene.parts.size());  // in any instance
    for (std::size_t p = 0; p < is_near.size(); ++p) is_near[p].resize(scene.parts[p].positions.size(), 1);
    for (const auto& [p, transform] : all) {
        const Part& part = scene.parts[p];
        const auto first = static_cast<Index>(positions.size());
        for (const Vec3& at : part.positions) {
            positions.push_back(transformed_point(transform, at));
            box.extend(to_eigen(positions.back()));
        }
        for (std::size_t f = 0; f < part.triangles.size(); ++f) {
            if (!is_seen[p][f]) continue;
            const auto [a, b, c] = part.triangles[f];
            const Triangle& t = triangles.emplace_back(Triangle{first + a, first + b, first + c});
            const auto at = [&](std::size_t k) { return to_eigen(positions[t[k]]); };
            area += (at(1) - at(0)).cross(at(2) - at(0)).norm() / 2;
        }
        is_near[p].assign(part.positions.size(), 0);
    }
    const Bvh tree(positions, triangles, context);
    const double edge = std::sqrt(area / std::max(1.0, share * shown_faces(scene, all)));
    const double reach = std::max(depth_ratio * box.diagonal().norm(), depth_per_edge * edge);
    std::size_t first = 0;
    for (const Instance& instance : all) {
        std::vector<std::uint8_t>& near = is_near[instance.part];
        parallel_each(near.size(), 64, context, [&](std::size_t v) {
            near[v] = near[v] || tree.closest(positions[first + v], reach * reach).face != no_index;
        });
        first += near.size();
    }
    std::uint64_t count = 0;
    for (std::size_t p = 0; p < is_near.size(); ++p) {
        const auto deep = static_cast<std::uint64_t>(std::ranges::count(is_near[p], 0));
        if (deep == 0) continue;
        count += deep;
        weights[p].resize(is_near[p].size(), 1.0f);
        for (std::size_t v = 0; v < is_near[p].size(); ++v)
            if (!is_near[p][v]) weights[p][v] = deep_factor;
    }
    return count;
}

}  // namespace faqem::detail

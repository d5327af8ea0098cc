#pragma once
/// \file
/// The points of a scene that the points of another mesh show.

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "bake/onto/pair_parts.hpp"
#include "bake/parts/corner_normals.hpp"
#include "bake/parts/corners.hpp"
#include "bake/parts/point_map.hpp"
#include "bake/source/source_normals.hpp"
#include "faqem/detail/base/vector.hpp"
#include "faqem/detail/geometry/bvh.hpp"
#include "faqem/detail/mapping/successive_projection.hpp"
#include "faqem/engine/util/run_context.hpp"
#include "scene/material_groups.hpp"
#include "scene/vector_conversion.hpp"

namespace faqem::detail {

inline Vector3 point_on(const TriangleMesh& mesh, Index face, const Vec3& w) {
    Vector3 p = Vector3::Zero();
    for (std::size_t i = 0; i < 3; ++i) p += w[i] * to_eigen(mesh.positions[mesh.triangles[face][i]]);
    return p;
}

/// The shading normal of a mesh without its normal map; zero on a degenerate face.
inline Vector3 normal_at(const BakePart& part, Index face, const Vec3& w) {
    const Vector3 of_face = oriented_face_normal(part, face),
                  normal = unit_or_zero(blended_normal(part, face, w));
    return of_face.isZero(0) || normal.isZero(0) ? of_face : normal;
}

inline void raise(std::atomic<double>& to, double value) {
    double before = to;
    while (before < value && !to.compare_exchange_weak(before, value)) {
    }
}

/// Maps points of a mesh to the closest points of a source that is turned to the same side, except for those of parts
/// that belong to other parts of the mesh.
class OntoMap final : public PointMap {
public:
    /// \param source        its first part, with faces; must outlive this
    /// \param target        the mesh with its normals, in the space of the source; must outlive this
    /// \param pairs         of their parts
    /// \param max_distance  of find()
    OntoMap(const Asset& source, const BakePart& target, FacePairs pairs, double max_distance,
            const engine::RunContext& context)
        : source_(source.parts[0]),
          target_(target),
          pairs_(std::move(pairs)),
          max_distance_squared_(max_distance * max_distance),
          normals_(source_.triangles.size()),
          tree_(source_.positions, source_.triangles, context),
          is_matched_(target.faces()) {
        for (Index f = 0; f < normals_.size(); ++f) {
            Vector3 sum = Vector3::Zero();
            for (std::size_t c = 0; c < 3; ++c) sum += corner_normal(source_, f, c);
            normals_[f] = winding_normal(source_.positions, source_.triangles[f]);
            if (sum.dot(normals_[f]) < 0) normals_[f] = -normals_[f];
            if (!material_or_default(source, face_material(source_, f)).double_sided) continue;
            is_double_sided_.resize(normals_.size(), 0);
            is_double_sided_[f] = 1;
        }
    }

    /// The point of find() or, if there is none, the closest one of all.
    SurfacePoint map(Index face, const Vec3& barycentric) const override {
        const SurfacePoint found = find(face, barycentric, nullptr);
        if (found.face != no_index) return found;
        const Bvh::Hit hit = tree_.closest(to_array(point_on(target_.simplified->mesh, face, barycentric)));
        return {hit.face, hit.barycentric, MapStep::closest};
    }
    SurfacePoint find(Index face, const Vec3& barycentric, const SurfacePoint* near) const override {
        const Vector3 p = point_on(target_.simplified->mesh, face, barycentric),
                      normal = normal_at(target_, face, barycentric);
        Bvh::Hit hit = closest_facing(face, p, normal, false, near);
        if (hit.face == no_index && !is_double_sided_.empty())
            hit = closest_facing(face, p, normal, true, near);
        if (hit.face == no_index) return {};
        is_matched_[face].store(1, std::memory_order_relaxed);
        raise(largest_distance_, std::sqrt(hit.distance_squared));
        return {hit.face, hit.barycentric, MapStep::closest};
    }

    /// Whether find() had a result on a face of the mesh.
    bool is_matched(Index face) const { return is_matched_[face].load(std::memory_order_relaxed) != 0; }
    /// The largest distance of the results of find().
    double largest_distance() const { return largest_distance_; }

private:
    Bvh::Hit closest_facing(Index face, const Vector3& p, const Vector3& normal, bool from_behind,
                            const SurfacePoint* near) const {
        const auto faces_point = [&](Index f) {
            if (!pairs_.show(face, f)) return false;
            if (normal.isZero(0)) return true;
            return from_behind ? is_double_sided_[f] && normals_[f].dot(normal) <= -min_facing_cosine
                               : normals_[f].dot(normal) >= min_facing_cosine;
        };
        Bvh::Hit known;
        if (near && faces_point(near->face)) {
            const auto [a, b, c] = corners_of(source_.positions, source_.triangles[near->face]);
            const ClosestPoint at = closest_point_on_triangle(p, a, b, c);
            if (at.distance_squared <= max_distance_squared_)
                known = {near->face, to_array(at.barycentric), to_array(at.point), at.distance_squared};
        }
        const Bvh::Hit hit = tree_.closest_if(
            to_array(p), [&](const Bvh::Corners& t) { return faces_point(t.face); },
            std::min(max_distance_squared_, known.distance_squared));
        return hit.face != no_index ? hit : known;
    }

    const Part& source_;
    const BakePart& target_;
    const FacePairs pairs_;
    const double max_distance_squared_;
    std::vector<Vector3> normals_;               // by face of the source: oriented by the vertex normals
    std::vector<std::uint8_t> is_double_sided_;  // by face of the source; empty: none is
    Bvh tree_;
    mutable std::vector<std::atomic<std::uint8_t>> is_matched_;  // by face of the mesh
    mutable std::atomic<double> largest_distance_ = 0;
};

}  // namespace faqem::detail

#pragma once
/// \file
/// The points of a scene that the points of another mesh show.

#include <atomic>
#include <cstdint>
#include <vector>

#include "bake/onto/pair_parts.hpp"
#include "bake/parts/corners.hpp"
#include "bake/parts/point_map.hpp"
#include "faqem/detail/base/vector.hpp"
#include "faqem/detail/geometry/bvh.hpp"
#include "faqem/engine/util/run_context.hpp"

namespace faqem::detail {

/// Maps points of a mesh to the closest points of a source that is turned to the same side, except for those of parts
/// that belong to other parts of the mesh.
class OntoMap final : public PointMap {
public:
    /// \param source        its first part, with faces; must outlive this
    /// \param target        the mesh with its normals, in the space of the source; must outlive this
    /// \param pairs         of their parts
    /// \param max_distance  of find()
    OntoMap(const Asset& source, const BakePart& target, FacePairs pairs, double max_distance,
            const engine::RunContext& context);

    /// The point of find() or, if there is none, the closest one of all.
    SurfacePoint map(Index face, const Vec3& barycentric) const override;
    SurfacePoint find(Index face, const Vec3& barycentric, const SurfacePoint* near) const override;

    /// Whether find() had a result on a face of the mesh.
    bool is_matched(Index face) const { return is_matched_[face].load(std::memory_order_relaxed) != 0; }
    /// The largest distance of the results of find().
    double largest_distance() const { return largest_distance_; }

private:
    Bvh::Hit closest_facing(Index face, const Vector3& p, const Vector3& normal, bool from_behind,
                            const SurfacePoint* near) const;

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

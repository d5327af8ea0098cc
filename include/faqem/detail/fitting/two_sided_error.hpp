#pragma once
/// \file
/// Deviation between a moving mesh and a reference surface, measured per face from sample points on both.

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "faqem/detail/fitting/closest_point_tracker.hpp"
#include "faqem/detail/fitting/gauss_newton.hpp"
#include "faqem/detail/geometry/surface_samples.hpp"
#include "faqem/export.hpp"

FAQEM_NAMESPACE_BEGIN
namespace detail {

/// Deviation of one or more faces, over the sample points that belong to them.
struct FaceDeviation {
    double max_squared_distance = 0;  ///< square of the maximum distance
    double squared_distance_sum = 0;  ///< sum of the squared distances
    double normal_deviation = 0;      ///< sum of the distances between corresponding unit normals

    void add(const FaceDeviation& other) {
        max_squared_distance = std::max(max_squared_distance, other.max_squared_distance);
        squared_distance_sum += other.squared_distance_sum;
        normal_deviation += other.normal_deviation;
    }
};

/// Total surface area. O(faces)
double area(const MeshRef& mesh);

/// Sample points on a moving mesh and on a reference surface, with their residuals to the other surface. A
/// point of the reference surface belongs to the face of the mesh that is closest to it.
class TwoSidedError {
public:
    /// \param original   the reference surface, scaled to a bounding box diagonal of 1; must outlive this
    ///                   object
    /// \param triangles  triangles of the mesh; must outlive this object. Edges may be flipped in them later,
    ///                   see resample_flipped().
    /// \param positions  current vertex positions of the mesh
    /// \param context    the results do not depend on the number of threads
    /// \throws whatever `context` throws, here and in the other functions
    TwoSidedError(const ReferenceSurface& original, std::span<const Triangle> triangles,
                  std::span<const engine::Vector3> positions, const RunContext& context);

    /// True if one of the surfaces has no area, so that there is nothing to measure.
    bool empty() const { return from_mesh_.size() == 0 || from_reference_.size() == 0; }

    /// Measures the deviation of each face for the given positions. The longest residuals are found by a
    /// global search and the others are tracked; all are searched if the mesh is much coarser than the
    /// reference surface.
    /// \param positions  current vertex positions of the mesh
    /// \return one entry per triangle
    /// \pre not empty()
    /// O(points log faces) if all residuals are searched
    std::vector<FaceDeviation> measure(std::span<const engine::Vector3> positions);

    /// Same as measure(), for small changes: only the longest residuals are searched.
    std::vector<FaceDeviation> remeasure(std::span<const engine::Vector3> positions);

    /// Updates the residuals that correspondences() returns. Faster than measure(): residuals are tracked
    /// without any search, unless the mesh is much coarser than the reference surface.
    void update_correspondences(std::span<const engine::Vector3> positions);

    /// The correspondences of all points except the vertices of the reference surface. Valid until the next
    /// call of this function.
    std::span<const Correspondence> correspondences();

    /// The correspondences of all points that belong to some faces, including the vertices of the reference
    /// surface.
    /// \param faces  one per triangle; nonzero: include its points
    std::vector<Correspondence> correspondences_at(std::span<const std::uint8_t> faces) const;

    /// Replaces the sample points on triangles that were changed by edge flips.
    /// \param positions  current vertex positions of the mesh
    /// \param flipped    one per triangle; nonzero: its corners have changed since the last call
    void resample_flipped(std::span<const engine::Vector3> positions, std::span<const std::uint8_t> flipped);

    /// Residuals from uniform samples of the reference surface.
    const ReferenceToMeshTracker& from_reference() const { return from_reference_; }
    /// Residuals from the vertices of the reference surface.
    const ReferenceToMeshTracker& from_reference_vertices() const { return from_reference_vertices_; }

private:
    template <class Visit>
    void for_each_tracker(Visit&& visit);
    template <class Visit>
    void for_each_tracker_in_parallel(Visit&& visit);
    std::vector<FaceDeviation> deviations();
    std::size_t point_count() const;
    std::vector<OrientedPoint> even_points() const;

    const ReferenceSurface& original_;
    std::span<const Triangle> triangles_;
    const engine::RunContext& context_;
    std::size_t faces_;                 // number of faces of the mesh
    bool is_coarse_;                    // the mesh is much coarser than the reference surface
    MeshToReferenceTracker from_mesh_;  // from uniform samples
    std::optional<MeshToReferenceTracker> from_mesh_corners_;  // from vertices and edge midpoints
    ReferenceToMeshTracker from_reference_;                    // from uniform samples
    ReferenceToMeshTracker from_reference_vertices_;           // from vertices, for the maximum distance
    std::vector<Correspondence> correspondences_;
};

}  // namespace detail
FAQEM_NAMESPACE_END

#ifdef FAQEM_HEADER_ONLY
#include "faqem/detail/fitting/two_sided_error-inl.hpp"
#endif

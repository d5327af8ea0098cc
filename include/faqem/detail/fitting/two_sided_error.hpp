#pragma once
/// \file
/// How well the faces of a mesh that moves fit a surface that stays, measured from points on both.

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

/// How well faces fit.
struct FaceDeviation {
    double max_squared_distance = 0;  ///< largest squared distance of their points
    double squared_distance_sum = 0;  ///< sum of these squared distances
    double normal_deviation = 0;      ///< sum of the distances between the unit normals on either side

    void add(const FaceDeviation& other) {
        max_squared_distance = std::max(max_squared_distance, other.max_squared_distance);
        squared_distance_sum += other.squared_distance_sum;
        normal_deviation += other.normal_deviation;
    }
};

/// Sum of all areas.
double area(const MeshRef& mesh);

/// Points on both surfaces, each with its residual to the other one. Refers to its arguments.
class TwoSidedError {
public:
    /// \param original   a surface of diagonal 1
    /// \param triangles  of the mesh; two of them may be flipped later
    /// \param positions  of the mesh, where it is now
    /// \param workers    no result depends on how many
    TwoSidedError(const ReferenceSurface& original, std::span<const Triangle> triangles,
                  std::span<const engine::Vector3> positions, Workers workers);

    /// Is there nothing to measure?
    bool empty() const { return from_mesh_.size() == 0 || from_reference_.size() == 0; }

    /// Finds how well each face fits where the vertices are now. The longest gaps are searched for, the
    /// others followed; all are searched for where the mesh has few faces beside the surface.
    /// \pre not empty()
    std::vector<FaceDeviation> measure(std::span<const engine::Vector3> positions);

    /// As measure(), for a mesh of which little has moved: only the longest gaps are searched for.
    std::vector<FaceDeviation> remeasure(std::span<const engine::Vector3> positions);

    /// As measure() finds what correspondences() needs, but searches not even for the longest gaps where it follows.
    void update_correspondences(std::span<const engine::Vector3> positions);

    /// The gaps of all points but the original's vertices. Valid until the next call.
    std::span<const Correspondence> correspondences();

    /// All gaps at some faces. \param faces  of each triangle: nonzero counts
    std::vector<Correspondence> correspondences_at(std::span<const std::uint8_t> faces) const;

    /// Takes new points where triangles have been flipped.
    /// \param flipped  of each triangle: nonzero has other corners than the last time
    void resample_flipped(std::span<const engine::Vector3> positions, std::span<const std::uint8_t> flipped);

    /// From points spread over the original, and from its vertices.
    const ReferenceToMeshTracker& from_reference() const { return from_reference_; }
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
    Workers workers_;
    std::size_t faces_;  // of the mesh
    bool is_coarse_;
    MeshToReferenceTracker from_mesh_;                         // from points spread by area
    std::optional<MeshToReferenceTracker> from_mesh_corners_;  // from corners and middles of edges
    ReferenceToMeshTracker
        from_reference_;  // from points spread by area: they pull, and say how well the faces fit
    ReferenceToMeshTracker from_reference_vertices_;  // from the vertices: among them are the farthest points
    std::vector<Correspondence> correspondences_;
};

}  // namespace detail
FAQEM_NAMESPACE_END

#ifdef FAQEM_HEADER_ONLY
#include "faqem/detail/fitting/two_sided_error-inl.hpp"
#endif

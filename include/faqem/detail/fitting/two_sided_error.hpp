#pragma once
/// \file
/// How well the faces of a mesh that moves fit a surface that stays, measured from points on both.

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "faqem/export.hpp"
#include "faqem/detail/fitting/gauss_newton.hpp"
#include "faqem/detail/fitting/closest_point_tracker.hpp"
#include "faqem/detail/geometry/surface_samples.hpp"

FAQEM_NAMESPACE_BEGIN
namespace detail {

/// How well faces fit.
struct Fit {
    double farthest = 0;  ///< largest squared distance of their points
    double distance = 0;  ///< sum of these squared distances
    double turn = 0;      ///< sum of the distances between the unit normals on either side

    void add(const Fit& other) {
        farthest = std::max(farthest, other.farthest);
        distance += other.distance;
        turn += other.turn;
    }
};

/// Sum of all areas.
double area(const Patchwork& mesh);

/// Points on both surfaces, each with its gap to the other one. Refers to its arguments.
class TwoSidedGaps {
public:
    /// \param original   a surface of diagonal 1
    /// \param triangles  of the mesh; two of them may be swapped later
    /// \param positions  of the mesh, where it is now
    /// \param workers    no result depends on how many
    TwoSidedGaps(const StillSurface& original, std::span<const Triangle> triangles,
                 std::span<const engine::Vector3> positions, Workers workers);

    /// Is there nothing to measure?
    bool empty() const { return there_.size() == 0 || back_.size() == 0; }

    /// Finds how well each face fits where the vertices are now. The longest gaps are searched for, the
    /// others followed; all are searched for where the mesh has few faces beside the surface.
    /// \pre not empty()
    std::vector<Fit> measure(std::span<const engine::Vector3> positions);

    /// As measure(), for a mesh of which little has moved: only the longest gaps are searched for.
    std::vector<Fit> measure_again(std::span<const engine::Vector3> positions);

    /// As measure() finds what pulls() needs, but searches not even for the longest gaps where it follows.
    void measure_pulls(std::span<const engine::Vector3> positions);

    /// The gaps of all points but the original's vertices. Valid until the next call.
    std::span<const Pull> pulls();

    /// All gaps at some faces. \param faces  of each triangle: nonzero counts
    std::vector<Pull> pulls_at(std::span<const std::uint8_t> faces) const;

    /// Takes new points where triangles have been swapped.
    /// \param swapped  of each triangle: nonzero has other corners than the last time
    void swap(std::span<const engine::Vector3> positions, std::span<const std::uint8_t> swapped);

    /// From points spread over the original, and from its vertices.
    const GapsBack& back() const { return back_; }
    const GapsBack& corners() const { return corners_; }

private:
    template <class Visit>
    void for_each_kind(Visit&& visit);
    template <class Visit>
    void side_by_side(Visit&& visit);
    std::vector<Fit> fits();
    std::size_t point_count() const;
    std::vector<OrientedPoint> even_points() const;

    const StillSurface& original_;
    std::span<const Triangle> triangles_;
    Workers workers_;
    std::size_t faces_;  // of the mesh
    bool is_coarse_;
    GapsThere there_;                // from points spread by area
    std::optional<GapsThere> ends_;  // from corners and middles of edges
    GapsBack back_;                  // from points spread by area: they pull, and say how well the faces fit
    GapsBack corners_;               // from the vertices: among them are the farthest points
    std::vector<Pull> pulls_;
};

}  // namespace detail
FAQEM_NAMESPACE_END

#ifdef FAQEM_HEADER_ONLY
#include "faqem/detail/fitting/two_sided_error-inl.hpp"
#endif

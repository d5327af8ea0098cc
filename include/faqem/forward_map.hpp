#pragma once
/// \file
/// The map from the original to the simplified mesh, for vertices and for surface points. SurfaceMap is the
/// opposite direction.

#include <memory>
#include <vector>

#include "faqem/export.hpp"
#include "faqem/history.hpp"

FAQEM_NAMESPACE_BEGIN

/// A point on the simplified mesh.
struct SimplifiedPoint {
    Index face = no_index;  ///< face of the simplified mesh; no_index: there is no corresponding point
    Vec3 barycentric = {};  ///< weights of the three corners, >= 0, sum 1
};

/// Returns the simplified vertex that each original vertex was collapsed into. The opposite direction, with
/// one original vertex per simplified vertex, is SimplifyResult::vertex_origin.
/// \pre validate(history) passes
/// \return one entry per vertex of CollapseHistory::positions, that is, of the original after welding;
///         no_index if no face is left at that vertex
/// Complexity: O(size of the history).
FAQEM_EXPORT std::vector<Index> vertex_map(const CollapseHistory& history);

/// Maps points of the original to the simplified mesh. Immutable after construction; map() may be called from
/// several threads concurrently.
///
/// The search starts with the faces around the vertices that the corners of the original face were collapsed
/// into, and continues to adjacent faces while the distance decreases. It therefore does not reach surface
/// that is close in space but far along the surface, such as the opposite side of a thin wall. Near the rim
/// of a wall both sides are reached; there, faces whose normals deviate by more than 120 degrees from that of
/// the original face are used only if there are no others.
class FAQEM_EXPORT ForwardMap {
public:
    /// Prepares the map.
    /// \param history  history of the run; not copied, must outlive the map
    /// \pre validate(history) passes
    /// Complexity: O(size of the history) time and memory.
    explicit ForwardMap(const CollapseHistory& history);
    ~ForwardMap();
    ForwardMap(ForwardMap&&) noexcept;
    ForwardMap& operator=(ForwardMap&&) noexcept;

    /// Maps one point. If several faces are equally close, the one of least index is the result.
    /// \param face         face of the input, < history.triangles.size()
    /// \param barycentric  weights of its three corners, >= 0, sum 1
    /// \return the point on the simplified mesh; SimplifiedPoint::face is no_index if the face was dropped
    ///         before the run (two equal corners after welding, or a duplicate), or if its component was
    ///         deleted
    /// Complexity: linear in the number of faces visited, about twenty on a smooth surface.
    SimplifiedPoint map(Index face, const Vec3& barycentric) const;

private:
    struct Impl;
    std::unique_ptr<const Impl> impl_;
};

FAQEM_NAMESPACE_END

#ifdef FAQEM_HEADER_ONLY
#include "faqem/detail/mapping/forward_map-inl.hpp"
#endif

#pragma once
/// \file
/// The map from the original to the small mesh: where vertices and points of the input went. SurfaceMap is
/// the way back.

#include <memory>
#include <vector>

#include "faqem/export.hpp"
#include "faqem/history.hpp"

FAQEM_NAMESPACE_BEGIN

/// A place on the small mesh.
struct SimplifiedPoint {
    Index face = no_index;  ///< face of the small mesh; no_index: nothing is left of that part
    Vec3 barycentric = {};  ///< weights of its three corners, >= 0, sum 1
};

/// Per vertex of the original as `history` has them (after welding): the vertex of the small mesh that it was
/// collapsed into, in the end, or no_index where no face is left there. SimplifyResult::vertex_origin is the
/// way back, with one answer per vertex. O(size of the history)
/// \pre validate(history) passes
FAQEM_EXPORT std::vector<Index> vertex_map(const CollapseHistory& history);

/// Answers "where on the small mesh is this point of the original?". Immutable once built; map() may be
/// called from several threads at once.
///
/// A point is looked for around the vertices that the corners of its face were collapsed into, and from there
/// on as long as the distance falls from face to neighbouring face: what lies near in space, and far on the
/// surface (the other side of a thin wall), is not looked at. Near the rim of such a wall, both sides are:
/// there faces that look the other way, by more than 120 degrees, are taken only where there are no others.
class FAQEM_EXPORT ForwardMap {
public:
    /// \param history  of the run that made the small mesh; must outlive the map
    /// \pre validate(history) passes
    /// O(size of the history) time and memory
    explicit ForwardMap(const CollapseHistory& history);
    ~ForwardMap();
    ForwardMap(ForwardMap&&) noexcept;
    ForwardMap& operator=(ForwardMap&&) noexcept;

    /// \param face         face of the input, < history.triangles.size()
    /// \param barycentric  the point on it
    /// \return a place on the small mesh; SimplifiedPoint::face is no_index where the face was dropped before the
    ///         run (two equal corners, or a double), or where nothing is left of what it was part of.
    /// O(faces looked at): some twenty where the surface is smooth
    SimplifiedPoint map(Index face, const Vec3& barycentric) const;

private:
    struct Impl;
    std::unique_ptr<const Impl> impl_;
};

FAQEM_NAMESPACE_END

#ifdef FAQEM_HEADER_ONLY
#include "faqem/detail/mapping/forward_map-inl.hpp"
#endif

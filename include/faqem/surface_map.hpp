#pragma once
/// \file
/// The map from the small surface to the original, read from the collapse history alone.

#include <memory>
#include <span>

#include "faqem/export.hpp"
#include "faqem/history.hpp"
#include "faqem/options.hpp"

FAQEM_NAMESPACE_BEGIN

class SurfaceMap;

namespace detail {
struct Workers;

/// A map that several threads make; the calling one polls. \throws what the poll throws
FAQEM_EXPORT SurfaceMap make_surface_map(const CollapseHistory& history, Mapping mapping,
                                         std::span<const Triangle> unwelded, const Workers& workers);
}  // namespace detail

/// How a sample found its place.
enum class MapStep {
    history,      ///< the walk through the history, every test passed
    approximate,  ///< the walk, with the sheet or side test dropped somewhere
    /// The walk ended on a wrong face: closest one among those that collapsed into the small face. Of
    /// Mapping::closest: always.
    closest,
};

/// A place on the original surface.
struct SurfacePoint {
    Index face = no_index;  ///< input face
    Vec3 barycentric = {};  ///< weights of its three corners, >= 0, sum 1
    MapStep step = MapStep::history;
};

/// Answers "where on the original is this point of the small mesh?". Immutable once built; map() may be
/// called from several threads at once.
class FAQEM_EXPORT SurfaceMap {
public:
    /// \param history  of the run that made the small mesh; must outlive the map
    /// \param mapping  how places are found
    /// \param unwelded  empty, or the faces of the original as they were before vertices at one place were
    ///                  joined, one per face of the history: surfaces that touch, and share vertices only
    ///                  since then, are told apart by it (projection). Not kept.
    /// O(size of the history) memory; time as well, and O(n log n) for n faces of the original, on all threads
    /// there are.
    SurfaceMap(const CollapseHistory& history, Mapping mapping, std::span<const Triangle> unwelded = {});
    ~SurfaceMap();
    SurfaceMap(SurfaceMap&&) noexcept;
    SurfaceMap& operator=(SurfaceMap&&) noexcept;

    /// \param face         face of the small mesh, < history.kept_faces.size()
    /// \param barycentric  the point on it
    /// \return a face of the original and barycentrics on it; never no_index
    SurfacePoint map(Index face, const Vec3& barycentric) const;

    /// As map(), but faster for many points close together: `near` bounds the search instead of a walk. The
    /// same answer, except where only the walk would find a face that is closer still.
    /// \param near  answer for a nearby point of the same small face
    SurfacePoint map_near(Index face, const Vec3& barycentric, const SurfacePoint& near) const;

private:
    struct Impl;
    explicit SurfaceMap(std::unique_ptr<const Impl> impl);
    friend SurfaceMap detail::make_surface_map(const CollapseHistory& history, Mapping mapping,
                                               std::span<const Triangle> unwelded,
                                               const detail::Workers& workers);

    std::unique_ptr<const Impl> impl_;
};

FAQEM_NAMESPACE_END

#ifdef FAQEM_HEADER_ONLY
#include "faqem/detail/mapping/surface_map-inl.hpp"
#endif

#pragma once
/// \file
/// The map from the simplified mesh to the original, computed from the collapse history alone.

#include <memory>
#include <span>

#include "faqem/export.hpp"
#include "faqem/history.hpp"

FAQEM_NAMESPACE_BEGIN

class SurfaceMap;

namespace engine {
class RunContext;
}
namespace detail {
class LocalMap;

/// Constructs a SurfaceMap on several threads; the calling thread checks for cancellation.
/// \throws whatever `context` throws
FAQEM_EXPORT SurfaceMap make_surface_map(const CollapseHistory& history, std::span<const Triangle> unwelded,
                                         const engine::RunContext& context);
}  // namespace detail

/// How a point was mapped; see docs/baking.md for the tests.
enum class MapStep {
    /// By the walk through the history with all tests passed, or a face that the walk could not change.
    history,
    approximate,  ///< by the walk, which took a face of the wrong side or of another surface patch
    /// The walk was abandoned or ended on a wrong face, and the closest face that passes the tests was taken.
    closest,
};

/// A point on the original surface.
struct SurfacePoint {
    Index face = no_index;  ///< input face
    Vec3 barycentric = {};  ///< weights of the three corners, >= 0, sum 1
    MapStep step = MapStep::history;
};

/// Maps points of the simplified mesh to the original. Immutable after construction; map() and map_near() may
/// be called from several threads concurrently.
class FAQEM_EXPORT SurfaceMap {
public:
    /// Prepares the map, on all threads of the machine.
    /// \param history   history of the run; not copied, must outlive the map
    /// \param unwelded  empty, or the triangles of the original before welding, one per face of the history.
    ///                  With them surfaces that touch, but share vertices only because of welding, are
    ///                  distinguished. Not used after the call
    /// \pre validate(history) passes
    /// Complexity: O(n log n) time in the faces of the original plus the size of the history, O(size of the
    /// history) memory.
    explicit SurfaceMap(const CollapseHistory& history, std::span<const Triangle> unwelded = {});
    ~SurfaceMap();
    SurfaceMap(SurfaceMap&&) noexcept;
    SurfaceMap& operator=(SurfaceMap&&) noexcept;

    /// Maps one point.
    /// \param face         face of the simplified mesh, < history.remaining_faces.size()
    /// \param barycentric  weights of its three corners, >= 0, sum 1
    /// \return a point on the original; its face is never no_index
    /// Complexity: O(log n) typically.
    SurfacePoint map(Index face, const Vec3& barycentric) const;

    /// As map(), but faster for many adjacent points: `near` bounds the search, and the walk is usually not
    /// needed. The result is the same, unless only the walk would find a closer face.
    /// \param near  result for a nearby point of the same simplified face
    SurfacePoint map_near(Index face, const Vec3& barycentric, const SurfacePoint& near) const;

private:
    struct Impl;
    explicit SurfaceMap(std::unique_ptr<const Impl> impl);
    friend SurfaceMap detail::make_surface_map(const CollapseHistory& history,
                                               std::span<const Triangle> unwelded,
                                               const engine::RunContext& context);
    friend class detail::LocalMap;

    std::unique_ptr<const Impl> impl_;
};

FAQEM_NAMESPACE_END

#ifdef FAQEM_HEADER_ONLY
#include "faqem/detail/mapping/surface_map-inl.hpp"
#endif

#pragma once
/// \file
/// The map from the simplified mesh to the original for many points close to each other.

#include <optional>

#include "faqem/detail/geometry/near_triangles.hpp"
#include "faqem/detail/mapping/successive_projection.hpp"
#include "faqem/export.hpp"
#include "faqem/surface_map.hpp"

FAQEM_DETAIL_BEGIN

/// Finds the original faces near a small region of one simplified face once, so that the points of the region need no
/// search of their own.
class FAQEM_EXPORT LocalMap {
public:
    /// Prepares the map for a ball.
    /// \param map          map of the whole mesh
    /// \param face         face of the simplified mesh
    /// \param barycentric  weights of its three corners at the centre of the ball; may be negative, sum 1
    /// \param radius       of the ball, in model units; for points outside it nothing is gained
    /// \param near         result of `map` for a nearby point of the same face
    void prepare(const SurfaceMap& map, Index face, const Vec3& barycentric, double radius,
                 const SurfacePoint& near);

    /// Prepares the map for a smaller ball within one for which another map of the same face is prepared. This takes
    /// less time than prepare().
    /// \param map          as for prepare()
    /// \param face         likewise
    /// \param barycentric  likewise
    /// \param radius       likewise
    /// \param larger       prepared with the same map and face
    /// \return whether that was possible; otherwise this map is not prepared
    bool prepare_from(const SurfaceMap& map, Index face, const Vec3& barycentric, double radius,
                      const LocalMap& larger);

    /// Number of faces that are searched for each point; 0: all, since the map is not prepared.
    std::size_t size() const { return faces_.size(); }

    /// Same as SurfaceMap::map_near().
    /// \param map   as in the last call of prepare(), if any
    /// \param face  likewise
    SurfacePoint map_near(const SurfaceMap& map, Index face, const Vec3& barycentric,
                          const SurfacePoint& near);

    /// The result of map_near(), up to rounding, where the point certainly has the face of the last one.
    /// \param map          as in the last call of prepare(), if any
    /// \param face         likewise
    /// \param barycentric  as for map_near()
    /// \param step         of the last result
    /// \return nothing where map_near() has to search
    std::optional<SurfacePoint> map_to_same(const SurfaceMap& map, Index face, const Vec3& barycentric,
                                            MapStep step);

private:
    void clear() { faces_.clear(), recent_ = {}; }

    NearTriangles faces_;
    SuccessiveProjection::Recent recent_;
};

FAQEM_DETAIL_END

#ifdef FAQEM_HEADER_ONLY
#include "faqem/detail/mapping/local_map-inl.hpp"
#endif

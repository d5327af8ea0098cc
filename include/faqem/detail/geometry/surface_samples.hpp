#pragma once
/// \file
/// Points on meshes where distances are worth measuring.

#include <cstddef>
#include <span>
#include <vector>

#include "faqem/engine/mesh/vector.hpp"
#include "faqem/engine/util/cancellation.hpp"
#include "faqem/export.hpp"
#include "faqem/mesh.hpp"

FAQEM_NAMESPACE_BEGIN
namespace detail {

/// Positions and the triangles that refer to them; a triangle with no_index corners is none. Borrowed.
struct MeshRef {
    std::span<const engine::Vector3> positions;
    std::span<const Triangle> triangles;
};

/// Twice the area of a triangle, along its normal.
inline engine::Vector3 area_vector(std::span<const engine::Vector3> positions, const Triangle& t) {
    return engine::area_vector(positions[t[0]], positions[t[1]], positions[t[2]]);
}

/// Unit normal of each triangle; zero where it has no area, or is none.
std::vector<engine::Vector3> unit_normals(const MeshRef& mesh,
                                          engine::CancellationCheck check_cancelled = {});

/// A point of a face.
struct SurfaceSample {
    Index face = no_index;
    Vec3 barycentric = {};  ///< barycentric

    engine::Vector3 position(std::span<const engine::Vector3> positions,
                             std::span<const Triangle> triangles) const {
        const Triangle& t = triangles[face];
        return barycentric[0] * positions[t[0]] + barycentric[1] * positions[t[1]] +
               barycentric[2] * positions[t[2]];
    }
};

/// A point of a surface and the unit normal there.
struct OrientedPoint {
    engine::Vector3 position, normal;
};

/// `count` points spread by area, in the order of the faces; none where there is no area.
/// Source: Roberts 2018, the sequence of the plastic number. O(faces + count)
std::vector<SurfaceSample> area_uniform_samples(const MeshRef& mesh, std::size_t count,
                                                engine::CancellationCheck check_cancelled = {});

/// The corners of faces, each vertex once, and the middles of their edges, once for each face: where a simplified
/// mesh sticks out. O(faces)
std::vector<SurfaceSample> vertex_and_midpoint_samples(std::span<const Triangle> triangles,
                                                       engine::CancellationCheck check_cancelled = {});

/// The vertices of faces, with the mean normal of the faces around each by area; zero where it has none.
/// O(faces)
std::vector<OrientedPoint> oriented_vertices(const MeshRef& mesh,
                                             engine::CancellationCheck check_cancelled = {});

}  // namespace detail
FAQEM_NAMESPACE_END

#ifdef FAQEM_HEADER_ONLY
#include "faqem/detail/geometry/surface_samples-inl.hpp"
#endif

#pragma once
/// \file
/// Points on meshes where distances are worth measuring.

#include <cstddef>
#include <span>
#include <vector>

#include "faqem/export.hpp"
#include "faqem/engine/util/cancellation.hpp"
#include "faqem/engine/mesh/vector.hpp"
#include "faqem/mesh.hpp"

FAQEM_NAMESPACE_BEGIN
namespace detail {

/// Positions and the triangles that refer to them; a triangle with no_index corners is none. Borrowed.
struct Patchwork {
    std::span<const engine::Vector3> positions;
    std::span<const Triangle> triangles;
};

/// Twice the area of a triangle, along its normal.
inline engine::Vector3 area_vector(std::span<const engine::Vector3> positions, const Triangle& t) {
    return engine::area_vector(positions[t[0]], positions[t[1]], positions[t[2]]);
}

/// Unit normal of each triangle; zero where it has no area, or is none.
std::vector<engine::Vector3> unit_normals(const Patchwork& mesh, engine::Poll poll = {});

/// A point of a face.
struct Spot {
    Index face = no_index;
    Vec3 weight = {};  ///< barycentric

    engine::Vector3 on(std::span<const engine::Vector3> positions,
                       std::span<const Triangle> triangles) const {
        const Triangle& t = triangles[face];
        return weight[0] * positions[t[0]] + weight[1] * positions[t[1]] + weight[2] * positions[t[2]];
    }
};

/// A point of a surface and the unit normal there.
struct OrientedPoint {
    engine::Vector3 position, normal;
};

/// `count` points spread by area, in the order of the faces; none where there is no area.
/// Source: Roberts 2018, the sequence of the plastic number. O(faces + count)
std::vector<Spot> evenly_spread(const Patchwork& mesh, std::size_t count, engine::Poll poll = {});

/// The corners of faces, each vertex once, and the middles of their edges, once for each face: where a light
/// mesh sticks out. O(faces)
std::vector<Spot> corners_and_middles(std::span<const Triangle> triangles, engine::Poll poll = {});

/// The vertices of faces, with the mean normal of the faces around each by area; zero where it has none.
/// O(faces)
std::vector<OrientedPoint> oriented_vertices(const Patchwork& mesh, engine::Poll poll = {});

}  // namespace detail
FAQEM_NAMESPACE_END

#ifdef FAQEM_HEADER_ONLY
#include "faqem/detail/geometry/surface_samples-inl.hpp"
#endif

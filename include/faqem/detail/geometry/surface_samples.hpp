#pragma once
/// \file
/// Deterministic sample points of a mesh for distance measurements.

#include <cstddef>
#include <span>
#include <vector>

#include "faqem/detail/base/vector.hpp"
#include "faqem/export.hpp"
#include "faqem/mesh.hpp"

FAQEM_DETAIL_BEGIN

/// Non-owning view of a mesh: positions, and triangles that index them. Triangles with no_index corners are
/// ignored.
struct MeshRef {
    std::span<const Vector3> positions;
    std::span<const Triangle> triangles;
};

/// Vector along the normal of a triangle whose length is twice the area.
inline Vector3 area_vector(std::span<const Vector3> positions, const Triangle& t) {
    return engine::area_vector(positions[t[0]], positions[t[1]], positions[t[2]]);
}

/// Total surface area. O(faces)
inline double area(const MeshRef& mesh) {
    double twice = 0;
    for (const Triangle& t : mesh.triangles)
        if (t[0] != no_index) twice += area_vector(mesh.positions, t).norm();
    return twice / 2;
}

/// Unit normal of each triangle; zero if it has no area or no_index corners.
/// O(faces)
std::vector<Vector3> unit_normals(const MeshRef& mesh);

/// A point of a face, in barycentric coordinates.
struct SurfaceSample {
    Index face = no_index;
    Vec3 barycentric = {};  ///< >= 0, sum 1

    /// Position of the point for the given vertex positions.
    Vector3 position(std::span<const Vector3> positions, std::span<const Triangle> triangles) const {
        const Triangle& t = triangles[face];
        return barycentric[0] * positions[t[0]] + barycentric[1] * positions[t[1]] +
               barycentric[2] * positions[t[2]];
    }
};

/// A point of a surface and the unit normal at it.
struct OrientedPoint {
    Vector3 position, normal;
};

/// Distributes points uniformly by area, using a low-discrepancy sequence.
/// \param count  number of points
/// \return `count` points, sorted by face; none if the mesh has no area
/// O(faces + count). Source: Roberts 2018, R2 sequence (based on the plastic number)
std::vector<SurfaceSample> area_uniform_samples(const MeshRef& mesh, std::size_t count);

/// The referenced vertices, each once, and the midpoints of the edges, once per face. A simplified mesh
/// typically deviates most from the original at these points.
/// \param triangles  triangles with no_index corners are ignored
/// O(faces)
std::vector<SurfaceSample> vertex_and_midpoint_samples(std::span<const Triangle> triangles);

/// The referenced vertices, each with the area-weighted mean of the normals of its faces, normalized; zero if
/// the mean is zero.
/// O(vertices + faces)
std::vector<OrientedPoint> oriented_vertices(const MeshRef& mesh);

FAQEM_DETAIL_END

#ifdef FAQEM_HEADER_ONLY
#include "faqem/detail/geometry/surface_samples-inl.hpp"
#endif

#pragma once
/// \file
/// MikkTSpace tangents (Mikkelsen, "Simulation of Wrinkled Surfaces Revisited", 2008), as glTF specifies.
/// Independent implementation of the published algorithm.

#include <span>
#include <vector>

#include "faqem/mesh.hpp"

namespace faqem::detail {

/// A corner of a triangle. v points down, as in glTF.
struct TangentCorner {
    Vec3f position, normal;  ///< the normal has unit length
    Vec2f uv;
};

/// Computes the tangents of triangles: unit vectors, with the sign of the bitangent, cross(normal, tangent) *
/// w, as in glTF.
///
/// Corners with equal position, normal and UV are one vertex. Around a vertex, triangles that are connected
/// over shared edges and have the same UV orientation share a tangent: the mean of their tangents, weighted
/// by the angles at the vertex. Triangles without area in the UVs join the group of a neighbour. Corners of
/// which no triangle has a tangent get an arbitrary direction perpendicular to the normal, and w = 1.
///
/// Unlike in the reference implementation, two triangles whose tangents are exactly opposite can share a
/// tangent. This bounds the work around high-valence vertices.
/// \param corners  three per triangle, finite
/// \return one tangent per corner
/// Complexity: O(n log n).
std::vector<Vec4f> mikk_tangents(std::span<const TangentCorner> corners);

/// Sets the tangents of some faces of a mesh to mikk_tangents() of these faces.
/// \param corner    corner(face, 0 to 2) is the TangentCorner
/// \param tangents  three per face of the mesh
template <class Corner>
void set_mikk_tangents(std::span<const Index> faces, const Corner& corner, std::vector<Vec4f>& tangents) {
    std::vector<TangentCorner> corners;
    corners.reserve(3 * faces.size());
    for (const Index f : faces)
        for (std::size_t i = 0; i < 3; ++i) corners.push_back(corner(f, i));
    const std::vector<Vec4f> made = mikk_tangents(corners);
    for (std::size_t i = 0; i < made.size(); ++i) tangents[std::size_t{3} * faces[i / 3] + i % 3] = made[i];
}

}  // namespace faqem::detail

#pragma once
/// \file
/// Values and shading normals at points of the source, without textures, and tangent frames.

#include <vector>

#include "asset/scene/part_arrays.hpp"
#include "faqem/asset.hpp"
#include "faqem/detail/base/vector.hpp"
#include "faqem/surface_map.hpp"

namespace faqem::detail {

/// Axes of a tangent space: unit vectors, in general not orthogonal.
struct TangentFrame {
    Vector3 tangent, bitangent, normal;

    /// Transforms a vector from tangent space to the space of the mesh.
    Vector3 to_mesh(const Vector3& v) const { return v.x() * tangent + v.y() * bitangent + v.z() * normal; }
    /// Inverse of to_mesh(). Returns (0, 0, 1), the normal, if the axes are linearly dependent.
    Vector3 from_mesh(const Vector3& v) const;
};

/// Normal and tangent at a corner.
struct FrameCorner {
    Vector3 normal;
    Vec4f tangent;  ///< xyz: unit vector, w: sign of the bitangent
};

/// The frame at a point of a triangle: the axes of the corners, interpolated and normalized, as viewers do.
/// \param weights  barycentric coordinates of the point
TangentFrame blend_frames(const std::array<FrameCorner, 3>& corners, const Vec3& weights);

/// Unit normal of a face by its winding; zero if it is degenerate.
Vector3 winding_normal(const std::vector<Vec3>& positions, const Triangle& t);

/// Unit normal of a part at a point: interpolated from its vertices or, if they have none, that of the face.
/// Zero if there is neither.
Vector3 interpolated_normal(const Part& part, const SurfacePoint& point);

/// Unit normal of a part at a corner of a face, as interpolated_normal().
Vector3 corner_normal(const Part& part, std::size_t face, std::size_t corner);

/// Tangents at the corners of all faces whose material has a normal map, in the part's coordinates. Faces
/// whose corners all have tangents in the source keep them; the other ones get MikkTSpace tangents from the
/// texture coordinates after the texture transform.
/// \return by corner; empty if no face has such a material
/// Complexity: O(n log n).
std::vector<Vec4f> source_tangents(const Asset& asset, const Part& part);

}  // namespace faqem::detail

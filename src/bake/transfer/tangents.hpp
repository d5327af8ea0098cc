#pragma once
/// \file
/// Tangents as MikkTSpace defines them (Mikkelsen, "Simulation of Wrinkled Surfaces Revisited", 2008), which
/// glTF asks for. Own code after the published algorithm.

#include <span>
#include <vector>

#include "faqem/engine/util/cancellation.hpp"
#include "faqem/mesh.hpp"

namespace faqem::detail {

/// A corner of a triangle as a file has it. v points down, as in glTF.
struct TangentCorner {
    Vec3f position, normal;  ///< the normal has unit length
    Vec2f uv;
};

/// Tangents of triangles: unit length, with the sign of the bitangent, cross(normal, tangent) * w, as in
/// glTF.
///
/// Corners that agree in position, normal and UV are one vertex. Around a vertex those triangles share a
/// tangent that hang together over common edges and are not mirrored against each other; it is the mean of
/// theirs, weighted by the angles at the vertex. Triangles without area in the UVs join whom they touch;
/// corners at which nothing has a tangent get some direction across the normal, and w = 1.
///
/// Unlike the reference, two triangles whose tangents are exactly opposite share one nevertheless: it keeps
/// the work bounded around vertices with very many triangles.
/// \param corners  three per triangle, finite
/// \return one per corner.
/// \throws what the poll throws.
/// O(n log n)
std::vector<Vec4f> mikk_tangents(std::span<const TangentCorner> corners,
                                 engine::CancellationCheck check_cancelled = {});

}  // namespace faqem::detail

#pragma once
/// \file
/// The original's shading normals without its textures, and frames to put normal maps in.

#include <vector>

#include "bake/transfer/texture_sampling.hpp"
#include "faqem/asset.hpp"
#include "faqem/engine/mesh/vector.hpp"
#include "faqem/surface_map.hpp"

namespace faqem::detail {

/// Axes of a tangent space: unit vectors, not quite at right angles in general.
struct TangentFrame {
    engine::Vector3 tangent, bitangent, normal;

    /// A vector of tangent space in the space of the mesh.
    engine::Vector3 to_mesh(const engine::Vector3& v) const {
        return v.x() * tangent + v.y() * bitangent + v.z() * normal;
    }
    /// The inverse; the normal, (0, 0, 1), where the axes do not span space.
    engine::Vector3 from_mesh(const engine::Vector3& v) const;
};

/// A normal and its tangent at a corner.
struct FrameCorner {
    engine::Vector3 normal;
    Vec4f tangent;  ///< xyz unit, w the sign of the bitangent
};

/// The frame within a triangle: the corners' axes interpolated and made unit, as viewers do it.
TangentFrame blend_frames(const std::array<FrameCorner, 3>& corners, const Vec3& weights);

/// The face's normal by its winding; zero where it has no area.
engine::Vector3 winding_normal(const std::vector<Vec3>& positions, const Triangle& t);

/// The part's normal at a point: interpolated, the face's where there is none. Zero where there is neither.
engine::Vector3 interpolated_normal(const Part& part, const SurfacePoint& point);

/// The part's normal at a corner of a face, as interpolated_normal().
engine::Vector3 corner_normal(const Part& part, std::size_t face, std::size_t corner);

/// Tangents of the corners of all faces whose material has a normal map, in Part's own coordinates: those of
/// the file where it has them for all corners of a face, else MikkTSpace's, from the texture coordinates with
/// the texture's transform. Empty where no face has such a material. O(n log n)
std::vector<Vec4f> source_tangents(const Asset& asset, const Part& part,
                                   engine::CancellationCheck check_cancelled = {});

}  // namespace faqem::detail

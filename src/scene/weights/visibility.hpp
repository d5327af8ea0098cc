#pragma once
/// \file
/// Visibility of the surface of a scene from outside.

#include <cstdint>
#include <string>
#include <vector>

#include "faqem/asset.hpp"
#include "faqem/detail/base/parallel.hpp"

namespace faqem::detail {

/// Sides of a face that occlude what is behind it.
enum class OccludingSides { none, front, both };

/// The sides on which faces of a material occlude; no_index: the default material.
OccludingSides occluding_sides(const Asset& scene, Index material);

/// Smallest value for MeshView::vertex_weights. It is not 0, since hidden surface may become visible in use.
inline constexpr float min_visibility = 0.02f;

/// Visibility of the vertices of an asset's parts.
struct VertexVisibility {
    /// By part and vertex, in [min_visibility, 1]: the fraction of directions from which the surface around
    /// the vertex is visible, weighted by the cosine to its normal, and 1 for an unoccluded plane. For a part
    /// with several instances, the largest value. 1 for vertices without surface in the scene.
    std::vector<std::vector<float>> weights;
    std::uint64_t hidden_vertices = 0;  ///< number of vertices with visibility 0
};

/// Computes the visibility of the vertices of a scene in its default pose.
/// Rays are cast from the surface in 32 directions that are evenly distributed over the sphere. A face
/// occludes the surface behind it if its material is opaque and if it either faces the viewer or is
/// double-sided. Faces closer than 1/5,000 of the bounding box diagonal of the instance do not occlude. Faces
/// smaller than 1/400 of this diagonal are combined into patches of this radius with similar normals, and
/// each patch is sampled once. Source: Zhang and Turk, Visibility-Guided Simplification, 2002, for the
/// weighting; their visibility is determined from outside, by rendering.
/// \param scene  must have passed check_asset()
/// \throws InputError if all instances together have 2^31 faces or more, or 2^32 - 1 vertices or more
/// \throws whatever `context` throws
/// Complexity: O(n log n) time and about 250 n bytes for n faces of all instances together.
VertexVisibility vertex_visibility(const Asset& scene, const RunContext& context = {});

/// Warning that the visibility was computed in the default pose; empty if the scene is static.
std::string visibility_warning(const Asset& scene);

}  // namespace faqem::detail

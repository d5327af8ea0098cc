#pragma once
/// \file
/// How much of a scene's surface can be seen from outside.

#include <cstdint>
#include <string>
#include <vector>

#include "faqem/asset.hpp"
#include "faqem/detail/base/parallel.hpp"
#include "faqem/export.hpp"

namespace faqem::detail {

/// What MeshView::vertex_weights are where nothing is seen: a door may be opened.
inline constexpr float min_visibility = 0.02f;

/// What the vertices of an asset's parts can be seen of.
struct VertexVisibility {
    /// By part, one per vertex, in [min_visibility, 1]: the share of all directions from which the surface
    /// around it is seen, each counted by the cosine at which it is, over what is seen of a plane. Where the
    /// scene shows a part several times, the largest. 1 where there is no surface that the scene shows.
    std::vector<std::vector<float>> weights;
    std::uint64_t hidden_vertices = 0;  ///< vertices that nothing is seen of
};

/// Looks from the surface of the scene, as it stands, along directions spread evenly over the sphere. A face
/// hides what is behind it where its material is opaque, and it turns its front to who looks, or has two
/// sides. What is nearer than 1/5,000 of its instance's diagonal to a surface is on it. Faces smaller than
/// 1/400 of that diagonal are looked from together, as far as they lie within it and look the same way.
/// Source: Zhang and Turk, Visibility-Guided Simplification, 2002, for the weight; theirs looks from outside,
/// through an image.
/// \param scene  checked
/// \throws InputError  all instances together have 2^31 faces or more
/// \throws what the poll of the workers throws
/// O(n log n) for n faces of all instances together; about 250 bytes for each
FAQEM_EXPORT VertexVisibility vertex_visibility(const Asset& scene, const Workers& workers = {});

/// What is said of a scene that does not always stand so; empty where it does.
std::string visibility_warning(const Asset& scene);

}  // namespace faqem::detail

#pragma once
/// \file
/// Surface deep inside a scene.

#include <cstdint>
#include <vector>

#include "faqem/asset.hpp"
#include "faqem/engine/util/run_context.hpp"

namespace faqem::detail {

/// Lowers factors on costs to a tenth at vertices deep inside a scene: farther than 0.3% of the diagonal, and than a tenth
/// of the length of edges of the result, from every face that is seen in pictures from all sides, in which opaque faces
/// hide others as for vertex_visibility(). Surface close behind a visible one keeps its factors: where it is simplified
/// with larger errors, it shows or leaves gaps. Scenes that move stay as they are.
/// \param scene    must have passed check_asset()
/// \param share    of the faces of the scene that the result has; 0: unknown. With 0 and 1 nothing changes
/// \param weights  by part and vertex; empty for parts of which all vertices have the factor 1
/// \return the number of vertices deep inside
/// \throws whatever `context` throws
/// Complexity: O(n log n + pixels) for n faces of all instances together.
std::uint64_t lower_hidden_weights(const Asset& scene, double share, std::vector<std::vector<float>>& weights,
                                   const engine::RunContext& context);

}  // namespace faqem::detail

#pragma once
/// \file
/// Instances at the size at which they are seen.

#include <vector>

#include "faqem/asset.hpp"
#include "faqem/export.hpp"

namespace faqem::detail {

/// Lists the instances as instances(), with transforms for the measurement of sizes:
/// * A node whose scale is animated, by a channel or by KHR_animation_pointer, has the largest scale per axis of its own
///   and of all keyframes.
/// * The node of a skinned mesh does not place it. The transform is a uniform scaling instead: the root mean square of
///   the scales of the joints, from mesh to world space, weighted by the joint weights of all vertices.
/// Complexity: O(nodes + keyframes + vertices)
FAQEM_EXPORT std::vector<Instance> seen_instances(const Asset& asset);

}  // namespace faqem::detail

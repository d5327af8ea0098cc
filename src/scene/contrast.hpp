#pragma once
/// \file
/// How much the components of a scene stand out.

#include <vector>

#include "faqem/asset.hpp"
#include "faqem/engine/util/run_context.hpp"

namespace faqem::detail {

/// Factors on the costs at vertices, by what a picture loses with the component of the scene that they belong to. Eyes,
/// buckles and letters are small, so that their costs are, but people look at them.
/// In pictures from all sides, the squared difference between the base colour of the component and that of what is behind
/// it (sRGB, mean over its pixels) is compared with the mean over all pixels. Components with less than twice that have the
/// factor 1, the others this ratio, up to 10.
/// \param scene  in its default pose; images that cannot be decoded are white
/// \return by part and vertex; empty for parts of which all vertices have the factor 1
/// \throws whatever the check of `context` throws
/// Complexity: O(faces), and the images of base colours are decoded; O(1) for a single component after O(faces).
std::vector<std::vector<float>> contrast_weights(const Asset& scene, const engine::RunContext& context);

}  // namespace faqem::detail

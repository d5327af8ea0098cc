#pragma once
/// \file
/// How much the components of a scene stand out.

#include <vector>

#include "faqem/asset.hpp"
#include "faqem/engine/util/run_context.hpp"
#include "faqem/options.hpp"

namespace faqem::detail {

/// Whether pictures of the scene decide about factors on costs: where layers are separated, unless visibility does, and in
/// scenes that show at most a million faces.
bool is_weighted_by_pictures(const Asset& scene, const Options& options);

/// Computes factors on the costs at vertices. Components of the scene whose colour differs much from what is behind them,
/// such as eyes, buckles and letters, have larger factors: people look at them, but errors in them are small distances.
/// In pictures from all sides, the squared difference between the base colour of a component and that of the surface behind
/// it (sRGB, mean over its pixels) is divided by the mean over all pixels. A component with a ratio below 2 has the factor
/// 1, another one this ratio, at most 10.
/// \param scene  in its default pose; images that cannot be decoded are white
/// \return by part and vertex; empty for parts of which all vertices have the factor 1
/// \throws whatever the check of `context` throws
/// Complexity: that of part_components(), and with several components O(faces + pixels) and the decoding of the images of
/// base colours.
std::vector<std::vector<float>> contrast_weights(const Asset& scene, const engine::RunContext& context);

}  // namespace faqem::detail

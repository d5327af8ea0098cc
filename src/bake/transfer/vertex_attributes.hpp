#pragma once
/// \file
/// Attributes that live on vertices, taken from the original through the map.

#include "bake/transfer/corner_normals.hpp"
#include "bake/transfer/corners.hpp"
#include "bake/transfer/source_surface.hpp"

namespace faqem::detail {

/// Gives an output part the skin weights and morph targets of its source, if there are any. All vertices at
/// one place of the simplified mesh get the same weights and displacements, so that no crack opens when they move.
/// Weights are interpolated, the four largest kept and made to sum to 1.
/// \throws what the poll throws
void transfer_skin_and_morphs(const BakePart& part, WeldedPart& welded,
                              engine::CancellationCheck check_cancelled = {});

/// Colours for the corners of the simplified mesh (FA-QEM: "encoded as per-vertex color attributes"): the base
/// colour at the corner, the mean over the corners of a vertex with the same cluster and face group.
/// \return 3 * faces colours, linear, not premultiplied, in [0, 1]
std::vector<Vec4f> corner_colors(const BakePart& part, const SourceSampler& sampler,
                                 const CornerNormals& normals, Workers workers);

}  // namespace faqem::detail

#pragma once
/// \file
/// Vertex attributes, transferred from the source through the surface map.

#include "bake/parts/corners.hpp"
#include "bake/source/source_sampler.hpp"

namespace faqem::detail {

/// Whether the values of an attribute are copied from a vertex, and not interpolated: those of integers and of
/// feature ids (`_BATCHID`, `_FEATURE_ID_n`), whatever their type.
bool is_copied(const CustomAttribute& attribute);

/// Custom attributes at the corners of the simplified mesh. Copied values are those of the vertex, among those of the
/// source face, that is closest to the corner. Interpolated ones that differ by less than 1e-4 of the range of the
/// attribute at a vertex are equal there.
/// \return the attributes of the source with values by corner; none if there is no map
/// \throws whatever `context` throws
/// Complexity: O(corners) map queries
std::vector<CustomAttribute> corner_custom_attributes(const BakePart& part,
                                                      const engine::RunContext& context = {});

/// Transfers the skin weights and morph targets of the source, if there are any, to an output part.
/// All output vertices of one vertex of the simplified mesh get the same weights and displacements, so that
/// no crack opens when they move. Weights are interpolated; the four largest are kept and scaled to a sum of
/// 1.
/// \throws whatever `context` throws
void transfer_skin_and_morphs(const BakePart& part, WeldedPart& welded,
                              const engine::RunContext& context = {});

/// Colours at the corners of the simplified mesh (FA-QEM: "encoded as per-vertex color attributes"): the base
/// colour of the source, averaged over the corners of a vertex with the same face group and the same cluster of normals or,
/// without normals, color_facets() as large as the faces.
/// \return 3 * faces colours, linear, not premultiplied, in [0, 1]
/// \throws whatever `context` throws
std::vector<Vec4f> corner_colors(const BakePart& part, const SourceSampler& sampler,
                                 const RunContext& context);

}  // namespace faqem::detail

#pragma once
/// \file
/// Custom attributes, transferred from the source through the surface map.

#include <vector>

#include "bake/parts/corners.hpp"
#include "faqem/engine/util/run_context.hpp"

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

}  // namespace faqem::detail

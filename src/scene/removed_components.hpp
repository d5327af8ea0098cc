#pragma once
/// \file
/// Reports the visible components of a scene that were removed.

#include "faqem/bake.hpp"

namespace faqem::detail {

/// Adds the components of all parts that have no face in the result, and were visible in the scene, to its report,
/// with a warning. The shares refer to all instances of the scene. Does nothing unless the report counts
/// components that were collapsed, deleted or pruned.
/// \param source  the input of the simplification
/// \param result  of simplify_parts_to_targets()
/// Complexity: O(1), or O(vertices log vertices + faces of all instances) if there are such components
void report_removed_components(const Asset& source, SimplifiedParts& result);

}  // namespace faqem::detail

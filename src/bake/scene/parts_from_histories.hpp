#pragma once
/// \file
/// From histories that were cut to the small parts that bake() takes.

#include <vector>

#include "faqem/bake.hpp"
#include "faqem/export.hpp"

namespace faqem::detail {

/// The small meshes of the parts, and sums over their reports.
/// \param cuts  one per part, as cut_to() gives them
/// O(size)
FAQEM_EXPORT SmallParts restored(std::vector<CollapseHistory> cuts);

/// Whether the corners of the source's faces are where the histories say, but for welding.
/// \throws InputError  they are not, or the source has another number of parts
/// O(faces)
FAQEM_EXPORT void check_source(const Asset& source, const SmallParts& small);

}  // namespace faqem::detail

#pragma once
/// \file
/// From histories that were cut to the simplified parts that bake() takes.

#include <vector>

#include "faqem/bake.hpp"
#include "faqem/export.hpp"

namespace faqem::detail {

/// The simplified meshes of the parts, and sums over their reports.
/// \param cuts  one per part, as truncate_to_faces() gives them
/// O(size)
FAQEM_EXPORT SimplifiedParts parts_from_histories(std::vector<CollapseHistory> cuts);

/// Whether the corners of the source's faces are where the histories say, but for welding.
/// \throws InputError  they are not, or the source has another number of parts
/// O(faces)
FAQEM_EXPORT void check_source_matches_histories(const Asset& source, const SimplifiedParts& simplified);

}  // namespace faqem::detail

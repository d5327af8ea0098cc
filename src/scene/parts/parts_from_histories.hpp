#pragma once
/// \file
/// Restores simplified parts, as input of bake(), from truncated histories.

#include <vector>

#include "faqem/bake.hpp"
#include "faqem/export.hpp"

namespace faqem::detail {

/// Restores the simplified meshes of all parts, and sums up their reports.
/// \param cuts  one history per part, as returned by truncate_to_faces()
/// Complexity: O(size of the histories).
FAQEM_EXPORT SimplifiedParts parts_from_histories(std::vector<CollapseHistory> cuts);

/// Checks that the corners of the source's faces have the positions stored in the histories, except for small
/// offsets by welding.
/// \throws InputError if they have not, or if the numbers of parts differ
/// Complexity: O(faces).
FAQEM_EXPORT void check_source_matches_histories(const Asset& source, const SimplifiedParts& simplified);

}  // namespace faqem::detail

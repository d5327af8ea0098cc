#pragma once
/// \file
/// Mapping from the vertex versions of a history to the versions that they were finally merged into.

#include <cstddef>
#include <vector>

#include "faqem/engine/mesh/index_lists.hpp"
#include "faqem/export.hpp"
#include "faqem/history.hpp"

FAQEM_DETAIL_BEGIN

/// For each version, the last version that it was merged into; itself if it was never merged.
/// \pre every collapse merges two older versions, as validate() checks
/// O(versions)
inline std::vector<Index> final_versions(const CollapseHistory& history) {
    std::vector<Index> last = engine::all_indices(history.positions.size() + history.collapses.size());
    // Collapses merge versions into one with a higher number, so going backwards visits successors first.
    for (std::size_t k = history.collapses.size(); k-- > 0;) {
        const Index made = last[history.positions.size() + k];
        last[history.collapses[k].first] = last[history.collapses[k].second] = made;
    }
    return last;
}

FAQEM_DETAIL_END

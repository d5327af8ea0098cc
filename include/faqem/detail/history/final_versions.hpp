#pragma once
/// \file
/// Mapping from the vertex versions of a history to the versions that they were finally merged into.

#include <cstddef>
#include <numeric>
#include <vector>

#include "faqem/export.hpp"
#include "faqem/history.hpp"

FAQEM_NAMESPACE_BEGIN
namespace detail {

/// For each version, the last version that it was merged into; itself if it was never merged.
/// \pre every collapse merges two older versions, as validate() checks
/// O(versions)
inline std::vector<Index> final_versions(const CollapseHistory& history) {
    std::vector<Index> last(history.positions.size() + history.collapses.size());
    std::iota(last.begin(), last.end(), Index{0});
    // Collapses merge versions into one with a higher number, so going backwards visits successors first.
    for (std::size_t k = history.collapses.size(); k-- > 0;) {
        const Index made = last[history.positions.size() + k];
        last[history.collapses[k].first] = last[history.collapses[k].second] = made;
    }
    return last;
}

}  // namespace detail
FAQEM_NAMESPACE_END

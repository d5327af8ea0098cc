#pragma once
/// \file
/// What becomes of versions in the end.

#include <cstddef>
#include <numeric>
#include <vector>

#include "faqem/export.hpp"
#include "faqem/history.hpp"

FAQEM_NAMESPACE_BEGIN
namespace detail {

/// The latest version that each version became.
/// \pre every collapse joins two older versions.
/// O(versions)
inline std::vector<Index> final_versions(const CollapseHistory& history) {
    std::vector<Index> last(history.positions.size() + history.collapses.size());
    std::iota(last.begin(), last.end(), Index{0});
    // A version's successor has a higher number.
    for (std::size_t k = history.collapses.size(); k-- > 0;) {
        const Index made = last[history.positions.size() + k];
        last[history.collapses[k].first] = last[history.collapses[k].second] = made;
    }
    return last;
}

}  // namespace detail
FAQEM_NAMESPACE_END

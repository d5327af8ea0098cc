#pragma once
/// \file
/// Suggestions for misspelt names.

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "faqem/export.hpp"

FAQEM_DETAIL_BEGIN

/// Returns the optimal string alignment distance: the number of insertions, deletions, replacements and swaps
/// of adjacent characters that turn one word into the other, where no substring is edited more than once.
/// Complexity: O(a.size() * b.size()).
FAQEM_EXPORT std::size_t edit_distance(std::string_view a, std::string_view b);

/// Returns the closest known word; the first one if several are equally close. A word that begins with
/// `wrong` (of at least four characters) has distance 0. Empty if no word is within max(1, a third of the
/// length of `wrong`).
FAQEM_EXPORT std::string closest_word(std::string_view wrong, const std::vector<std::string>& known);

FAQEM_DETAIL_END

#ifdef FAQEM_HEADER_ONLY
#include "faqem/detail/base/closest_word-inl.hpp"
#endif

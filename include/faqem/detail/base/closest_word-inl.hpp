#pragma once

#include "faqem/detail/base/closest_word.hpp"

#include <algorithm>

FAQEM_DETAIL_BEGIN

FAQEM_INLINE std::size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
    for (std::size_t i = 0; i <= a.size(); ++i) d[i][0] = i;
    for (std::size_t j = 0; j <= b.size(); ++j) d[0][j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t replaced = d[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
            d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, replaced});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
        }
    }
    return d[a.size()][b.size()];
}

FAQEM_INLINE std::string closest_word(std::string_view wrong, const std::vector<std::string>& known) {
    constexpr std::size_t longest = 64;  // limits the work; all options are shorter
    if (wrong.size() > longest) return {};
    std::size_t best = std::max<std::size_t>(1, wrong.size() / 3) + 1;
    std::string found;
    for (const std::string& word : known) {
        const bool begins = wrong.size() >= 4 && word.starts_with(wrong);
        const std::size_t distance = begins ? 0 : edit_distance(wrong, word);
        if (distance >= best) continue;
        best = distance;
        found = word;
    }
    return found;
}

FAQEM_DETAIL_END

#pragma once
/// \file
/// Names and units in any letter case.

#include <string>

#include "faqem/export.hpp"

FAQEM_DETAIL_BEGIN

/// Returns a text with the letters A to Z in lower case, whatever the locale is.
inline std::string lower_case(std::string text) {
    for (char& c : text)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return text;
}

FAQEM_DETAIL_END

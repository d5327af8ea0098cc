#pragma once
// What a refused input or option is answered with, and texts in messages and warnings.

#include <string>
#include <vector>

#include "faqem/error.hpp"

namespace faqem::testing {

/// Message of the Exception that the call throws, or "accepted". Other exceptions are passed on.
template <class Exception = InputError, class Call>
std::string message_of(Call&& call) {
    try {
        call();
    } catch (const Exception& error) {
        return error.what();
    }
    return "accepted";
}

inline bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

inline bool any_contains(const std::vector<std::string>& texts, const std::string& part) {
    for (const std::string& text : texts)
        if (contains(text, part)) return true;
    return false;
}

}  // namespace faqem::testing

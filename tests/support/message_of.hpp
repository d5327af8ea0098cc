#pragma once
// What a refused input or option is answered with.

#include <string>

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

}  // namespace faqem::testing

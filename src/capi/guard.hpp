#pragma once
/// \file
/// Conversion of exceptions to status codes: no exception may leave the C API.

#include <initializer_list>
#include <string>
#include <utility>

#include "faqem/error.hpp"
#include "faqem/faqem.h"

namespace faqem::capi {

/// The progress callback cancelled the run.
class CancelledError : public Error {
public:
    CancelledError() : Error("cancelled by the progress callback") {}
};

/// Converts the current exception to a status and message. To be called in a catch block.
/// \param error  receives both; may be null
faqem_status status_of_exception(faqem_error* error) noexcept;

/// Checks that an argument is not null.
/// \throws OptionError  it is null; the message has its name
inline void require_argument(const void* argument, const char* name) {
    if (!argument) throw OptionError(std::string(name) + " must not be null");
}

/// Calls `work` if no argument is null, and converts exceptions.
/// \param error     receives status and message, also on success; may be null
/// \param required  arguments of the caller that must not be null, with their names
template <class Work>
faqem_status catch_exceptions(faqem_error* error,
                              std::initializer_list<std::pair<const void*, const char*>> required,
                              Work&& work) noexcept {
    try {
        for (const auto& [argument, name] : required) require_argument(argument, name);
        work();
    } catch (...) {
        return status_of_exception(error);
    }
    if (error) {
        error->status = FAQEM_OK;
        error->message[0] = '\0';
    }
    return FAQEM_OK;
}

}  // namespace faqem::capi

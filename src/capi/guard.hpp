#pragma once
/// \file
/// Conversion of exceptions to status codes: no exception may leave the C API.

#include <string>

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

/// Calls `work` and converts its exceptions.
/// \param error  receives status and message, also on success; may be null
template <class Work>
faqem_status catch_exceptions(faqem_error* error, Work&& work) noexcept {
    try {
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

#pragma once
/// \file
/// No exception leaves the C door.

#include <string>

#include "faqem/error.hpp"
#include "faqem/faqem.h"

namespace faqem::capi {

/// The work was given up because the progress callback said so.
class CancelledError : public Error {
public:
    CancelledError() : Error("cancelled") {}
};

/// To be called in a handler: what the exception is, also written to `error` where there is one.
faqem_status status_of_exception(faqem_error* error) noexcept;

/// \throws OptionError  an argument that must not be null is
inline void require_argument(const void* argument, const char* name) {
    if (!argument) throw OptionError(std::string(name) + " is null");
}

/// Runs `work` and says how it ended.
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

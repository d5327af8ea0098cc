#pragma once
/// \file
/// Exit codes of the command and the messages of errors.

#include <exception>
#include <string>

#include "faqem/error.hpp"

namespace faqem::cli {

/// Exit codes, documented in docs/cli.md.
enum ExitCode : int {
    exit_ok = 0,
    exit_internal = 1,
    exit_usage = 2,
    exit_bad_input = 3,
    exit_unsupported = 4,
    exit_target_missed = 5,
    exit_error_exceeded = 6,
    exit_cannot_write = 7,
    exit_cancelled = 8,
    exit_batch_incomplete = 9,
    exit_too_large = 10,
    exit_no_memory = 11,
    exit_time_limit = 12,
    exit_try_again = 75,  ///< EX_TEMPFAIL of sysexits.h
};

/// Thrown to end the command with an exit code that no error of the library stands for.
class CommandError : public Error {
public:
    CommandError(ExitCode exit_code, const std::string& message) : Error(message), code(exit_code) {}

    ExitCode code;
};

/// Returns the exit code for an exception; exit_internal for unknown types.
ExitCode exit_code_of(const std::exception& error);

/// Returns the text that is printed for an exception: what(), or a readable text for std::bad_alloc.
std::string message_of(const std::exception& error);

}  // namespace faqem::cli

#pragma once
/// \file
/// How the command ends.

#include <exception>
#include <string>

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
};

/// The exit code for an exception.
ExitCode exit_code_of(const std::exception& error);

/// What to tell about it.
std::string message_of(const std::exception& error);

}  // namespace faqem::cli

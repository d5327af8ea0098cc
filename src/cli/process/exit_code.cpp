#include "cli/process/exit_code.hpp"

#include <new>

namespace faqem::cli {

ExitCode exit_code_of(const std::exception& error) {
    if (const auto* own = dynamic_cast<const CommandError*>(&error)) return own->code;
    if (dynamic_cast<const OptionError*>(&error)) return exit_usage;
    if (dynamic_cast<const UnsupportedError*>(&error)) return exit_unsupported;
    if (dynamic_cast<const InputError*>(&error)) return exit_bad_input;
    if (dynamic_cast<const WriteError*>(&error)) return exit_cannot_write;
    if (dynamic_cast<const ByteLimitError*>(&error)) return exit_too_large;
    if (dynamic_cast<const TimeLimitError*>(&error)) return exit_time_limit;
    if (dynamic_cast<const std::bad_alloc*>(&error)) return exit_no_memory;
    return exit_internal;
}

std::string message_of(const std::exception& error) {
    if (dynamic_cast<const std::bad_alloc*>(&error)) return "not enough memory";
    return error.what();
}

}  // namespace faqem::cli

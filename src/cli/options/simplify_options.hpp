#pragma once
/// \file
/// Options that determine the result, shared by `faqem simplify`, `batch`, `lod` and `truncate`.

#include <string>
#include <string_view>
#include <vector>

#include "cli/files/input_model.hpp"
#include "cli/shell/command_tree.hpp"
#include "faqem/options.hpp"

namespace faqem::cli {

/// An option of the table (detail/options) on a command line or in a profile.
struct GivenOption {
    const detail::OptionRow* row;
    std::string value;
    bool is_typed;
};
using GivenOptions = std::vector<GivenOption>;

/// What the parsed command lines of these commands have in common.
struct SimplifyArguments {
    GivenOptions options;
    bool strict = false, strict_target = false;

    Strictness strictness() const { return strict ? Strictness::strict : Strictness::lenient; }
};

/// The options of the table that a command has.
/// \param given  receives the values; must exist until the command has run
std::vector<OptionInfo> table_options(detail::EntryPoint command, GivenOptions& given,
                                      detail::OptionTable table = detail::option_table());

/// --strict.
OptionInfo strict_option(bool& strict);

/// --strict and --strict-target.
std::vector<OptionInfo> strict_options(bool& strict, bool& strict_target);

/// Names of the options that were typed.
std::vector<std::string_view> typed_names(const GivenOptions& given);

/// Converts and validates options. \throws OptionError  a value is unknown or out of range
Options make_options(const GivenOptions& given, detail::OptionTable table = detail::option_table());

}  // namespace faqem::cli

#pragma once
/// \file
/// Commands and options as plain data. The parser, help, completion scripts, suggestions and the keys of
/// profiles are made from it.

#include <functional>
#include <string>
#include <vector>

#include "faqem/detail/options/option_table.hpp"

namespace faqem::cli {

/// An option or a positional argument.
struct OptionInfo {
    std::vector<std::string> names;  ///< for example `-h` and `--help`; one name without dashes: positional
    std::string value_name = {};     ///< placeholder of the value; words with bars between: its choices
    std::string description = {};    ///< what precedes the first semicolon is the line in --help
    detail::OptionKind kind = detail::OptionKind::text;
    std::string group = "Options";  ///< heading in help; empty: only in --help-all
    std::string excludes = {};      ///< option that cannot be given together with this one
    bool is_required = false;
    bool is_positional = false;  ///< of an option: it may also be the last word
    int max_words = 1;           ///< largest number of values

    /// Receives the values after parsing, and whether they were typed: those of a profile are not. Throws OptionError if
    /// they are invalid. Empty: the parser itself handles the option.
    std::function<void(const std::vector<std::string>& values, bool is_typed)> read = {};
};

/// The possible values of an option; empty if they are not enumerated.
inline std::vector<std::string> choices_of(const OptionInfo& option) {
    if (option.value_name.find('|') == std::string::npos) return {};
    return detail::split_choices(option.value_name);
}

/// All names of options.
inline std::vector<std::string> names_of(const std::vector<OptionInfo>& options) {
    std::vector<std::string> names;
    for (const OptionInfo& option : options)
        names.insert(names.end(), option.names.begin(), option.names.end());
    return names;
}

/// The line of an option in --help.
inline std::string summary_of(const OptionInfo& option) {
    return option.description.substr(0, option.description.find(';'));
}

/// Runs a command. Returns an exit code, or throws an exception that exit_code_of() maps to one.
using Action = std::function<int()>;

struct CommandInfo {
    std::string name, description;
    std::vector<std::string> examples = {};  ///< one line each
    std::vector<OptionInfo> positionals = {}, options = {};
    Action run = {};
};

/// A value of an option on a command line or in a profile.
struct ParsedValue {
    const OptionInfo* option;
    std::vector<std::string> words;  ///< empty: a flag that is false
    bool is_typed;
};

struct CommandTree {
    std::string description = {};
    std::string exit_codes = {};           ///< paragraph that lists the exit codes
    std::vector<OptionInfo> options = {};  ///< options of `faqem` without a subcommand
    std::vector<CommandInfo> commands = {};
    /// Adds the values of profiles to those that were typed. Empty: there are no profiles.
    std::function<void(const CommandTree& tree, const CommandInfo& command, std::vector<ParsedValue>& values)>
        add_profiles = {};
};

}  // namespace faqem::cli

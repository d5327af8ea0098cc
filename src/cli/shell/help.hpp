#pragma once
/// \file
/// The text of --help and --help-all.

#include <CLI/StringTools.hpp>
#include <algorithm>
#include <sstream>
#include <string>

#include "cli/shell/command_tree.hpp"

namespace faqem::cli {

inline constexpr std::size_t line_width = 80, text_column = 22;

/// Appends a name and a text, which begins at text_column or later and continues there.
inline void add_entry(std::string& help, std::string name, const std::string& text) {
    name.insert(0, "  ");
    name.resize(std::max(text_column, name.size() + 2), ' ');
    std::size_t line = help.size();  // its begin
    help += name;
    std::istringstream words(text);
    for (std::string word; words >> word;) {
        const bool needs_space = help.back() != ' ';
        if (help.size() - line + needs_space + word.size() > line_width) {
            line = help.size() + 1;
            help.append("\n").append(text_column, ' ');
        } else if (needs_space) {
            help += ' ';
        }
        help += word;
    }
    help += '\n';
}

inline void add_option(std::string& help, const OptionInfo& option, bool all) {
    std::string names = CLI::detail::join(option.names, ", ");
    if (!option.value_name.empty()) names.append(" ").append(option.value_name);
    add_entry(help, names, all ? option.description : summary_of(option));
}

/// Text of `faqem --help`.
inline std::string tree_help(const CommandTree& tree) {
    std::string help = tree.description + "\n\nUsage: faqem COMMAND [OPTIONS]\n\nCommands:\n";
    for (const CommandInfo& command : tree.commands) add_entry(help, command.name, command.description);
    help += "\nOptions:\n";
    for (const OptionInfo& option : tree.options) add_option(help, option, true);
    return help + "\n" + tree.exit_codes + "\n";
}

/// Text of `faqem COMMAND --help`, with the options that have a group, each on one line; with `all` those of
/// --help-all, which has all options and their whole descriptions.
inline std::string command_help(const CommandInfo& command, bool all) {
    std::string help = command.description + "\n\nUsage: faqem " + command.name + " [OPTIONS]";
    for (const OptionInfo& positional : command.positionals) help.append(" ").append(positional.names.back());
    help += "\n";
    for (const OptionInfo& positional : command.positionals)
        add_entry(help, positional.names.back(), positional.description);
    std::vector<std::string> groups;
    for (const OptionInfo& option : command.options)
        if (std::ranges::find(groups, option.group) == groups.end()) groups.push_back(option.group);
    std::stable_partition(groups.begin(), groups.end(), [](const std::string& one) { return !one.empty(); });
    for (const std::string& group : groups) {
        if (group.empty() && !all) continue;
        help.append("\n").append(group.empty() ? "Other options" : group).append(":\n");
        for (const OptionInfo& option : command.options)
            if (option.group == group) add_option(help, option, all);
    }
    help += "\nExamples:\n";
    for (const std::string& example : command.examples) help.append("  ").append(example).append("\n");
    return all ? help : help + "\nfaqem " + command.name + " --help-all lists all options.\n";
}

}  // namespace faqem::cli

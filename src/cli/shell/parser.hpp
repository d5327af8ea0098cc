#pragma once
/// \file
/// The parser of the command line, and suggestions for misspelt commands and options.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "cli/shell/command_tree.hpp"
#include "cli/shell/help.hpp"
#include "faqem/detail/base/closest_word.hpp"
#include "faqem/version.hpp"

namespace faqem::cli {

using ParsedOption = std::pair<const OptionInfo*, CLI::Option*>;

inline CLI::Option* add_to_command(CLI::App& command, const OptionInfo& info) {
    std::string names = CLI::detail::join(info.names, ",");
    if (info.is_positional) names.append(",").append(info.value_name);
    if (info.kind == detail::OptionKind::flag) return command.add_flag(names);
    CLI::Option* option = command.add_option(names);
    option->required(info.is_required && !info.is_positional)->expected(1, info.max_words);
    option->allow_extra_args(info.max_words > 1);
    if (info.kind == detail::OptionKind::list) option->delimiter(',');
    return option;
}

/// The typed values. \throws CLI::RequiredError  a positional argument is missing
inline std::vector<ParsedValue> typed_values(const std::vector<ParsedOption>& options) {
    std::vector<ParsedValue> result;
    for (const auto& [info, option] : options) {
        // CLI11 would say that --output is missing.
        if (option->count() == 0 && info->is_positional && info->is_required)
            throw CLI::RequiredError(info->value_name);
        if (option->count() == 0) continue;
        const bool is_false = info->kind == detail::OptionKind::flag &&
                              CLI::detail::to_flag_value(option->results().back()) <= 0;  // --quiet=false
        result.push_back({info, is_false ? std::vector<std::string>() : option->results(), true});
    }
    return result;
}

inline void add_command(CLI::App& app, const CommandTree& tree, const CommandInfo& info, Action& action) {
    CLI::App& command = *app.add_subcommand(info.name);
    std::vector<ParsedOption> options;
    for (const std::vector<OptionInfo>& group : {std::cref(info.positionals), std::cref(info.options)}) {
        for (const OptionInfo& option : group)
            if (option.read) options.emplace_back(&option, add_to_command(command, option));
    }
    for (const auto& [option, parsed] : options)
        if (!option->excludes.empty()) parsed->excludes(command.get_option(option->excludes));
    command.final_callback([options, &tree, &info, &action] {
        std::vector<ParsedValue> values = typed_values(options);
        if (tree.add_profiles) tree.add_profiles(tree, info, values);
        for (const ParsedValue& value : values)
            if (!value.words.empty()) value.option->read(value.words, value.is_typed);
        action = info.run;
    });
}

/// Adds all commands and options to an empty app. Parsing a command line passes the values to the options
/// (OptionInfo::read) and sets `action` to the function that runs the command.
/// \param tree  must exist until the command line is parsed
inline void add_to_parser(CLI::App& app, const CommandTree& tree, Action& action) {
    app.name("faqem");
    app.set_version_flag("-V,--version", "faqem " + std::string(version()));
    app.set_help_all_flag("--help-all");
    app.require_subcommand(1);
    app.allow_windows_style_options(false);  // "/" begins paths
    app.formatter_fn([&tree](const CLI::App* shown, const std::string&, CLI::AppFormatMode mode) {
        for (const CommandInfo& command : tree.commands)
            if (command.name == shown->get_name())
                return command_help(command, mode == CLI::AppFormatMode::All);
        return tree_help(tree);
    });
    for (const CommandInfo& command : tree.commands) add_command(app, tree, command, action);
}

/// Returns the known command or option that is closest to the first unknown one on a command line.
/// \param words  the command line without the name of the program
/// \return empty if no command or option is unknown or none is close
inline std::string suggestion(const CommandTree& tree, const std::vector<std::string>& words) {
    if (words.empty()) return {};
    std::vector<std::string> commands;
    for (const CommandInfo& command : tree.commands) commands.push_back(command.name);
    const auto chosen = std::ranges::find(tree.commands, words[0], &CommandInfo::name);
    if (chosen == tree.commands.end())
        return detail::closest_word(words[0], words[0].starts_with('-') ? names_of(tree.options) : commands);
    const std::vector<std::string> known = names_of(chosen->options);
    for (std::size_t i = 1; i < words.size() && words[i] != "--"; ++i) {
        if (!words[i].starts_with("--")) continue;
        const std::string name = words[i].substr(0, words[i].find('='));
        if (std::ranges::find(known, name) == known.end()) return detail::closest_word(name, known);
    }
    return {};
}

}  // namespace faqem::cli

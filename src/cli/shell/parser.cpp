#include "cli/shell/parser.hpp"

#include <CLI/CLI.hpp>
#include <utility>

#include "faqem/version.hpp"

namespace faqem::cli {

namespace {

using ParsedOption = std::pair<const OptionInfo*, CLI::Option*>;

CLI::Option* add_to_command(CLI::App& command, const OptionInfo& info) {
    std::string names;
    for (const std::string& name : info.names) names.append(names.empty() ? "" : ",").append(name);
    if (info.kind == detail::OptionKind::flag) {
        CLI::Option* flag = command.add_flag(
            info.flag_value.empty() ? names : names + "{" + info.flag_value + "}", info.description);
        if (!info.value_name.empty()) flag->type_name(info.value_name);
        return flag;
    }
    CLI::Option* option = command.add_option(names, info.description);
    option->type_name(option->get_positional() ? " " : info.value_name);
    option->required(info.is_required)->expected(info.min_words, info.max_words);
    option->allow_extra_args(info.max_words > 1);
    if (info.kind == detail::OptionKind::list) option->delimiter(',');
    return option;
}

void read_values(const ParsedOption& parsed) {
    const auto& [info, option] = parsed;
    if (option->count() == 0) return;
    const bool is_plain_flag = info->kind == detail::OptionKind::flag && info->flag_value.empty();
    if (is_plain_flag && CLI::detail::to_flag_value(option->results().back()) <= 0) return;  // --quiet=false
    info->read(option->results());
}

void add_command(CLI::App& app, const CommandInfo& info, Action& action) {
    CLI::App& command = *app.add_subcommand(info.name, info.description);
    std::string examples = "Examples:";
    for (const std::string& example : info.examples) examples.append("\n  ").append(example);
    command.footer(examples);
    std::vector<ParsedOption> options;
    for (const std::vector<OptionInfo>& group : {std::cref(info.positionals), std::cref(info.options)}) {
        for (const OptionInfo& option : group) {
            if (option.read) options.emplace_back(&option, add_to_command(command, option));
        }
    }
    for (const auto& [option, parsed] : options) {
        for (const std::string& other : option->excludes) parsed->excludes(command.get_option(other));
    }
    command.final_callback([options, &info, &action] {
        for (const ParsedOption& option : options) read_values(option);
        action = info.run;
    });
}

}  // namespace

void add_to_parser(CLI::App& app, const CommandTree& tree, Action& action) {
    app.description(tree.description);
    app.name("faqem");
    app.set_version_flag("--version", "faqem " + std::string(version()));
    app.require_subcommand(1);
    app.footer(tree.exit_codes);
    for (const CommandInfo& command : tree.commands) add_command(app, command, action);
}

}  // namespace faqem::cli

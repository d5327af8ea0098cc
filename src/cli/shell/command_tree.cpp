#include "cli/shell/command_tree.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <sstream>

namespace faqem::cli {

namespace {

std::vector<std::string> split(const std::string& text, char separator) {
    std::vector<std::string> parts;
    std::istringstream in(text);
    for (std::string part; std::getline(in, part, separator);) parts.push_back(part);
    return parts;
}

OptionInfo info_of(const CLI::Option& option) {
    OptionInfo info;
    info.description = option.get_description();
    if (option.get_positional()) {
        info.names = {option.get_name(true)};
        return info;
    }
    for (const std::string& name : option.get_snames()) info.names.push_back("-" + name);
    for (const std::string& name : option.get_lnames()) info.names.push_back("--" + name);
    for (const CLI::Option* other : option.get_excludes()) info.excludes.push_back(other->get_name());
    std::sort(info.excludes.begin(), info.excludes.end());  // CLI11's set is ordered by address
    std::string type = option.get_type_name();
    type = type.substr(0, type.find(':'));  // the validators follow after the colon
    if (option.get_expected_min() == 0) {
        info.optional_value_name = type;
        return info;
    }
    info.value_name = type;
    if (info.value_name.find('|') != std::string::npos) info.choices = split(info.value_name, '|');
    return info;
}

/// Returns the indented lines of a footer without their indentation.
std::vector<std::string> example_lines(const std::string& footer) {
    std::vector<std::string> lines;
    for (const std::string& line : split(footer, '\n')) {
        if (line.starts_with("  ")) lines.push_back(line.substr(2));
    }
    return lines;
}

}  // namespace

CommandTree command_tree(const CLI::App& app) {
    CommandTree tree{app.get_description(), app.get_footer(), {}, {}};
    for (const CLI::Option* option : app.get_options()) tree.options.push_back(info_of(*option));
    for (const CLI::App* sub : app.get_subcommands(std::function<bool(const CLI::App*)>())) {
        CommandInfo command{
            sub->get_name(), sub->get_description(), example_lines(sub->get_footer()), {}, {}};
        for (const CLI::Option* option : sub->get_options()) {
            (option->get_positional() ? command.arguments : command.options).push_back(info_of(*option));
        }
        tree.commands.push_back(command);
    }
    return tree;
}

}  // namespace faqem::cli

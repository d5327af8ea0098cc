// The faqem command. Errors are printed to stderr, data to stdout.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <exception>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

#include "cli/commands/command_line.hpp"
#include "cli/process/exit_code.hpp"
#include "cli/shell/parser.hpp"
#include "faqem/error.hpp"

namespace faqem::cli {

namespace {

int fail(const std::exception& error) {
    std::cerr << "faqem: " << message_of(error) << "\n";
    return exit_code_of(error);
}

int run(const Action& action) try {
    const int code = action();
    std::cout.flush();
    if (!std::cout) throw WriteError("cannot write to standard output");
    return code;
} catch (const std::exception& error) {
    return fail(error);
}

/// Returns the command line that a short form stands for: `faqem`, `faqem help [COMMAND]`, `faqem IN OUT`.
std::vector<std::string> without_short_form(const CommandTree& tree, std::vector<std::string> words) {
    if (!words.empty() && words[0] == "help") {
        words.erase(words.begin());
        for (const CommandInfo& command : tree.commands)
            if (!words.empty() && command.name == words[0]) words = {command.name, "--help"};
    }
    if (words.empty()) words = {"--help"};
    const bool is_file = !words[0].starts_with('-') && words[0].find_first_of("./") != std::string::npos;
    if (is_file) words.insert(words.begin(), "simplify");
    return words;
}

/// The message of the parser. It lists words in reverse order, and does not name the commands.
std::string usage_message(const CLI::App& app, const CommandTree& tree, const CLI::ParseError& error) {
    if (app.get_subcommands().empty()) {
        std::string text = "the first word must be a model or a command:";
        for (const CommandInfo& command : tree.commands) text += " " + command.name;
        return text;
    }
    const std::string command = app.get_subcommands().front()->get_name() + ": ";
    if (!dynamic_cast<const CLI::ExtrasError*>(&error)) return command + error.what();
    return command + "not expected: " + CLI::detail::join(app.remaining(true), " ");
}

int parse_and_run(int argc, char** argv) {
    CLI::App app;
    Action action;
    const CommandTree tree = command_tree();
    add_to_parser(app, tree, action);
    const std::vector<std::string> words = without_short_form(tree, {argv + std::min(argc, 1), argv + argc});
    try {
        std::vector<std::string> reversed(words.rbegin(), words.rend());  // as CLI11 expects them
        app.parse(std::move(reversed));
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0) return app.exit(error);
        std::cerr << "faqem: " << usage_message(app, tree, error) << "\n";
        const std::string suggested = suggestion(tree, words);
        if (!suggested.empty()) std::cerr << "Did you mean " << suggested << "?\n";
        return exit_usage;
    } catch (const std::exception& error) {
        return fail(error);
    }
    return run(action);
}

}  // namespace

}  // namespace faqem::cli

int main(int argc, char** argv) { return faqem::cli::parse_and_run(argc, argv); }

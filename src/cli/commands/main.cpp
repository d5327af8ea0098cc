// The faqem command. Errors are printed to stderr, data to stdout.

#include <fcntl.h>

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
#include "faqem/detail/base/peak_memory.hpp"  // <windows.h>
#include "faqem/error.hpp"

namespace faqem::cli {

namespace {

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
#ifdef _WIN32
        text += "; batch and list need Linux";
#endif
        return text;
    }
    const std::string command = app.get_subcommands().front()->get_name() + ": ";
    if (!dynamic_cast<const CLI::ExtrasError*>(&error)) return command + error.what();
    return command + "not expected: " + CLI::detail::join(app.remaining(true), " ");
}

int parse_and_run(std::vector<std::string> words) {
    CLI::App app;
    Action action;
    const CommandTree tree = command_tree();
    add_to_parser(app, tree, action);
    words = without_short_form(tree, std::move(words));
    try {
        std::vector<std::string> reversed(words.rbegin(), words.rend());  // as CLI11 expects them
        app.parse(std::move(reversed));
        const int code = action();
        std::cout.flush();
        if (!std::cout) throw WriteError("cannot write to standard output");
        return code;
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0) return app.exit(error);
        std::cerr << "faqem: " << usage_message(app, tree, error) << "\n";
        const std::string suggested = suggestion(tree, words);
        if (!suggested.empty()) std::cerr << "Did you mean " << suggested << "?\n";
        return exit_usage;
    } catch (const std::exception& error) {
        std::cerr << "faqem: " << message_of(error) << "\n";
        return exit_code_of(error);
    }
}

}  // namespace

}  // namespace faqem::cli

#ifdef _WIN32
int wmain(int argc, wchar_t** argv) {
    SetConsoleOutputCP(CP_UTF8);
    DWORD mode = 0;  // the progress bar uses escape sequences
    HANDLE const terminal = GetStdHandle(STD_ERROR_HANDLE);
    if (GetConsoleMode(terminal, &mode)) SetConsoleMode(terminal, mode | ENABLE_VIRTUAL_TERMINAL_PROCESSING);
    for (FILE* stream : {stdout, stderr}) _setmode(_fileno(stream), _O_BINARY);  // no carriage returns
    std::vector<std::string> words;
    for (int i = 1; i < argc; ++i) words.push_back(std::filesystem::path(argv[i]).string());
    return faqem::cli::parse_and_run(std::move(words));
}
#else
int main(int argc, char** argv) { return faqem::cli::parse_and_run({argv + std::min(argc, 1), argv + argc}); }
#endif

// The faqem command: errors on stderr, data on stdout.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <exception>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

#include "faqem/error.hpp"
#include "cli/commands/command_line.hpp"
#include "cli/shell/command_tree.hpp"
#include "cli/exit_code.hpp"
#include "cli/options/profile.hpp"
#include "cli/shell/suggestion.hpp"

namespace faqem::tool {

namespace {

int fail(const std::exception& error) {
    std::cerr << "faqem: " << message_of(error) << "\n";
    return exit_code_of(error);
}

int run(const Action& action) try {
    const int code = action();
    std::cout.flush();
    if (!std::cout) throw WriteError("standard output: cannot be written");
    return code;
} catch (const std::exception& error) {
    return fail(error);
}

int parse_and_run(int argc, char** argv) {
    CLI::App app;
    Action action;
    build_command_line(app, action);
    const std::vector<std::string> words(argv + std::min(argc, 1), argv + argc);
    try {
        std::vector<std::string> all = with_profile(command_tree(app), words);
        std::reverse(all.begin(), all.end());  // as CLI11 takes them
        app.parse(std::move(all));
    } catch (const CLI::ParseError& error) {
        if (app.exit(error) == 0) return exit_ok;
        const std::string meant = suggestion(command_tree(app), words);
        if (!meant.empty()) std::cerr << "Did you mean " << meant << "?\n";
        return exit_usage;
    } catch (const std::exception& error) {
        return fail(error);
    }
    return run(action);
}

}  // namespace

}  // namespace faqem::tool

int main(int argc, char** argv) { return faqem::tool::parse_and_run(argc, argv); }

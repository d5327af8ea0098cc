// The faqem command: errors on stderr, data on stdout.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <exception>
#include <iostream>

#include "faqem/error.hpp"
#include "tool/command_line.hpp"
#include "tool/command_tree.hpp"
#include "tool/exit_code.hpp"
#include "tool/suggestion.hpp"

namespace faqem::tool {

namespace {

int run(const Action& action) try {
    const int code = action();
    std::cout.flush();
    if (!std::cout) throw WriteError("standard output: cannot be written");
    return code;
} catch (const std::exception& error) {
    std::cerr << "faqem: " << message_of(error) << "\n";
    return exit_code_of(error);
}

int parse_and_run(int argc, char** argv) {
    CLI::App app;
    Action action;
    build_command_line(app, action);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        if (app.exit(error) == 0) return exit_ok;
        const std::string meant = suggestion(command_tree(app), {argv + std::min(argc, 1), argv + argc});
        if (!meant.empty()) std::cerr << "Did you mean " << meant << "?\n";
        return exit_usage;
    }
    return run(action);
}

}  // namespace

}  // namespace faqem::tool

int main(int argc, char** argv) { return faqem::tool::parse_and_run(argc, argv); }

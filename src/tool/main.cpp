// The faqem command: errors on stderr, data on stdout.

#include <CLI/CLI.hpp>
#include <exception>
#include <iostream>

#include "faqem/error.hpp"
#include "faqem/version.hpp"
#include "tool/commands.hpp"
#include "tool/exit_code.hpp"

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
    CLI::App app("Simplifies textured triangle meshes.", "faqem");
    app.set_version_flag("--version", "faqem " + std::string(version()));
    app.require_subcommand(1);
    app.footer(
        "Exit codes: 0 done, 1 internal error, 2 usage, 3 bad input, 4 unsupported input,\n"
        "5 target missed (with --strict-target), 6 --max-error exceeded, 7 cannot write, 8 cancelled,\n"
        "9 not all files of a batch are done, 10 --max-bytes missed, 11 not enough memory.");
    Action action;
    add_simplify_command(app, action);
    add_lod_command(app, action);
    add_cut_command(app, action);
    add_batch_command(app, action);
    add_info_command(app, action);
    add_compare_command(app, action);
    add_render_command(app, action);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? exit_ok : exit_usage;
    }
    return run(action);
}

}  // namespace

}  // namespace faqem::tool

int main(int argc, char** argv) { return faqem::tool::parse_and_run(argc, argv); }

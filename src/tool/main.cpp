// The faqem command: errors on stderr, data on stdout.

#include <CLI/CLI.hpp>
#include <exception>
#include <iostream>
#include <new>

#include "faqem/error.hpp"
#include "tool/commands.hpp"
#include "tool/exit_code.hpp"

namespace faqem::tool {

namespace {

int report_error(const std::exception& error, int code) {
    std::cerr << "faqem: " << error.what() << "\n";
    return code;
}

int run(const Action& action) try {
    const int code = action();
    std::cout.flush();
    if (!std::cout) throw WriteError("standard output: cannot be written");
    return code;
} catch (const OptionError& error) {
    return report_error(error, exit_usage);
} catch (const UnsupportedError& error) {
    return report_error(error, exit_unsupported);
} catch (const InputError& error) {
    return report_error(error, exit_bad_input);
} catch (const WriteError& error) {
    return report_error(error, exit_cannot_write);
} catch (const std::bad_alloc&) {
    std::cerr << "faqem: not enough memory\n";
    return exit_internal;
} catch (const std::exception& error) {
    return report_error(error, exit_internal);
}

int parse_and_run(int argc, char** argv) {
    CLI::App app("Simplifies textured triangle meshes.", "faqem");
    app.set_version_flag("--version", std::string("faqem ") + FAQEM_VERSION);
    app.require_subcommand(1);
    app.footer(
        "Exit codes: 0 done, 1 internal error, 2 usage, 3 bad input, 4 unsupported input,\n"
        "5 target missed (with --strict-target), 6 --max-error exceeded, 7 cannot write, 8 cancelled.");
    Action action;
    add_simplify_command(app, action);
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

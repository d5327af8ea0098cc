#include "cli/commands/command_line.hpp"

#include "cli/commands/commands.hpp"
#include "cli/options/bound_options.hpp"
#include "cli/options/profile.hpp"

namespace faqem::cli {

namespace {

/// The parser handles these two.
std::vector<OptionInfo> help_options() {
    return {rare({{"-h", "--help"}, "", "Print the usual options and examples", detail::OptionKind::flag}),
            rare({{"--help-all"}, "", "Print all options", detail::OptionKind::flag})};
}

}  // namespace

void complete_options(CommandTree& tree) {
    tree.add_profiles = add_profile_values;
    for (CommandInfo& command : tree.commands) {
        const std::vector<OptionInfo> help = help_options();
        command.options.insert(command.options.begin(), help.begin(), help.end());
    }
}

CommandTree command_tree() {
    CommandTree tree;
    tree.description = "Simplifies textured triangle meshes.";
    tree.exit_codes =
        "Exit codes: 0 success, 1 internal error, 2 usage, 3 bad input,\n"
        "4 unsupported input, 5 target missed (with --strict-target),\n"
        "6 --max-error exceeded, 7 cannot write, 8 cancelled, 9 not all models of a batch\n"
        "are done, 10 --max-bytes exceeded, 11 not enough memory, 12 --max-seconds was\n"
        "over before there was a result, 75 a shard is not complete.";
    tree.options = help_options();
    tree.options.push_back({{"-V", "--version"}, "", "Print the version", detail::OptionKind::flag});
    tree.commands = {simplify_command(), lod_command(),       truncate_command(), bake_command(),
#ifndef _WIN32
                     batch_command(),    list_command(),
#endif
                     info_command(),     compare_command(),   render_command(),   report_command(),
                     profiles_command(), completion_command()};
    complete_options(tree);
    return tree;
}

}  // namespace faqem::cli

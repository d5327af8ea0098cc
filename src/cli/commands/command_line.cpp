#include "cli/commands/command_line.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "cli/commands/commands.hpp"

namespace faqem::cli {

namespace {

const OptionInfo help_option{
    {"-h", "--help"}, "", "Print this help message and exit", detail::OptionKind::flag};

void exclude_mutually(std::vector<OptionInfo>& options) {
    for (const OptionInfo& option : options) {
        for (OptionInfo& other : options) {
            const auto& excluded = option.excludes;
            const std::string& name = option.names.back();
            const bool is_excluded =
                std::find(excluded.begin(), excluded.end(), other.names.back()) != excluded.end();
            if (!is_excluded ||
                std::find(other.excludes.begin(), other.excludes.end(), name) != other.excludes.end())
                continue;
            other.excludes.push_back(name);
            std::sort(other.excludes.begin(), other.excludes.end());
        }
    }
}

}  // namespace

void complete_options(CommandTree& tree) {
    for (CommandInfo& command : tree.commands) {
        command.options.insert(command.options.begin(), help_option);
        exclude_mutually(command.options);
    }
}

CommandTree command_tree() {
    CommandTree tree;
    tree.description = "Simplifies textured triangle meshes.";
    tree.exit_codes =
        "Exit codes: 0 success, 1 internal error, 2 usage, 3 bad input, 4 unsupported input,\n"
        "5 target missed (with --strict-target), 6 --max-error exceeded, 7 cannot write, 8 cancelled,\n"
        "9 not all models of a batch are done, 10 --max-bytes exceeded, 11 not enough memory,\n"
        "12 --max-seconds was over before there was a result.";
    tree.options = {
        help_option,
        {{"--version"}, "", "Display program version information and exit", detail::OptionKind::flag}};
    tree.commands = {simplify_command(), lod_command(),        truncate_command(), batch_command(),
                     info_command(),     compare_command(),    render_command(),   report_command(),
                     profiles_command(), completion_command(), man_command()};
    complete_options(tree);
    return tree;
}

}  // namespace faqem::cli

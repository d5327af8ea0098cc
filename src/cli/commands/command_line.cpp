#include "cli/commands/command_line.hpp"

#include <CLI/CLI.hpp>
#include <array>
#include <string>
#include <string_view>
#include <utility>

#include "faqem/version.hpp"

namespace faqem::cli {

namespace {

using Pair = std::pair<std::string_view, std::string_view>;

/// Placeholders for the values of options in help. Words separated by bars are the possible values, which
/// completion offers. An option has the same placeholder in all commands.
constexpr std::array value_names = {
    Pair{"--bake", "auto|atlas|per-triangle|vertex|keep|none"},
    Pair{"--budget", "scene|mesh"},
    Pair{"--config", "FILE"},
    Pair{"--correspondence", "FILE"},
    Pair{"--faces", "N"},
    Pair{"--format", "glb|gltf|obj|ply|stl"},
    Pair{"--fov", "ANGLE"},
    Pair{"--history", "FILE"},
    Pair{"--image-format", "png|jpeg|source"},
    Pair{"--jobs", "N"},
    Pair{"--levels", "LIST"},
    Pair{"--mapping", "projection|lineage|closest"},
    Pair{"--max-bytes", "SIZE"},
    Pair{"--max-error", "LENGTH"},
    Pair{"--max-memory", "SIZE"},
    Pair{"--normal-map", "auto|on|off"},
    Pair{"--normals", "transfer|smooth|flat|none"},
    Pair{"--out", "FILE"},
    Pair{"--pixel-error", "N"},
    Pair{"--preset", "qem|paper|stmw|fast|balanced|best"},
    Pair{"--prune", "LENGTH"},
    Pair{"--ratio", "R"},
    Pair{"--report", "FILE"},
    Pair{"--samples", "N"},
    Pair{"--screen-height", "N"},
    Pair{"--seed", "N"},
    Pair{"--size", "N"},
    Pair{"--source", "FILE"},
    Pair{"--texel-density", "X"},
    Pair{"--texture-size", "N"},
    Pair{"--textures", "each|shared"},
    Pair{"--threads", "N"},
    Pair{"--tolerance", "T"},
    Pair{"--views", "N"},
    Pair{"--virtual-edges", "TAU"},
    Pair{"--visibility", "ignored|weighted"},
    Pair{"--w-area", "W"},
    Pair{"--w-boundary", "W"},
    Pair{"--w-normal", "W"},
    Pair{"--w-plane-area", "W"},
    Pair{"--w-uv", "W"},
    Pair{"--weld", "D"},
};

constexpr std::array examples = {
    Pair{"simplify",
         "  faqem simplify model.glb simplified.glb --ratio 0.05\n"
         "  faqem simplify scan.ply simplified.ply --bake vertex --faces 20000 --report simplified.json\n"
         "  faqem simplify part.stl simplified.stl --max-error 0.05\n"
         "  faqem simplify model.glb web.glb --max-bytes 2MB"},
    Pair{"lod",
         "  faqem lod statue.glb out --levels 0.5,0.25,0.1,0.01\n"
         "  faqem lod scan.ply out --levels error:0.1%,error:2% --bake vertex --format ply"},
    Pair{"truncate", "  faqem truncate statue.history statue-5000.glb --faces 5000 --source statue.glb"},
    Pair{"batch",
         "  faqem batch scans simplified --ratio 0.02 --resume >> simplified.jsonl\n"
         "  faqem batch parts simplified --format stl --max-error 0.05 --jobs 4"},
    Pair{"info", "  faqem info model.glb --json"},
    Pair{"compare", "  faqem compare model.glb simplified.glb --samples 1000000"},
    Pair{"render", "  faqem render model.glb simplified.glb before-after.png --views 3"},
    Pair{"report", "  faqem report model.glb simplified.glb -o report.html"},
    Pair{"completion",
         "  source <(faqem completion bash)\n"
         "  faqem completion zsh > ~/.zfunc/_faqem"},
    Pair{"man", "  faqem man | man -l -"},
};

void set_value_names(CLI::App& command) {
    for (const auto& [option, value] : value_names) {
        if (CLI::Option* found = command.get_option_no_throw(std::string(option)))
            found->type_name(std::string(value));
    }
    for (CLI::Option* option : command.get_options()) {
        if (option->get_positional()) option->type_name(" ");
    }
}

}  // namespace

void build_command_line(CLI::App& app, Action& action) {
    app.description("Simplifies textured triangle meshes.");
    app.name("faqem");
    app.set_version_flag("--version", "faqem " + std::string(version()));
    app.require_subcommand(1);
    add_simplify_command(app, action);
    add_lod_command(app, action);
    add_truncate_command(app, action);
    add_batch_command(app, action);
    add_info_command(app, action);
    add_compare_command(app, action);
    add_render_command(app, action);
    add_report_command(app, action);
    add_completion_command(app, action);
    add_man_command(app, action);
    for (const auto& [command, lines] : examples) {
        app.get_subcommand(std::string(command))->footer("Examples:\n" + std::string(lines));
    }
    for (CLI::App* command : app.get_subcommands({})) set_value_names(*command);
    app.footer(
        "Exit codes: 0 success, 1 internal error, 2 usage, 3 bad input, 4 unsupported input,\n"
        "5 target missed (with --strict-target), 6 --max-error exceeded, 7 cannot write, 8 cancelled,\n"
        "9 not all models of a batch are done, 10 --max-bytes exceeded, 11 not enough memory.");
}

}  // namespace faqem::cli

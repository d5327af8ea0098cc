#include <CLI/CLI.hpp>
#include <fstream>
#include <iostream>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "asset/io/recovery.hpp"
#include "bake/scene/parts_from_histories.hpp"
#include "cli/commands/commands.hpp"
#include "cli/exit_code.hpp"
#include "cli/interrupt.hpp"
#include "cli/options/common_options.hpp"
#include "cli/options/simplify_options.hpp"
#include "cli/output_file.hpp"
#include "cli/protected_files.hpp"
#include "faqem/bake.hpp"
#include "faqem/error.hpp"
#include "faqem/truncate.hpp"

namespace faqem::cli {

namespace {

struct TruncateArguments : SimplifyArguments {
    std::string history, out, source;
    bool force = false, quiet = false;

    Overwrite overwrite() const { return force ? Overwrite::yes : Overwrite::no; }
};

std::vector<ChainHistory> read_histories(const std::string& file) {
    detail::check_completely_replaced(file);
    std::ifstream in(file, std::ios::binary);
    if (!in) throw ReadError(file, "", "cannot open the file");
    std::vector<ChainHistory> histories;
    try {
        do histories.push_back(read_chain_history(in));
        while (in.peek() != std::ifstream::traits_type::eof());
    } catch (const InputError& error) {
        throw InputError(file, "", error.what());
    }
    return histories;
}

/// Creates an asset from the histories alone: parts without names, materials or scene graph.
Asset geometry_only(const SimplifiedParts& simplified_parts) {
    Asset original;
    for (const SimplifyResult& one : simplified_parts.parts) {
        Part& part = original.parts.emplace_back();
        part.positions = one.history.positions;
        part.triangles = one.history.triangles;
        part.face_material.assign(part.triangles.size(), no_index);
        for (Triangle& t : part.triangles) {
            if (t[0] == no_index) t = {0, 0, 0};  // dropped during preprocessing
        }
    }
    Options geometry_options;
    geometry_options.bake.kind = Bake::none;
    geometry_options.bake.normals = Normals::none;
    return bake(original, simplified_parts, geometry_options).asset;
}

Asset baked_model(const TruncateArguments& arguments, const SimplifiedParts& simplified_parts,
                  const Options& options) {
    const Asset source = load_model(arguments.source, arguments.strictness());
    Options bake_options = options;
    bake_options.bake = resolve_automatic_bake(options.bake, source, arguments.out);
    return with_file_in_errors(arguments.source, [&] {
        detail::check_source_matches_histories(source, simplified_parts);
        return bake(source, simplified_parts, bake_options).asset;
    });
}

int run(const TruncateArguments& arguments) {
    const Options options = make_options(arguments);
    if (options.bake.kind == Bake::keep)
        throw OptionError("--bake keep: cannot be used, because a history does not contain UVs");
    check_extension(arguments.out, {".glb", ".gltf", ".obj", ".ply", ".stl"});
    protect_input(arguments.history);
    if (!arguments.source.empty()) protect_input(arguments.source);
    check_output(arguments.out, arguments.overwrite());
    install_signal_handlers();
    const ExitOnInterrupt exit_on_interrupt;
    const SimplifiedParts simplified_parts =
        detail::parts_from_histories(truncate_to_faces(read_histories(arguments.history), arguments.faces));
    if (simplified_parts.report.faces_out > arguments.faces) {
        std::cerr << "faqem: target missed: " << arguments.history << " ends with "
                  << simplified_parts.report.faces_out << " faces, the target is " << arguments.faces << "; "
                  << arguments.out << " was not written\n";
        return exit_target_missed;
    }
    const ExitCode rejection = rejection_code(simplified_parts.report, false);
    if (rejection != exit_ok) {
        std::cerr << "faqem: "
                  << rejection_message(rejection, arguments.history, arguments.out, simplified_parts.report)
                  << "\n";
        return rejection;
    }
    const Asset asset = arguments.source.empty() ? geometry_only(simplified_parts)
                                                 : baked_model(arguments, simplified_parts, options);
    detail::FileSet set;
    std::vector<std::string> save_warnings;
    {
        const detail::CollectWrites collect(set);
        save_warnings = save(asset, arguments.out, arguments.overwrite());
    }
    commit_outputs(set);
    if (arguments.quiet) return exit_ok;
    std::cout << arguments.history << " -> " << arguments.out << "\n"
              << simplified_parts.report.faces_in << " -> " << simplified_parts.report.faces_out
              << " faces\n";
    for (const std::string& loss : save_warnings) std::cout << "  " << loss << "\n";
    return exit_ok;
}

}  // namespace

void add_truncate_command(CLI::App& app, Action& action) {
    const auto arguments = std::make_shared<TruncateArguments>();
    CLI::App* command =
        app.add_subcommand("truncate", "Extract a level of detail from a stored history without another run");
    command->add_option("HISTORY", arguments->history, "File written by simplify --history or lod --history")
        ->required();
    command->add_option("OUT", arguments->out, ".glb, .gltf, .obj, .ply or .stl")->required();
    command->add_option("--faces", arguments->faces, "Maximum number of faces")
        ->required()
        ->check(positive_number());
    command->add_option("--source", arguments->source,
                        "The original model, from which the appearance is baked with the options below. "
                        "Without it: geometry only");
    add_bake_options(*command, *arguments);
    command
        ->add_option("--threads", arguments->options.threads, "Maximum number of threads; 0: all (default)")
        ->check(CLI::Range(0, 1024));
    command->add_flag("--force", arguments->force, "Overwrite an existing file");
    command->add_flag("--quiet", arguments->quiet, "Print no summary");
    command->final_callback([arguments, &action] { action = [arguments] { return run(*arguments); }; });
}

}  // namespace faqem::cli

#include <CLI/CLI.hpp>
#include <fstream>
#include <iostream>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "bake/scene/parts_from_histories.hpp"
#include "faqem/bake.hpp"
#include "faqem/cut.hpp"
#include "faqem/error.hpp"
#include "cli/commands/commands.hpp"
#include "cli/exit_code.hpp"
#include "cli/output_file.hpp"
#include "cli/options/positive.hpp"
#include "cli/options/simplify_options.hpp"

namespace faqem::tool {

namespace {

struct Arguments : SimplifyArguments {
    std::string history, out, source;
    bool force = false, quiet = false;

    Overwrite overwrite() const { return force ? Overwrite::yes : Overwrite::no; }
};

std::vector<ChainHistory> read_histories(const std::string& file) {
    std::ifstream in(file, std::ios::binary);
    if (!in) throw ReadError(file, "", "cannot be read");
    std::vector<ChainHistory> histories;
    try {
        do histories.push_back(read_chain_history(in));
        while (in.peek() != std::ifstream::traits_type::eof());
    } catch (const InputError& error) {
        throw InputError(file, "", error.what());
    }
    return histories;
}

/// All that a history holds: parts without name, material or place in a scene.
Asset geometry(const SmallParts& small) {
    Asset original;
    for (const SimplifyResult& one : small.parts) {
        Part& part = original.parts.emplace_back();
        part.positions = one.history.positions;
        part.triangles = one.history.triangles;
        part.face_material.assign(part.triangles.size(), no_index);
        for (Triangle& t : part.triangles) {
            if (t[0] == no_index) t = {0, 0, 0};  // dropped before the run
        }
    }
    Options bare;
    bare.bake.kind = Bake::none;
    bare.bake.normals = Normals::none;
    return bake(original, small, bare).asset;
}

Asset with_look(const Arguments& arguments, const SmallParts& small, const Options& options) {
    const Asset source = load_model(arguments.source, arguments.strictness());
    Options as_baked = options;
    as_baked.bake = bake_for(options.bake, source, arguments.out);
    return naming(arguments.source, [&] {
        detail::check_source(source, small);
        return bake(source, small, as_baked).asset;
    });
}

int run(const Arguments& arguments) {
    const Options options = make_options(arguments);
    if (options.bake.kind == Bake::keep)
        throw OptionError("--bake keep: a history does not hold the UVs that were kept");
    check_ending(arguments.out, {".glb", ".gltf", ".obj", ".ply", ".stl"});
    std::vector<std::filesystem::path> inputs = {arguments.history};
    if (!arguments.source.empty()) inputs.emplace_back(arguments.source);
    check_output(arguments.out, inputs, arguments.overwrite());
    const SmallParts small = detail::restored(cut_to(read_histories(arguments.history), arguments.faces));
    if (small.report.faces_out > arguments.faces) {
        std::cerr << "faqem: target missed: " << arguments.history << " ends with " << small.report.faces_out
                  << " faces, " << arguments.faces << " wanted; " << arguments.out << " was not written\n";
        return exit_target_missed;
    }
    const Asset asset = arguments.source.empty() ? geometry(small) : with_look(arguments, small, options);
    const std::vector<std::string> losses = save(asset, arguments.out, arguments.overwrite());
    if (arguments.quiet) return exit_ok;
    std::cout << arguments.history << " -> " << arguments.out << "\n"
              << small.report.faces_in << " -> " << small.report.faces_out << " faces\n";
    for (const std::string& loss : losses) std::cout << "  " << loss << "\n";
    return exit_ok;
}

}  // namespace

void add_cut_command(CLI::App& app, Action& action) {
    const auto arguments = std::make_shared<Arguments>();
    CLI::App* command =
        app.add_subcommand("cut", "Make a level of detail from a stored history, without another run");
    command->add_option("HISTORY", arguments->history, "File of simplify --history or lod --history")
        ->required();
    command->add_option("OUT", arguments->out, ".glb, .gltf, .obj, .ply or .stl")->required();
    command->add_option("--faces", arguments->faces, "Number of faces to keep")
        ->required()
        ->check(positive());
    command->add_option("--source", arguments->source,
                        "The model that was simplified: gives the result its look, with the options below. "
                        "Without it: geometry alone");
    add_look_options(*command, *arguments);
    command->add_option("--threads", arguments->options.threads, "Threads at most")
        ->check(CLI::Range(0, 1024));
    command->add_flag("--force", arguments->force, "Replace a file that exists");
    command->add_flag("--quiet", arguments->quiet, "No summary");
    command->final_callback([arguments, &action] { action = [arguments] { return run(*arguments); }; });
}

}  // namespace faqem::tool

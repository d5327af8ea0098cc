#include <fstream>
#include <iostream>
#include <memory>
#include <string>

#include "asset/file_format.hpp"
#include "asset/io/set_folder.hpp"
#include "cli/commands/commands.hpp"
#include "cli/files/output_file.hpp"
#include "cli/options/bound_options.hpp"
#include "cli/options/simplify_options.hpp"
#include "cli/process/exit_code.hpp"
#include "cli/process/interrupt.hpp"
#include "cli/process/rejection.hpp"
#include "faqem/bake.hpp"
#include "faqem/error.hpp"
#include "faqem/truncate.hpp"
#include "result/simplify_file.hpp"
#include "scene/parts/parts_from_histories.hpp"

namespace faqem::cli {

namespace {

struct TruncateArguments : SimplifyArguments {
    std::string history, out, source;
    std::uint64_t faces = 0;
    bool force = false, quiet = false;
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
SimplifiedAsset geometry_only(const SimplifiedParts& simplified_parts) {
    Asset original;
    for (const SimplifyResult& one : simplified_parts.parts) {
        Part& part = original.parts.emplace_back();
        part.positions = one.history.positions;
        part.triangles = one.history.triangles;
        part.face_material.assign(part.triangles.size(), no_index);
        for (Triangle& t : part.triangles)
            if (t[0] == no_index) t = {0, 0, 0};  // dropped during preprocessing
    }
    return bake(original, simplified_parts, {.bake = {.kind = Bake::none, .normals = Normals::none}});
}

/// Bakes the original model.
SimplifiedAsset baked_model(const TruncateArguments& arguments, const SimplifiedParts& simplified_parts,
                            const Options& options) {
    const Asset source = load_model(arguments.source, arguments.strictness());
    return detail::with_file_in_errors(arguments.source, [&] {
        detail::check_source_matches_histories(source, simplified_parts);
        return bake(source, simplified_parts, options);
    });
}

int run(const TruncateArguments& arguments) {
    Options options = make_options(arguments.options);
    options.format = format_of_output(arguments.out);
    if (options.bake.kind == Bake::keep)
        throw OptionError("--bake keep: cannot be used, because a history does not contain UVs");
    if (arguments.strict && arguments.source.empty()) throw OptionError("--strict: requires --source");
    if (options.max_bytes && arguments.source.empty()) throw OptionError("--max-bytes: requires --source");
    check_extension(arguments.out, detail::format_extensions(detail::FormatUse::write));
    const Overwrite overwrite =
        prepare_files({arguments.history, arguments.source}, {arguments.out}, arguments.force);
    const ExitOnInterrupt exit_on_interrupt;
    SimplifiedParts simplified_parts =
        detail::parts_from_histories(truncate_to_faces(read_histories(arguments.history), arguments.faces));
    simplified_parts.report.target_faces = arguments.faces;
    require_accepted(simplified_parts.report, true, arguments.history, arguments.out);
    const SimplifiedAsset result = arguments.source.empty()
                                       ? geometry_only(simplified_parts)
                                       : baked_model(arguments, simplified_parts, options);
    std::vector<std::string> warnings = result.report.warnings;
    if (arguments.source.empty()) options.bake.kind = Bake::none;
    append(warnings, detail::idle_options(options, typed_names(arguments.options), detail::command_spelling));
    write_together([&] { append(warnings, save(result.asset, arguments.out, overwrite)); });
    if (arguments.quiet) return exit_ok;
    std::cout << arguments.history << " -> " << arguments.out << "\n"
              << simplified_parts.report.faces_in << " -> " << simplified_parts.report.faces_out << " faces\n"
              << warnings_text(warnings);
    return exit_ok;
}

}  // namespace

CommandInfo truncate_command() {
    const auto arguments = std::make_shared<TruncateArguments>();
    CommandInfo command{"truncate",
                        "Extract a level of detail from a stored history",
                        {"faqem truncate statue.history small.glb --faces 5000 --source statue.glb"}};
    command.positionals = {
        positional("HISTORY", arguments->history, "File written by simplify --history or lod --history")};
    add_output(command, "OUT", arguments->out, detail::listed_extensions(detail::FormatUse::write));
    OptionInfo faces = number_option("--faces", "N", arguments->faces, from_one(), "Maximum number of faces");
    faces.is_required = true;
    append(command.options, {faces, text_option("--source", "FILE", arguments->source,
                                                "The original model, for the appearance; without it: "
                                                "geometry only. The options of baking are about it")});
    append(command.options, table_options(detail::in_truncate, arguments->options));
    append(command.options, {strict_option(arguments->strict), force_option(arguments->force),
                             quiet_option(arguments->quiet)});
    command.run = [arguments] { return run(*arguments); };
    return command;
}

}  // namespace faqem::cli

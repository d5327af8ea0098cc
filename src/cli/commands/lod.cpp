#include <algorithm>
#include <iostream>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <variant>

#include "asset/file_format.hpp"
#include "asset/io/encoded_model.hpp"
#include "cli/commands/commands.hpp"
#include "cli/commands/lod_levels.hpp"
#include "cli/files/output_file.hpp"
#include "cli/files/protected_files.hpp"
#include "cli/options/bound_options.hpp"
#include "cli/options/profile.hpp"
#include "cli/options/simplify_options.hpp"
#include "cli/process/exit_code.hpp"
#include "cli/process/interrupt.hpp"
#include "cli/process/progress_bar.hpp"
#include "cli/process/rejection.hpp"
#include "cli/process/shown_text.hpp"
#include "faqem/bake_levels.hpp"
#include "faqem/error.hpp"
#include "faqem/save_levels.hpp"
#include "faqem/truncate.hpp"
#include "result/simplify.hpp"
#include "result/simplify_file.hpp"
#include "scene/resolved_options.hpp"
#include "scene/scene_size.hpp"
#include "scene/touching_parts.hpp"

namespace faqem::cli {

namespace {

namespace fs = std::filesystem;

struct LodArguments : SimplifyArguments {
    std::string in, out, history, format, textures = "each";
    std::vector<std::string> levels = {"0.5", "0.25", "0.1", "0.01"};
    ViewSettings view_settings;
    bool without_original = false, force = false, quiet = false;
    Overwrite overwrite = Overwrite::no;  ///< after prepare_outputs()

    bool has_shared_textures() const { return textures == "shared"; }
};

/// Paths of the output files: a model for each level, the original first unless --without-original is given,
/// and the manifest. If the output is a file, the paths of all levels are equal.
struct Outputs {
    explicit Outputs(const LodArguments& a) : is_file(detail::format_by_name(a.out) != nullptr) {
        const std::size_t count = a.levels.size() + (a.without_original ? 0 : 1);
        if (is_file) {
            if (!detail::format_by_name(a.out)->encode_levels)
                throw OptionError(a.out + ": a file of all levels must end in " +
                                  detail::listed_extensions(detail::FormatUse::write_levels) +
                                  "; a name without the ending of a model is a directory");
            if (!a.format.empty()) throw OptionError("--format: " + a.out + " determines the format");
            models.assign(count, a.out);
            manifest = fs::path(a.out).replace_extension(".json");
            return;
        }
        const std::string extension = "." + (a.format.empty() ? default_format() : a.format);
        const std::string stem = (fs::path(a.out) / fs::path(a.in).stem()).string() + "_LOD";
        for (std::size_t i = 0; i < count; ++i) models.push_back(stem + std::to_string(i) + extension);
        manifest = stem + ".json";
    }

    bool is_file;
    std::vector<fs::path> models;
    fs::path manifest;
};

/// Removes in the end the directories of a path that did not exist before and are still empty.
struct NewFolders {
    explicit NewFolders(fs::path folder) {
        for (; !folder.empty() && !fs::exists(folder); folder = folder.parent_path())
            created.push_back(folder);
    }
    ~NewFolders() {
        std::error_code error;
        for (const fs::path& folder : created) fs::remove(folder, error);
    }

    std::vector<fs::path> created;
};

/// Checks all output files and creates their folder.
Overwrite prepare_outputs(const LodArguments& a, const Outputs& outputs) {
    protect_input(a.in);
    check_models_unprotected(outputs.models);
    std::vector<fs::path> files = {outputs.manifest, a.history};
    files.insert(files.end(), outputs.models.begin(),
                 outputs.is_file ? outputs.models.begin() + 1 : outputs.models.end());
    if (!outputs.is_file) make_folder(a.out);
    return prepare_files({}, std::move(files), a.force);
}

/// Writes the histories of all parts one after the other, each with all levels.
void write_histories(const LodArguments& a, const std::vector<SimplifiedPartsLevel>& levels) {
    std::ostringstream out;
    for (std::size_t p = 0; p < levels.front().result.parts.size(); ++p) {
        std::vector<CollapseHistory> histories;
        histories.reserve(levels.size());
        for (const SimplifiedPartsLevel& level : levels) histories.push_back(level.result.parts[p].history);
        write(join(histories), out);
    }
    write_output(a.history, out.view(), a.overwrite);
}

/// \param bytes_in  of the input
/// \param warnings  of the manifest; those of the levels follow, and equal ones are printed once
void print_summary(const LodArguments& a, const Outputs& outputs, std::uint64_t bytes_in,
                   const std::vector<WrittenLevel>& levels, std::vector<std::string> warnings) {
    std::uint64_t bytes = outputs.is_file ? fs::file_size(a.out) : 0;
    for (const WrittenLevel& level : levels) bytes += level.bytes;
    std::ostringstream out;
    out << a.in << " -> " << a.out << "\n"
        << shown_bytes(bytes_in) << " -> " << shown_bytes(bytes) << ", with " << outputs.manifest.string()
        << "\n";
    for (const WrittenLevel& level : levels) {
        out << "  " << level.file << ": " << level.faces << " faces, "
            << (outputs.is_file ? "" : shown_bytes(level.bytes) + ", ") << "error " << level.error
            << ", from distance " << switch_distance(level.error, a.view_settings) << "\n";
        if (!level.report) continue;
        for (const std::string& warning : level.report->warnings)
            if (std::ranges::find(warnings, warning) == warnings.end()) warnings.push_back(warning);
    }
    out << warnings_text(warnings);
    std::cout << out.str();
}

/// Creates the levels and writes each one under temporary names when it is ready, or all levels of one file
/// at the end. All files of the folder get their names together, after the last one is written.
struct LodWriter {
    const LodArguments& arguments;
    const Outputs& outputs;
    const Asset& source;
    const std::vector<Level>& wanted;
    const Options& options;
    std::vector<std::string> warnings = {};
    std::vector<WrittenLevel> written = {};
    std::vector<SavedLevel> one_file_levels = {};  ///< of a file of all levels
    detail::SceneSize size = {};
    detail::FileSet set = {};

    void write_all() {
        size = detail::scene_size(source);
        warnings = source.warnings;
        append(warnings, detail::idle_options(source, options, typed_names(arguments.options),
                                              detail::command_spelling));
        const auto* first = std::get_if<Target>(&wanted.front());
        if (first && first->kind == Target::Kind::faces && first->value <= 100)
            warnings.push_back("the first level has " + arguments.levels.front() +
                               " faces; a share has a percent sign: " + arguments.levels.front() + "%");
        if (arguments.has_shared_textures())
            write_with_shared_texture();
        else
            write_with_separate_textures();
        {
            const ExitOnInterrupt exit_on_interrupt;
            const detail::CollectWrites collect(set);
            if (outputs.is_file)
                append(warnings,
                       save_levels(std::move(one_file_levels), outputs.models[0], arguments.overwrite));
            Json manifest = lod_manifest(arguments.in, size.diagonal, arguments.view_settings, written);
            manifest["warnings"] = warnings;
            write_output(outputs.manifest, json_text(manifest), arguments.overwrite);
        }
        commit_outputs(set);
    }

    /// Bakes and writes one level at a time, so that only the images of one level are in memory.
    void write_with_separate_textures() {
        std::optional<Asset> joined;
        if (arguments.history.empty()) joined = detail::join_touching_parts(source, wanted, options);
        const Asset& given = joined ? *joined : source;
        std::vector<SimplifiedPartsLevel> levels = detail::with_file_in_errors(
            arguments.in, [&] { return simplify_parts_levels(given, wanted, options); });
        check_reports(levels);
        if (!arguments.history.empty()) {
            const ExitOnInterrupt exit_on_interrupt;
            const detail::CollectWrites collect(set);
            write_histories(arguments, levels);
        }
        write_original();
        detail::with_file_in_errors(arguments.in, [&] { bake_levels(given, std::move(levels)); });
    }

    void bake_levels(const Asset& given, std::vector<SimplifiedPartsLevel> levels) try {
        detail::bake_levels(given, std::move(levels), options, [&](SimplifiedAssetLevel level) {
            require_not_cancelled(level.result.report);
            write_level(std::move(level.result), level.distance, level.error);
            return Continue::yes;
        });
    } catch (const ByteLimitError& error) {
        throw ByteLimitError(outputs.models[written.size()].string() + ": " + error.what());
    }

    void write_with_shared_texture() {
        std::vector<SimplifiedAssetLevel> levels = detail::with_file_in_errors(
            arguments.in, [&] { return simplify_levels(source, wanted, options, LevelTextures::shared); });
        check_reports(levels);
        write_original();
        for (SimplifiedAssetLevel& level : levels)
            write_level(std::move(level.result), level.distance, level.error);
    }

    /// \throws CommandError  the levels must not be written
    template <class LevelResult>
    void check_reports(const std::vector<LevelResult>& levels) {
        require_not_cancelled(levels.back().result.report);
        for (const LevelResult& level : levels)
            require_accepted(level.result.report, arguments.strict_target, arguments.in, arguments.out);
    }

    void write_original() {
        if (!arguments.without_original) append(warnings, write(Asset(source), 0, 0));
    }

    void write_level(SimplifiedAsset simplified, double distance, double error) {
        append(simplified.report.warnings, write(std::move(simplified.asset), distance, error));
        written.back().report = std::move(simplified.report);
    }

    /// Saves one level, or stores it for the file of all. \return warnings about data that the format cannot store
    std::vector<std::string> write(Asset&& asset, double distance, double error) {
        const ExitOnInterrupt exit_on_interrupt;
        const detail::CollectWrites collect(set);
        const fs::path& file = outputs.models[written.size()];
        WrittenLevel& level = written.emplace_back();
        level = {.file = file.filename().string(), .distance = distance, .error = error, .report = {}};
        for (const Part& part : asset.parts) {
            level.faces += part.triangles.size();
            level.vertices += part.positions.size();
        }
        if (outputs.is_file) {
            const ViewSettings& view = arguments.view_settings;
            const double screen_error = view.pixel_error / view.screen_height;
            one_file_levels.push_back(
                {std::move(asset), detail::level_coverage(source, size, error, screen_error)});
            return {};
        }
        detail::EncodedModel model = detail::encode_model(asset, file);
        detail::write_model(model, file.parent_path(), arguments.overwrite);
        level.bytes = model.bytes();
        return std::move(model.losses);
    }
};

int run(LodArguments arguments) {
    Options options = make_options(arguments.options);
    std::vector<Level> levels;
    for (const std::string& text : arguments.levels)
        levels.push_back(parse_level(text, arguments.view_settings));
    const Outputs outputs(arguments);
    if (options.max_bytes && outputs.is_file)
        throw OptionError("--max-bytes: cannot be used with one file of all levels");
    if (arguments.has_shared_textures() && !arguments.history.empty())
        throw OptionError(
            "--history: cannot be used with --textures shared, whose levels are no run of one mesh");
    options.format = format_of_output(outputs.models[0]);
    const NewFolders folders(outputs.is_file ? "" : arguments.out);
    arguments.overwrite = prepare_outputs(arguments, outputs);
    Asset source;
    LodWriter writer{arguments, outputs, source, levels, options};
    {
        ProgressBar bar(arguments.quiet ? Bar::hidden : Bar::shown);
        options.progress = bar.callback();
        source = load_model(arguments.in, arguments.strictness());
        writer.write_all();
    }
    if (!arguments.quiet)
        print_summary(arguments, outputs, source.file_bytes, writer.written, writer.warnings);
    return exit_ok;
}

/// The options that only this command has.
std::vector<OptionInfo> chain_options(LodArguments& a) {
    return {list_option("--levels", a.levels,
                        "Comma-separated, from fine to coarse; 0.5 or 50% (ratio of faces), 5000 (number of "
                        "faces), error:0.01 (distance in model units), error:0.1% (of the diagonal) or "
                        "pixels:1@50 (the size of 1 pixel at distance 50) (default 0.5,0.25,0.1,0.01)"),
            flag_option("--without-original", a.without_original,
                        "LOD0 is the first level instead of the original"),
            text_option("--textures", "each|shared", a.textures,
                        "New textures; each (one for every level; default), shared (one for all levels, "
                        "baked for the finest)"),
            format_option(a.format),
            text_option("--history", "FILE", a.history,
                        "Write the history of all levels to this file; for faqem truncate"),
            rare(number_option("--pixel-error", "N", a.view_settings.pixel_error, {.excludes_min = true},
                               "Allowed error in pixels, for switch distances (default 1)")),
            rare(number_option("--fov", "ANGLE", a.view_settings.fov, {.min = 1, .max = 179},
                               "Vertical field of view in degrees, for switch distances (default 60)")),
            rare(number_option("--screen-height", "N", a.view_settings.screen_height, from_one(1 << 20),
                               "Screen height in pixels, for switch distances (default 1080)"))};
}

}  // namespace

CommandInfo lod_command() {
    const auto arguments = std::make_shared<LodArguments>();
    CommandInfo command{
        "lod",
        "Create levels of detail with textures and measured errors",
        {"faqem lod statue.glb out --levels 50%,25%,10%,1%", "faqem lod statue.glb levels.glb",
         "faqem lod scan.ply out --levels error:0.1%,error:2% --format ply"}};
    command.positionals = {
        positional("IN", arguments->in, detail::listed_extensions(detail::FormatUse::read))};
    add_output(command, "OUT", arguments->out,
               "Directory for NAME_LOD0 ... and NAME_LOD.json, or a file for all levels: " +
                   detail::listed_extensions(detail::FormatUse::write_levels));
    append(command.options, chain_options(*arguments));
    append(command.options, table_options(detail::in_lod, arguments->options));
    append(command.options, strict_options(arguments->strict, arguments->strict_target));
    append(command.options, {profile_option(), builtin_profile_option(), force_option(arguments->force),
                             quiet_option(arguments->quiet)});
    command.run = [arguments] { return run(*arguments); };
    return command;
}

}  // namespace faqem::cli

#include <algorithm>
#include <cstdint>
#include <iomanip>
#include <iostream>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <utility>

#include "asset/file_format.hpp"
#include "asset/io/encoded_model.hpp"
#include "cli/commands/commands.hpp"
#include "cli/files/output_file.hpp"
#include "cli/memory/memory_limit.hpp"
#include "cli/options/bound_options.hpp"
#include "cli/options/profile.hpp"
#include "cli/options/simplify_options.hpp"
#include "cli/process/exit_code.hpp"
#include "cli/process/interrupt.hpp"
#include "cli/process/progress_bar.hpp"
#include "cli/process/rejection.hpp"
#include "cli/process/shown_text.hpp"
#include "faqem/bake.hpp"
#include "faqem/detail/base/parallel.hpp"
#include "faqem/detail/base/stopwatch.hpp"
#include "faqem/error.hpp"
#include "faqem/report_json.hpp"
#include "result/memory_estimate.hpp"
#include "result/simplify_file.hpp"
#include "scene/resolved_options.hpp"
#include "scene/scene_size.hpp"

namespace faqem::cli {

namespace {

/// The parsed command line.
struct SimplifyCommandArguments : SimplifyArguments {
    std::string in, out, report, history, correspondence;
    std::uint64_t max_memory = 0;  ///< bytes; 0: machine_memory()
    bool force = false, quiet = false;
    Overwrite overwrite = Overwrite::no;  ///< after prepare_files()
};

/// Why few bytes are saved, in one line.
void print_little_saved(std::ostream& out, const LittleSaved& saved) {
    out << "little saved: " << saved.reason;
    for (const std::string& option : saved.options)
        out << (option == saved.options.front() ? "; less with --" : " or --") << option;
    out << "\n";
}

/// Prints the sizes of the files, and what they hold.
void print_bytes(std::ostream& out, const Report& report) {
    std::uint64_t images = 0;
    for (const ResultImage& image : report.images) images += image.bytes;
    images = std::min(images, report.bytes_out);
    std::uint64_t geometry = report.buffer_views.empty() ? report.bytes_out - images : 0, animation = 0;
    for (const ResultView& view : report.buffer_views)
        (detail::is_animation(view) ? animation : geometry) += view.bytes;
    out << shown_bytes(report.bytes_in) << " -> " << shown_bytes(report.bytes_out) << " (geometry "
        << shown_bytes(geometry) << ", images " << shown_bytes(images);
    if (animation > 0) out << ", animation " << shown_bytes(animation);
    out << ")\n";
}

/// \param diagonal  of the input, scene units
void print_summary(const SimplifyCommandArguments& arguments, const Report& report, double diagonal) {
    std::string asked;
    for (const GivenOption& option : arguments.options)
        if (option.row->group == "Target")
            asked.append(command_spelling(*option.row)).append(" ").append(option.value).append(", ");
    if (asked.empty()) asked = "--ratio 10% by default, ";
    std::ostringstream out;
    out << arguments.in << " -> " << (report.bytes_out > 0 ? arguments.out : "no file") << "\n"
        << report.faces_in << " -> " << report.faces_out << " faces (" << asked << name(report.stop) << ")\n";
    if (report.bytes_out > 0) print_bytes(out, report);
    if (report.little_saved) print_little_saved(out, *report.little_saved);
    if (report.max_error) {
        const MeasuredError& error = *report.max_error;
        out << "distance: at most " << error.bound << " (allowed " << error.allowed << "), "
            << shown_percent(error.bound / diagonal) << " of the diagonal"
            << shown_in_pixels(error.bound, diagonal) << "\n";
    }
    const auto print_meshes = [&](const char* what, std::size_t count) {
        if (count > 0) out << what << ": " << count << (count == 1 ? " mesh\n" : " meshes\n");
    };
    print_meshes("left as they are", report.untouched_parts.size());
    print_meshes("with the UVs of the source", report.kept_uvs.size());
    out << warnings_text(report.warnings);
    const PhaseSeconds& s = report.seconds;
    out << std::fixed << std::setprecision(2) << "seconds: load " << s.load << ", simplify " << s.simplify
        << ", map " << s.map << ", bake " << s.bake << ", save " << s.save << ", total " << s.total << "\n";
    std::cout << out.str();
}

/// Writes the model, the history and the correspondence. The model is first: save() rejects
/// names of images that would overwrite files of the input. The report is written later, because it has the
/// time that saving took.
void save_files(const SimplifyCommandArguments& arguments, const Options& options,
                SimplifiedAsset& simplified) {
    detail::save_result(simplified, arguments.out, options, arguments.overwrite);
    if (!arguments.history.empty()) {
        std::ostringstream out;
        for (const CollapseHistory& history : simplified.histories) write(history, out);
        write_output(arguments.history, out.view(), arguments.overwrite);
    }
    if (!arguments.correspondence.empty()) {
        std::ostringstream out;
        write(simplified.correspondence, out);
        write_output(arguments.correspondence, out.view(), arguments.overwrite);
    }
}

/// Loads and simplifies the model if the memory is enough. \param diagonal  receives that of the input, scene units
SimplifiedAsset simplified_model(const SimplifyCommandArguments& arguments, const Options& options,
                                 double& diagonal) {
    const std::uint64_t allowed = arguments.max_memory > 0 ? arguments.max_memory : machine_memory();
    const std::uint64_t used = process_memory();
    require_memory(arguments.in,
                   used + detail::estimated_model_memory(arguments.in, allowed - std::min(allowed, used)),
                   allowed);
#ifndef _WIN32
    // Image libraries start a thread per hardware thread, besides those of --threads.
    limit_process_memory(allowed, detail::thread_count(options.threads) + detail::thread_count(0));
#endif
    std::optional<ExitOnInterrupt> exit_on_interrupt(std::in_place);  // load() cannot be cancelled
    std::vector<std::string> idle;
    SimplifiedAsset result = detail::simplify_file(arguments.in, options, [&](const Asset& source) {
        exit_on_interrupt.reset();
        idle =
            detail::idle_options(source, options, typed_names(arguments.options), detail::command_spelling);
        diagonal = detail::scene_size(source).diagonal;
        check_strictness(source, arguments.in, arguments.strictness());
        require_memory(arguments.in, process_memory() + detail::estimated_simplify_memory(source, options),
                       allowed);
    });
    append(result.report.warnings, std::move(idle));
    return result;
}

int run(SimplifyCommandArguments arguments) {
    Options options = make_options(arguments.options);
    options.format = format_of_output(arguments.out);
    if (!arguments.history.empty()) options.history = Recording::on;
    if (!arguments.correspondence.empty()) {
        if (!makes_atlas(options.bake.kind))
            throw OptionError("--correspondence: requires --bake auto, atlas or per-triangle");
        options.bake.correspondence = Recording::on;
    }
    check_extension(arguments.out, detail::format_extensions(detail::FormatUse::write));
    arguments.overwrite = prepare_files(
        {arguments.in}, {arguments.out, arguments.report, arguments.history, arguments.correspondence},
        arguments.force);
    const detail::Stopwatch watch;
    SimplifiedAsset simplified;
    double diagonal = 0;
    {
        ProgressBar bar(arguments.quiet ? Bar::hidden : Bar::shown);
        options.progress = bar.callback();
        simplified = simplified_model(arguments, options, diagonal);
        require_not_cancelled(simplified.report);
    }
    const auto rejected = rejection(simplified.report, arguments.strict_target, arguments.in, arguments.out);
    write_together([&] {
        if (!rejected) save_files(arguments, options, simplified);
        simplified.report.seconds.total = watch.seconds();
        if (!arguments.report.empty())
            write_output(arguments.report, to_json(simplified.report), arguments.overwrite);
    });
    if (!arguments.quiet) print_summary(arguments, simplified.report, diagonal);
    if (rejected) throw *rejected;
    return exit_ok;
}

}  // namespace

CommandInfo simplify_command() {
    const auto arguments = std::make_shared<SimplifyCommandArguments>();
    CommandInfo command{"simplify",
                        "Simplify a model and bake its appearance into a texture",
                        {"faqem simplify model.glb simplified.glb --ratio 0.05",
                         "faqem simplify scan.ply simplified.ply --faces 20000 --bake vertex",
                         "faqem simplify part.stl simplified.stl --max-error 0.05",
                         "faqem simplify model.glb web.glb --max-bytes 2MB"}};
    command.positionals = {
        positional("IN", arguments->in, detail::listed_extensions(detail::FormatUse::read))};
    add_output(command, "OUT", arguments->out, detail::listed_extensions(detail::FormatUse::write));
    append(command.options, table_options(detail::in_simplify, arguments->options));
    append(command.options, strict_options(arguments->strict, arguments->strict_target));
    append(
        command.options,
        {rare(size_option("--max-memory", arguments->max_memory,
                          "Use at most this memory, as 8GB or 500MB; or end with code 11 (default: the "
                          "machine's memory)")),
         report_option(arguments->report),
         rare(
             text_option("--history", "FILE", arguments->history, "Write the collapse history to this file")),
         rare(text_option("--correspondence", "FILE", arguments->correspondence,
                          "Write the position of each texel of the new atlas on the original to this file")),
         profile_option(), builtin_profile_option(), force_option(arguments->force),
         quiet_option(arguments->quiet)});
    command.run = [arguments] { return run(*arguments); };
    return command;
}

}  // namespace faqem::cli

#include "faqem/bake_onto.hpp"

#include <algorithm>
#include <array>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "asset/file_format.hpp"
#include "cli/commands/commands.hpp"
#include "cli/files/output_file.hpp"
#include "cli/options/bound_options.hpp"
#include "cli/options/simplify_options.hpp"
#include "cli/process/exit_code.hpp"
#include "cli/process/interrupt.hpp"
#include "cli/process/progress_bar.hpp"
#include "cli/process/rejection.hpp"
#include "cli/process/shown_text.hpp"
#include "faqem/detail/base/stopwatch.hpp"
#include "faqem/error.hpp"
#include "faqem/report_json.hpp"
#include "result/simplify_file.hpp"
#include "scene/resolved_options.hpp"

namespace faqem::cli {

namespace {

struct BakeArguments : SimplifyArguments {
    std::string target, out, source, max_distance, uvs, report;
    bool force = false, quiet = false;
};

int run(const BakeArguments& arguments) {
    Options options = make_options(arguments.options);
    if (!makes_atlas(options.bake.kind))
        throw OptionError(
            "--bake: must be auto, atlas or per-triangle, because another mesh gets new textures");
    options.format = format_of_output(arguments.out);
    const OntoOptions onto = onto_options(arguments.uvs, arguments.max_distance);
    check_extension(arguments.out, detail::format_extensions(detail::FormatUse::write_textures));
    const Overwrite overwrite = prepare_files({arguments.target, arguments.source},
                                              {arguments.out, arguments.report}, arguments.force);
    const detail::Stopwatch watch;
    SimplifiedAsset baked;
    {
        ProgressBar bar(arguments.quiet ? Bar::hidden : Bar::shown);
        options.progress = bar.callback();
        std::optional<ExitOnInterrupt> exit_on_interrupt(std::in_place);  // load() cannot be cancelled
        const Asset source = load_model(arguments.source, arguments.strictness()),
                    target = load_model(arguments.target, arguments.strictness());
        exit_on_interrupt.reset();
        const double loaded = watch.seconds();
        baked = detail::with_file_in_errors(arguments.source + " onto " + arguments.target,
                                            [&] { return bake_onto(source, target, options, onto); });
        baked.report.seconds.load = loaded;
        append(baked.report.warnings, detail::idle_options(target, options, typed_names(arguments.options),
                                                           detail::command_spelling));
    }
    require_not_cancelled(baked.report);
    write_together([&] {
        detail::save_result(baked, arguments.out, options, overwrite);
        baked.report.little_saved.reset();  // new textures add bytes
        baked.report.seconds.total = watch.seconds();
        if (!arguments.report.empty()) write_output(arguments.report, to_json(baked.report), overwrite);
    });
    if (arguments.quiet) return exit_ok;
    std::cout << arguments.source << " onto " << arguments.target << " -> " << arguments.out << "\n"
              << "largest distance: " << baked.report.coverage->largest_distance
              << "; texels without a source: " << shown_percent(baked.report.coverage->missing_texels) << "\n"
              << warnings_text(baked.report.warnings);
    return exit_ok;
}

}  // namespace

CommandInfo bake_command() {
    const auto arguments = std::make_shared<BakeArguments>();
    CommandInfo command{"bake",
                        "Bake the appearance of a model onto another mesh",
                        {"faqem bake remeshed.glb textured.glb --source original.glb"}};
    command.positionals = {positional("TARGET", arguments->target, "The mesh that gets new textures")};
    add_output(command, "OUT", arguments->out, detail::listed_extensions(detail::FormatUse::write_textures));
    OptionInfo source = text_option("--source", "FILE", arguments->source, "The model that is shown");
    source.is_required = true;
    const OptionInfo max_distance =
        text_option("--max-distance", "LENGTH", arguments->max_distance,
                    "Largest distance from the source, default 5%; texels beyond show those around them; "
                    "scene units, or % of the diagonal of the source");
    const OptionInfo uvs = text_option("--uvs", "auto|keep|new", arguments->uvs,
                                       "UVs of the result; auto (keep if they are in [0, 1] and do not "
                                       "overlap), keep, new");
    append(command.options, {source, uvs, max_distance});
    // Those of truncate about the appearance, except for what the target determines.
    std::vector<OptionInfo> baking = table_options(detail::in_truncate, arguments->options);
    std::erase_if(baking, [](const OptionInfo& option) {
        constexpr std::array none = {"--allow-larger", "--max-bytes", "--normals"};
        return std::ranges::find(none, option.names.back()) != none.end();
    });
    for (OptionInfo& option : baking)
        if (option.names.back() == "--bake") {
            option.value_name = "auto|atlas|per-triangle";
            option.description =
                "Kind of the new texture; auto (atlas, or per-triangle if that does not fit), "
                "atlas (charts), per-triangle";
        }
    append(command.options, std::move(baking));
    append(command.options, {report_option(arguments->report), strict_option(arguments->strict),
                             force_option(arguments->force), quiet_option(arguments->quiet)});
    command.run = [arguments] { return run(*arguments); };
    return command;
}

}  // namespace faqem::cli

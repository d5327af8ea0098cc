#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "cli/commands/commands.hpp"
#include "cli/files/output_file.hpp"
#include "cli/options/bound_options.hpp"
#include "cli/process/exit_code.hpp"
#include "cli/process/interrupt.hpp"
#include "cli/process/progress_bar.hpp"
#include "cli/report/error_surface.hpp"
#include "cli/report/model_comparison.hpp"
#include "cli/report/report_page.hpp"
#include "cli/report/viewer_model.hpp"
#include "render/views.hpp"

namespace faqem::cli {

namespace {

/// Faces are subdivided for the heat map until no edge is longer than the diagonal divided by this number.
constexpr double points_along_diagonal = 100;
/// The colour scale ends at this quantile of the vertices' distances, so that a few outliers do not leave all
/// other vertices with nearly the same colour.
constexpr double color_limit_quantile = 0.995;
/// Limit for both models together. Browsers fail to load larger pages.
constexpr std::uint64_t max_viewer_bytes = 256'000'000;

struct ReportArguments {
    std::string a, b, out, up = "y";
    std::uint32_t size = 320, views = 4;
    CompareOptions options;
    bool without_view = false, force = false;
};

/// Renders three images as `faqem render` does: the models, the models with edges, and the heat maps.
std::vector<Picture> draw_pictures(const ReportArguments& arguments, const FlattenedModel& a,
                                   const FlattenedModel& b, const ErrorSurface& error_a,
                                   const ErrorSurface& error_b, double limit) {
    std::vector<render::Scene> scenes, errors;
    for (const FlattenedModel* model : {&a, &b}) scenes.push_back(render::make_scene(model->asset));
    for (const ErrorSurface* error : {&error_a, &error_b}) {
        errors.push_back(render::make_scene(color_by_distance(*error, limit)));
        errors.back().faces = scenes[errors.size() - 1].faces;  // for the label
    }
    const std::vector<render::Camera> cameras =
        render::cameras_around(scenes[0], a.file, arguments.views, arguments.up == "z");
    const auto draw = [&](const std::vector<render::Scene>& drawn, render::Edges edges) {
        const std::vector<render::ContactSheetRow> rows =
            render::draw_rows(drawn, cameras, arguments.size, render::Shading::lit, edges);
        return encode_webp(render::compose_contact_sheet(rows), "sheet", {});
    };
    const std::string both =
        "The first model in the upper row, the second below it, rendered with the same cameras";
    return {{draw(scenes, render::Edges::hidden), "Shaded. " + both + ".", both + "."},
            {draw(scenes, render::Edges::drawn), "With mesh edges.", both + ", with mesh edges."},
            {draw(errors, render::Edges::hidden),
             "Distance to the other model: from dark (zero) to yellow (the 99.5th percentile of the "
             "vertices' distances, and above).",
             both + ", coloured by the distance to the other model."}};
}

/// Returns the data of the 3D view. Returns nothing and adds a note to the page if the view is not available.
std::optional<ViewerData> make_viewer_data(const ReportArguments& arguments, const FlattenedModel& a,
                                           const FlattenedModel& b, const ErrorSurface& error_a,
                                           const ErrorSurface& error_b, ReportPage& page, double limit,
                                           double max_distance) {
    if (arguments.without_view) return std::nullopt;
    if (!has_viewer()) {
        page.notes.push_back("No 3D view: faqem was built without npm.");
        return std::nullopt;
    }
    const MeshInfo& info = a.info;
    const double unit = page.comparison.distances.diagonal;
    ViewerFrame frame{{}, unit, max_distance > 0 ? max_distance : 1};
    for (std::size_t k = 0; k < 3; ++k) frame.centre[k] = 0.5 * info.box_min[k] + 0.5 * info.box_max[k];
    ViewerData view{viewer_glb(a, error_a, frame),
                    viewer_glb(b, error_b, frame),
                    {{"limit", limit / unit},
                     {"max_distance", max_distance / unit},
                     {"unit", unit},
                     {"up", arguments.up},
                     {"ramp", heat_ramp}}};
    if (view.a.size() + view.b.size() > max_viewer_bytes) {
        page.notes.push_back("No 3D view: the models exceed the limit of " +
                             std::to_string(max_viewer_bytes / 1'000'000) + " MB.");
        return std::nullopt;
    }
    return view;
}

int run(const ReportArguments& arguments) {
    check_extension(arguments.out, {".html", ".htm"});
    const Overwrite overwrite = prepare_files({arguments.a, arguments.b}, {arguments.out}, arguments.force);
    const ExitOnInterrupt exit_on_interrupt;

    ProgressBar bar(Bar::shown);
    bar.show("load");
    const FlattenedModel a = load_flattened(arguments.a), b = load_flattened(arguments.b);
    bar.show("compare");
    ReportPage page{a, b, compare_models(a, b, arguments.options), {}, {}, {}};
    const double spacing = page.comparison.distances.diagonal / points_along_diagonal;
    const ErrorSurface error_a = error_surface(a.flat, b.flat, spacing, arguments.options.threads),
                       error_b = error_surface(b.flat, a.flat, spacing, arguments.options.threads);
    const double max_distance = distance_quantile(error_a, error_b, 1),
                 within = distance_quantile(error_a, error_b, color_limit_quantile),
                 limit = within > 0 ? within : max_distance;
    bar.show("draw");
    page.pictures = draw_pictures(arguments, a, b, error_a, error_b, limit);
    page.view = make_viewer_data(arguments, a, b, error_a, error_b, page, limit, max_distance);
    if (!page.comparison.colors_warning.empty()) page.notes.push_back(page.comparison.colors_warning);
    for (const FlattenedModel* model : {&a, &b})
        for (const std::string& warning : model->asset.warnings)
            page.notes.push_back(model->file + ": " + warning);
    bar.hide();
    for (const std::string& note : page.notes) std::cerr << "faqem: warning: " << note << "\n";
    write_only_output(arguments.out, report_html(page), overwrite);
    return exit_ok;
}

}  // namespace

CommandInfo report_command() {
    const auto arguments = std::make_shared<ReportArguments>();
    CommandInfo command{"report",
                        "Compare two models on an HTML page, in 3D and in figures",
                        {"faqem report model.glb simplified.glb report.html"}};
    command.positionals = {positional("A", arguments->a, "The original"),
                           positional("B", arguments->b, "The other model")};
    add_output(command, "PAGE", arguments->out, ".html or .htm");
    append(command.options,
           {number_option("--size", "N", arguments->size, {.min = 16, .max = 2048},
                          "Side of one view of a picture, pixels (default 320)"),
            number_option("--views", "N", arguments->views, from_one(16), "Views of a picture (default 4)"),
            up_option(arguments->up),
            flag_option("--without-view", arguments->without_view,
                        "Figures and pictures only, without the 3D view")});
    append(command.options, compare_options(arguments->options));
    append(command.options, {force_option(arguments->force)});
    command.run = [arguments] { return run(*arguments); };
    return command;
}

}  // namespace faqem::cli

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "faqem/error.hpp"
#include "cli/referenced_files.hpp"
#include "cli/commands/commands.hpp"
#include "cli/report/compare_options.hpp"
#include "cli/exit_code.hpp"
#include "cli/interrupt.hpp"
#include "cli/report/model_comparison.hpp"
#include "cli/output_file.hpp"
#include "cli/report/error_surface.hpp"
#include "cli/report/page.hpp"
#include "cli/report/viewer_model.hpp"
#include "render/views.hpp"

namespace faqem::tool {

namespace {

/// Faces are cut so that there are about as many vertices along the diagonal to show the error at.
constexpr double points_along_diagonal = 100;
/// The full colour is for the distance that all but one in two hundred vertices are within: a single spike
/// does not make all else look alike.
constexpr double coloured_share = 0.995;
/// Of both models together. Above it, browsers fail to hold the page.
constexpr std::uint64_t most_view_bytes = 256'000'000;

struct Arguments {
    std::string a, b, out;
    std::uint32_t size = 320, views = 4;
    CompareOptions options;
    bool without_view = false, force = false;
};

ReportedModel reported(const PlacedModel& model, const MeshInfo& info) {
    std::vector<std::filesystem::path> files = referred_files(model.file);
    files.emplace_back(model.file);
    return {model.file, bytes_of(files), info, model.asset.materials.size(), model.asset.images.size()};
}

Image sheet_of(std::vector<SheetRow> rows, const std::vector<SheetRow>* labelled = nullptr) {
    for (std::size_t r = 0; labelled && r < rows.size(); ++r) rows[r].label = (*labelled)[r].label;
    return encode_png(compose(rows), "sheet");
}

/// The models, their edges, and their errors, as faqem render would draw them.
std::vector<Picture> draw_pictures(const Arguments& arguments, const PlacedModel& a, const PlacedModel& b,
                                   const ErrorSurface& error_a, const ErrorSurface& error_b, double limit) {
    std::vector<Scene> scenes, errors;
    for (const PlacedModel* model : {&a, &b}) scenes.push_back(make_scene(model->asset));
    for (const ErrorSurface* error : {&error_a, &error_b})
        errors.push_back(make_scene(coloured(*error, limit)));
    const std::vector<Camera> cameras = cameras_around(scenes[0], a.file, arguments.views);
    const auto draw = [&](const std::vector<Scene>& drawn, Edges edges) {
        return draw_rows(drawn, cameras, arguments.size, Shading::lit, edges);
    };
    const std::vector<SheetRow> look = draw(scenes, Edges::hidden);
    const std::string both = "The first model in the upper row, the second below it, from the same sides";
    return {
        {sheet_of(look), "As they look. " + both + ".", both + "."},
        {sheet_of(draw(scenes, Edges::drawn)), "With the edges of their faces.", both + ", with edges."},
        {sheet_of(draw(errors, Edges::hidden), &look),
         "The distance to the other model: from dark, none, to yellow, the largest but for one point in two "
         "hundred.",
         both + ", coloured by their distance to each other."}};
}

/// Nothing, with a note, where the page cannot have it.
std::optional<View> make_view(const Arguments& arguments, const PlacedModel& a, const PlacedModel& b,
                              const ErrorSurface& error_a, const ErrorSurface& error_b, ReportPage& page,
                              double limit, double most) {
    if (arguments.without_view) return std::nullopt;
    if (!has_viewer()) {
        page.notes.push_back("No 3D view: this faqem was built without npm.");
        return std::nullopt;
    }
    const MeshInfo& info = page.comparison.a;
    const double unit = page.comparison.distances.diagonal;
    ViewFrame frame{{}, unit};
    for (std::size_t k = 0; k < 3; ++k) frame.centre[k] = 0.5 * info.box_min[k] + 0.5 * info.box_max[k];
    View view{view_model(a, error_a, frame), view_model(b, error_b, frame), limit / unit, most / unit, unit};
    if (view.a.size() + view.b.size() > most_view_bytes) {
        page.notes.push_back("No 3D view: the models would take more than " +
                             std::to_string(most_view_bytes / 1'000'000) + " MB of the page.");
        return std::nullopt;
    }
    return view;
}

int run(const Arguments& arguments) {
    const Overwrite overwrite = arguments.force ? Overwrite::yes : Overwrite::no;
    check_ending(arguments.out, {".html", ".htm"});
    check_output(arguments.out, {arguments.a, arguments.b}, overwrite);
    handle_interrupts();
    const Unattended unattended;

    const PlacedModel a = load_placed(arguments.a), b = load_placed(arguments.b);
    ReportPage page;
    page.comparison = compare_models(a, b, arguments.options);
    page.a = reported(a, page.comparison.a);
    page.b = reported(b, page.comparison.b);
    const double spacing = page.comparison.distances.diagonal / points_along_diagonal;
    const ErrorSurface error_a = error_surface(a.flat, b.flat, spacing, arguments.options.threads),
                       error_b = error_surface(b.flat, a.flat, spacing, arguments.options.threads);
    const double most = distance_of_share(error_a, error_b, 1),
                 within = distance_of_share(error_a, error_b, coloured_share),
                 limit = within > 0 ? within : most;
    page.pictures = draw_pictures(arguments, a, b, error_a, error_b, limit);
    page.view = make_view(arguments, a, b, error_a, error_b, page, limit, most);
    if (!page.comparison.colors_warning.empty()) page.notes.push_back(page.comparison.colors_warning);
    for (const PlacedModel* model : {&a, &b}) {
        for (const std::string& warning : model->asset.warnings)
            page.notes.push_back(model->file + ": " + warning);
    }
    for (const std::string& note : page.notes) std::cerr << "faqem: warning: " << note << "\n";
    write_output(arguments.out, page_of(page), overwrite);
    return exit_ok;
}

}  // namespace

void add_report_command(CLI::App& app, Action& action) {
    const auto arguments = std::make_shared<Arguments>();
    CLI::App* command = app.add_subcommand(
        "report", "Compare two models on a page: side by side in 3D, with figures, pictures and a heat map");
    command->add_option("A", arguments->a, "The original")->required();
    command->add_option("B", arguments->b, "The other model")->required();
    command->add_option("-o,--out", arguments->out, "The page, .html")->required();
    command->add_option("--size", arguments->size, "Side of one view of a picture in pixels (default 320)")
        ->check(CLI::Range(16, 2048));
    command->add_option("--views", arguments->views, "Views of a picture (default 4)")
        ->check(CLI::Range(1, 16));
    command->add_flag("--without-view", arguments->without_view,
                      "Figures and pictures only: a small page without the models");
    add_compare_options(*command, arguments->options);
    command->add_flag("--force", arguments->force, "Replace a page that exists");
    command->final_callback([arguments, &action] { action = [arguments] { return run(*arguments); }; });
}

}  // namespace faqem::tool

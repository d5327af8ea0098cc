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
#include "render/views.hpp"

namespace faqem::cli {

namespace {

struct RenderArguments {
    std::vector<std::string> models;  ///< then the output image, unless it is `out`
    std::string out, up = "y";
    std::uint32_t size = 480, views = 4;
    bool unlit = false, wireframe = false, force = false;
};

int run(const RenderArguments& arguments) {
    std::vector<std::string> models = arguments.models;
    std::string out = arguments.out;
    if (out.empty()) {
        out = models.back();
        models.pop_back();
    }
    if (models.empty() || models.size() > 16)
        throw OptionError("render: 1 to 16 models and an image are required");
    check_extension(out, {".png"});
    const Overwrite overwrite = prepare_files({models.begin(), models.end()}, {out}, arguments.force);
    const ExitOnInterrupt exit_on_interrupt;

    ProgressBar bar(Bar::shown);
    bar.show("load");
    std::vector<render::Scene> scenes;
    for (const std::string& model : models) {
        scenes.push_back(render::make_scene(load(model)));
        for (const std::string& warning : scenes.back().warnings) {
            bar.hide();
            std::cerr << "faqem: warning: " << model << ": " << warning << "\n";
        }
    }
    bar.show("draw");
    const std::vector<render::ContactSheetRow> rows = render::draw_rows(
        scenes, render::cameras_around(scenes[0], models[0], arguments.views, arguments.up == "z"),
        arguments.size, arguments.unlit ? render::Shading::unlit : render::Shading::lit,
        arguments.wireframe ? render::Edges::drawn : render::Edges::hidden);
    const Image sheet = encode_png(render::compose_contact_sheet(rows), "sheet");
    write_only_output(out, {reinterpret_cast<const char*>(sheet.encoded.data()), sheet.encoded.size()},
                      overwrite);
    return exit_ok;
}

}  // namespace

CommandInfo render_command() {
    const auto arguments = std::make_shared<RenderArguments>();
    OptionInfo files =
        list_option("FILES", arguments->models, "Models, then the output image: A [B ...] OUT.png");
    files.kind = detail::OptionKind::text;  // commas do not separate names
    files.is_required = true;
    files.max_words = 17;
    return {
        "render",
        "Render models below each other with the same cameras",
        {"faqem render model.glb simplified.glb before-after.png --views 3"},
        {files},
        {rare(text_option("-o,--output", "OUT", arguments->out, "The image, instead of the last word")),
         number_option("--size", "N", arguments->size, {.min = 16, .max = 2048},
                       "Side of one view, pixels (default 480)"),
         number_option("--views", "N", arguments->views, from_one(16), "Views around the models (default 4)"),
         up_option(arguments->up), flag_option("--unlit", arguments->unlit, "Colours without lighting"),
         flag_option("--wireframe", arguments->wireframe, "Draw the mesh edges"),
         force_option(arguments->force)},
        [arguments] { return run(*arguments); }};
}

}  // namespace faqem::cli

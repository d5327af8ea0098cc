#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "cli/commands/commands.hpp"
#include "cli/exit_code.hpp"
#include "cli/interrupt.hpp"
#include "cli/output_file.hpp"
#include "cli/protected_files.hpp"
#include "render/contact_sheet.hpp"
#include "render/views.hpp"

namespace faqem::cli {

namespace {

struct RenderArguments {
    std::vector<std::string> files;  ///< the models, then the output image
    std::uint32_t size = 480, views = 4;
    bool unlit = false, wireframe = false, force = false;
};

int run(const RenderArguments& arguments) {
    const std::vector<std::string> models(arguments.files.begin(), arguments.files.end() - 1);
    const std::string& out = arguments.files.back();
    const Overwrite overwrite = arguments.force ? Overwrite::yes : Overwrite::no;
    check_extension(out, {".png"});
    for (const std::string& model : models) protect_input(model);
    check_output(out, overwrite);
    install_signal_handlers();
    const ExitOnInterrupt exit_on_interrupt;

    std::vector<render::Scene> scenes;
    for (const std::string& model : models) {
        scenes.push_back(render::make_scene(load(model)));
        for (const std::string& warning : scenes.back().warnings) {
            std::cerr << "faqem: warning: " << model << ": " << warning << "\n";
        }
    }
    const std::vector<render::ContactSheetRow> rows =
        render::draw_rows(scenes, render::cameras_around(scenes[0], models[0], arguments.views),
                          arguments.size, arguments.unlit ? render::Shading::unlit : render::Shading::lit,
                          arguments.wireframe ? render::Edges::drawn : render::Edges::hidden);
    const Image sheet = encode_png(render::compose_contact_sheet(rows), "sheet");
    write_only_output(out, {reinterpret_cast<const char*>(sheet.encoded.data()), sheet.encoded.size()},
                      overwrite);
    return exit_ok;
}

}  // namespace

void add_render_command(CLI::App& app, Action& action) {
    const auto arguments = std::make_shared<RenderArguments>();
    CLI::App* command = app.add_subcommand("render", "Render models below each other with the same cameras");
    command->add_option("FILES", arguments->files, "Models, then the output image: A [B ...] OUT.png")
        ->required()
        ->expected(2, 17);
    command->add_option("--size", arguments->size, "Side of one view, pixels (default 480)")
        ->check(CLI::Range(16, 2048));
    command->add_option("--views", arguments->views, "Views around the models (default 4)")
        ->check(CLI::Range(1, 16));
    command->add_flag("--unlit", arguments->unlit, "Colours without lighting");
    command->add_flag("--wireframe", arguments->wireframe, "Draw the mesh edges");
    command->add_flag("--force", arguments->force, "Overwrite an existing image");
    command->final_callback([arguments, &action] { action = [arguments] { return run(*arguments); }; });
}

}  // namespace faqem::cli

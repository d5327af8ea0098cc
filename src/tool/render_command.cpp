#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "faqem/error.hpp"
#include "parallel.hpp"
#include "tool/commands.hpp"
#include "tool/exit_code.hpp"
#include "tool/interrupt.hpp"
#include "tool/output.hpp"
#include "tool/sheet.hpp"

namespace faqem::tool {

namespace {

constexpr double turn = 6.283185307179586, first_azimuth = 0.35, margin = 1.04;
constexpr std::array<double, 2> elevations = {0.16, 0.42};  // in turn: from the side, and a little into it

struct Arguments {
    std::vector<std::string> files;  ///< models, and the picture last
    std::uint32_t size = 480, views = 4;
    bool unlit = false, wireframe = false, force = false;
};

/// Views around the first model; all have the same distance, so that sizes can be compared.
std::vector<Camera> cameras(const Scene& scene, const std::string& file, std::uint32_t views) {
    Vector3 low, high;
    if (!bounds(scene, low, high)) throw InputError(file, "", "has no triangles");
    const Vector3 centre = 0.5 * low + 0.5 * high;
    std::vector<Camera> result;
    double distance = 0;
    for (std::uint32_t i = 0; i < views; ++i) {
        result.push_back(
            looking_at(centre, first_azimuth + turn * i / views, elevations[i % elevations.size()]));
        distance = std::max(distance, fitting_distance(scene, result.back(), centre));
    }
    if (!(distance > 0)) distance = 1;
    for (Camera& camera : result) camera.eye = centre + margin * distance * camera.back;
    return result;
}

std::string with_commas(std::uint64_t number) {
    std::string text = std::to_string(number);
    for (std::size_t i = text.size(); i > 3; i -= 3) text.insert(i - 3, 1, ',');
    return text;
}

int run(const Arguments& arguments) {
    const std::vector<std::string> models(arguments.files.begin(), arguments.files.end() - 1);
    const std::string& out = arguments.files.back();
    const Overwrite overwrite = arguments.force ? Overwrite::yes : Overwrite::no;
    check_ending(out, {".png"});
    check_output(out, {models.begin(), models.end()}, overwrite);
    handle_interrupts();
    const Unattended unattended;

    std::vector<Scene> scenes;
    for (const std::string& model : models) {
        scenes.push_back(make_scene(load(model)));
        for (const std::string& warning : scenes.back().warnings) {
            std::cerr << "faqem: warning: " << model << ": " << warning << "\n";
        }
    }
    const std::vector<Camera> views = cameras(scenes[0], models[0], arguments.views);
    std::vector<SheetRow> rows(scenes.size());
    for (std::size_t r = 0; r < rows.size(); ++r) {
        rows[r].frames.resize(views.size());
        rows[r].label = with_commas(scenes[r].faces) + " faces";
    }
    detail::parallel_blocks(scenes.size() * views.size(), 1, 0, [&](std::size_t i, std::size_t) {
        const std::size_t r = i / views.size(), v = i % views.size();
        rows[r].frames[v] =
            render(scenes[r], views[v], arguments.size, arguments.unlit ? Shading::unlit : Shading::lit,
                   arguments.wireframe ? Edges::drawn : Edges::hidden);
    });
    const Image sheet = encode_png(compose(rows), "sheet");
    write_output(out, {reinterpret_cast<const char*>(sheet.encoded.data()), sheet.encoded.size()}, overwrite);
    return exit_ok;
}

}  // namespace

void add_render_command(CLI::App& app, Action& action) {
    const auto arguments = std::make_shared<Arguments>();
    CLI::App* command =
        app.add_subcommand("render", "Draw models one under the other, as seen by the same cameras");
    command->add_option("FILES", arguments->files, "Models, then the picture: A [B ...] OUT.png")
        ->required()
        ->expected(2, 17);
    command->add_option("--size", arguments->size, "Side of one view in pixels (default 480)")
        ->check(CLI::Range(16, 2048));
    command->add_option("--views", arguments->views, "Views around the models (default 4)")
        ->check(CLI::Range(1, 16));
    command->add_flag("--unlit", arguments->unlit, "Colours as they are, without light");
    command->add_flag("--wireframe", arguments->wireframe, "Draw the faces' edges");
    command->add_flag("--force", arguments->force, "Replace a picture that exists");
    command->final_callback([arguments, &action] { action = [arguments] { return run(*arguments); }; });
}

}  // namespace faqem::tool

#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <string>

#include "asset/flatten.hpp"
#include "faqem/asset.hpp"
#include "faqem/compare_colors.hpp"
#include "faqem/error.hpp"
#include "tool/commands.hpp"
#include "tool/exit_code.hpp"
#include "tool/json.hpp"

namespace faqem::tool {

namespace {

struct Arguments {
    std::string a, b;
    CompareOptions options;
};

Json side_json(const OneSided& side) {
    return {{"max", side.max},
            {"max_bound", side.max_bound},
            {"mean", side.mean},
            {"mean_squared", side.mean_squared},
            {"mean_normal_degrees", side.mean_normal_degrees}};
}

Json side_json(const OneSidedColors& side) {
    return {
        {"rmse", side.rmse}, {"wrong", side.wrong}, {"one_sided", side.one_sided}, {"hidden", side.hidden}};
}

/// Null where a model says nothing of colours, or an image cannot be read: that is no reason to withhold the
/// distances.
Json colors_json(const Asset& a, const Asset& b, const CompareOptions& options) {
    if (!has_colors(a) || !has_colors(b)) return nullptr;
    try {
        const ColorComparison c = compare_colors(a, b, options);
        return {{"rmse", c.rmse},
                {"psnr", c.psnr},
                {"a_to_b", side_json(c.a_to_b)},
                {"b_to_a", side_json(c.b_to_a)}};
    } catch (const Error& error) {
        std::cerr << "faqem: warning: colours are not compared: " << error.what() << "\n";
        return nullptr;
    }
}

Part flat(const Asset& asset, const std::string& file) {
    Part part = detail::flatten(asset);
    if (!(info(MeshView{part.positions, part.triangles}).area > 0)) {
        throw InputError(file, "", "has no face with area");
    }
    return part;
}

int run(const Arguments& arguments) {
    const Asset asset_a = load(arguments.a), asset_b = load(arguments.b);
    const Part a = flat(asset_a, arguments.a), b = flat(asset_b, arguments.b);
    const MeshView view_a{a.positions, a.triangles}, view_b{b.positions, b.triangles};
    const Comparison result = compare(view_a, view_b, arguments.options);
    const double d = result.diagonal;
    print_json({{"a", arguments.a},
                {"b", arguments.b},
                {"diagonal", d},
                {"hausdorff", result.hausdorff},
                {"hausdorff_rel", result.hausdorff / d},
                {"hausdorff_bound", result.hausdorff_bound},
                {"hausdorff_bound_rel", result.hausdorff_bound / d},
                {"chamfer", result.chamfer},
                {"chamfer_rel", result.chamfer / (d * d)},
                {"mean_normal_degrees", result.mean_normal_degrees},
                {"a_to_b", side_json(result.a_to_b)},
                {"b_to_a", side_json(result.b_to_a)},
                {"colors", colors_json(asset_a, asset_b, arguments.options)},
                {"info_a", info_json(info(view_a))},
                {"info_b", info_json(info(view_b))},
                {"samples", arguments.options.samples},
                {"seed", arguments.options.seed},
                {"tolerance", arguments.options.tolerance}});
    return exit_ok;
}

}  // namespace

void add_compare_command(CLI::App& app, Action& action) {
    const auto arguments = std::make_shared<Arguments>();
    CLI::App* command = app.add_subcommand(
        "compare", "Distances and colour differences between two models, both ways, as JSON");
    command->add_option("A", arguments->a, "The original; its diagonal is the unit of *_rel")->required();
    command->add_option("B", arguments->b, "The other model")->required();
    command->add_option("--samples", arguments->options.samples, "Samples on each model (default 200000)")
        ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1} << 32));
    command->add_option("--seed", arguments->options.seed, "Another seed, other samples (default 1)");
    command
        ->add_option("--tolerance", arguments->options.tolerance,
                     "Gap allowed between a largest distance and its bound, as a share of it (default 0.01)")
        ->check(CLI::Range(0.0, 1e9));
    command
        ->add_option("--threads", arguments->options.threads,
                     "Threads at most; the result does not depend on it")
        ->check(CLI::Range(0, 1024));
    command->final_callback([arguments, &action] { action = [arguments] { return run(*arguments); }; });
}

}  // namespace faqem::tool

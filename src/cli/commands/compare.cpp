#include <iostream>
#include <memory>
#include <optional>
#include <string>

#include "cli/commands/commands.hpp"
#include "cli/options/bound_options.hpp"
#include "cli/process/exit_code.hpp"
#include "cli/process/interrupt.hpp"
#include "cli/process/json.hpp"
#include "cli/process/progress_bar.hpp"
#include "cli/report/model_comparison.hpp"

namespace faqem::cli {

namespace {

struct CompareArguments {
    std::string a, b;
    CompareOptions options;
    bool json = false;
};

Json one_sided_json(const OneSided& side) {
    return {{"max", side.max},
            {"max_bound", side.max_bound},
            {"mean", side.mean},
            {"mean_squared", side.mean_squared},
            {"mean_normal_degrees", side.mean_normal_degrees}};
}

Json one_sided_json(const OneSidedColors& side) {
    return {{"rmse", side.rmse},
            {"outliers", side.outliers},
            {"unmatched", side.unmatched},
            {"hidden", side.hidden}};
}

Json colors_json(const std::optional<ColorComparison>& colors) {
    if (!colors) return nullptr;
    return {{"rmse", colors->rmse},
            {"psnr", colors->psnr},
            {"a_to_b", one_sided_json(colors->a_to_b)},
            {"b_to_a", one_sided_json(colors->b_to_a)}};
}

int run(const CompareArguments& arguments) {
    install_signal_handlers();
    const ExitOnInterrupt exit_on_interrupt;
    std::optional<ProgressBar> bar(Bar::shown);
    bar->show("load");
    const FlattenedModel a = load_flattened(arguments.a), b = load_flattened(arguments.b);
    bar->show("compare");
    const ModelComparison comparison = compare_models(a, b, arguments.options);
    bar.reset();
    if (!comparison.colors_warning.empty())
        std::cerr << "faqem: warning: " << comparison.colors_warning << "\n";
    if (!arguments.json) {
        std::cout << comparison_text(a, b, comparison);
        return exit_ok;
    }
    const Comparison& result = comparison.distances;
    const double d = result.diagonal;
    std::cout << json_text({{"a", arguments.a},
                            {"b", arguments.b},
                            {"diagonal", d},
                            {"hausdorff", result.hausdorff},
                            {"hausdorff_rel", result.hausdorff / d},
                            {"hausdorff_bound", result.hausdorff_bound},
                            {"hausdorff_bound_rel", result.hausdorff_bound / d},
                            {"chamfer", result.chamfer},
                            {"chamfer_rel", result.chamfer / (d * d)},
                            {"mean_normal_degrees", result.mean_normal_degrees},
                            {"a_to_b", one_sided_json(result.a_to_b)},
                            {"b_to_a", one_sided_json(result.b_to_a)},
                            {"colors", colors_json(comparison.colors)},
                            {"info_a", info_json(a.info)},
                            {"info_b", info_json(b.info)},
                            {"samples", arguments.options.samples},
                            {"seed", arguments.options.seed},
                            {"tolerance", arguments.options.tolerance}});
    return exit_ok;
}

}  // namespace

CommandInfo compare_command() {
    const auto arguments = std::make_shared<CompareArguments>();
    CommandInfo command{
        "compare",
        "Measure distances and colour differences of two models",
        {"faqem compare model.glb simplified.glb", "faqem compare model.glb simplified.glb --json"},
        {positional("A", arguments->a, "The original; *_rel values are relative to its diagonal"),
         positional("B", arguments->b, "The other model")},
        compare_options(arguments->options),
        [arguments] { return run(*arguments); }};
    append(command.options, {flag_option("--json", arguments->json, "Print JSON instead of text")});
    return command;
}

}  // namespace faqem::cli

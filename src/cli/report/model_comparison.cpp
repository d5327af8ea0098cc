#include "cli/report/model_comparison.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "asset/scene/flatten.hpp"
#include "asset/scene/rounding_weld.hpp"
#include "cli/process/shown_text.hpp"
#include "faqem/error.hpp"
#include "render/views.hpp"

namespace faqem::cli {

FlattenedModel load_flattened(const std::string& file) {
    FlattenedModel model{file, load(file), {}, {}};
    for (std::string& warning : detail::weld_rounded_positions(model.asset))
        model.asset.warnings.push_back(std::move(warning));
    model.flat = detail::flatten(model.asset);
    model.info = info(model.view());
    if (!(model.info.area > 0)) throw InputError(file, "", "has no face with non-zero area");
    return model;
}

ModelComparison compare_models(const FlattenedModel& a, const FlattenedModel& b,
                               const CompareOptions& options) {
    ModelComparison result;
    result.distances = compare(a.view(), b.view(), options);
    if (!has_colors(a.asset) || !has_colors(b.asset)) return result;
    try {
        result.colors = compare_colors(a.asset, b.asset, options);
    } catch (const Error& error) {
        result.colors_warning = std::string("colours are not compared: ") + error.what();
    }
    return result;
}

std::string comparison_text(const FlattenedModel& a, const FlattenedModel& b,
                            const ModelComparison& comparison) {
    const double bound = comparison.distances.hausdorff_bound, diagonal = comparison.distances.diagonal;
    std::string text = render::with_commas(b.info.faces) + " faces instead of " +
                       render::with_commas(a.info.faces) + ", " + shown_bytes(b.asset.file_bytes) +
                       " instead of " + shown_bytes(a.asset.file_bytes) +
                       ".\nNo point of either surface is farther than " + shown_number(bound) + " (" +
                       shown_percent(bound / diagonal) + " of the diagonal) from the other" +
                       shown_in_pixels(bound, diagonal) + ".\n";
    if (!comparison.colors) return text;
    const ColorComparison& colors = *comparison.colors;
    if (!std::isfinite(colors.psnr)) return text + "Colours do not differ.\n";
    return text + "Colours differ by " + shown_percent(colors.rmse) + " of their range (" +
           shown_number(colors.psnr, 3) + " dB), and by more than a quarter on " +
           shown_percent(std::max(colors.a_to_b.outliers, colors.b_to_a.outliers)) + " of the surface.\n";
}

}  // namespace faqem::cli

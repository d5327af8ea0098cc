#include "cli/report/model_comparison.hpp"

#include <utility>

#include "asset/scene/flatten.hpp"
#include "asset/scene/rounding_weld.hpp"
#include "faqem/error.hpp"

namespace faqem::cli {

FlattenedModel load_flattened(const std::string& file) {
    FlattenedModel model{file, load(file), {}};
    for (std::string& warning : detail::weld_rounded_positions(model.asset))
        model.asset.warnings.push_back(std::move(warning));
    model.flat = detail::flatten(model.asset);
    if (!(info(model.view()).area > 0)) throw InputError(file, "", "has no face with non-zero area");
    return model;
}

ModelComparison compare_models(const FlattenedModel& a, const FlattenedModel& b,
                               const CompareOptions& options) {
    ModelComparison result;
    result.distances = compare(a.view(), b.view(), options);
    result.a = info(a.view());
    result.b = info(b.view());
    if (!has_colors(a.asset) || !has_colors(b.asset)) return result;
    try {
        result.colors = compare_colors(a.asset, b.asset, options);
    } catch (const Error& error) {
        result.colors_warning = std::string("colours are not compared: ") + error.what();
    }
    return result;
}

}  // namespace faqem::cli

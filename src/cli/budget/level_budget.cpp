#include "cli/budget/level_budget.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "bake/scene/unencoded_result.hpp"
#include "cli/budget/image_trials.hpp"

namespace faqem::cli {

namespace {

// Number of choices that are made before the smallest images: a choice may have a few bytes more than expected.
constexpr int most_choices = 4;

// Shares of Phase::bake.
constexpr double begin_of_trials = 0.5, end_of_trials = 1;

// Bytes of a result without the images that are encoded again.
std::uint64_t fixed_bytes(detail::UnencodedResult result, const ByteBudget& budget) {
    const Image placeholder = encode_png({1, 1, {0, 0, 0, 255}, false}, "");
    std::uint64_t added = 0;
    for (const detail::PendingImage& pending : result.pending) {
        result.asset.asset.images[pending.image].encoded = placeholder.encoded;
        added += placeholder.encoded.size();
    }
    const std::uint64_t total = model_bytes(result.asset.asset, budget.file).total();
    return total - std::min(added, total);
}

std::vector<std::size_t> smallest_images(const TriedImages& tried) {
    std::vector<std::size_t> result;
    for (const std::vector<TriedImage>& image : tried) {
        const auto smallest =
            std::min_element(image.begin(), image.end(),
                             [](const TriedImage& a, const TriedImage& b) { return a.bytes < b.bytes; });
        result.push_back(static_cast<std::size_t>(smallest - image.begin()));
    }
    return result;
}

SimplifiedAsset with_smaller_images(detail::UnencodedResult result, const Options& options,
                                    const ByteBudget& budget, std::uint64_t bytes_before) try {
    const std::array<TriedFaces, 1> faces = {
        {{result.asset.report.faces_out, fixed_bytes(result, budget), {}}}};
    const std::array<TriedRounding, 1> exact = {{{{}, std::max<std::uint64_t>(faces[0].bytes, 1), {}}}};
    SearchSteps steps(options);
    ImageTrials trials(result, steps);
    trials.try_all(faces, exact, budget.bytes, begin_of_trials, end_of_trials);
    result.pending.clear();
    std::uint64_t wanted = budget.bytes, bytes = 0;
    const auto fits = [&](const std::vector<std::size_t>& images) {
        result.asset.asset.images = trials.chosen_images(images);
        bytes = model_bytes(result.asset.asset, budget.file).total();
        return bytes <= budget.bytes;
    };
    bool is_found = false;
    for (int i = 0; i < most_choices && !is_found; ++i) {
        const std::vector<BudgetChoice> choices = budget_choices(faces, trials.tried(), exact, wanted);
        if (choices.empty()) break;
        is_found = fits(choices.front().images);
        if (!is_found) wanted -= std::min(wanted, bytes - budget.bytes);
    }
    if (is_found || fits(smallest_images(trials.tried()))) {
        detail::encode_images(result, steps.step());  // none is pending, but all are reported
        result.asset.report.warnings.push_back("images were reduced to fit --max-bytes: the result had " +
                                               std::to_string(bytes_before) + " bytes");
        return std::move(result.asset);
    }
    throw BudgetError("the smallest result with " + std::to_string(result.asset.report.faces_out) +
                      " faces has " + std::to_string(bytes) + " bytes, but --max-bytes allows " +
                      std::to_string(budget.bytes));
} catch (const engine::Cancelled&) {
    detail::set_cancelled(result.asset);
    return std::move(result.asset);
}

}  // namespace

SimplifiedAsset bake_within_bytes(const Asset& source, const SimplifiedParts& simplified,
                                  const Options& options, const ByteBudget& budget) {
    detail::UnencodedResult result = detail::bake_unencoded(source, simplified, options);
    detail::encode_images(result, options);
    if (result.asset.report.stop == StopReason::cancelled) return std::move(result.asset);
    detail::add_histories(simplified, options, result.asset);
    const std::uint64_t bytes = model_bytes(result.asset.asset, budget.file).total();
    if (bytes <= budget.bytes) return std::move(result.asset);
    if (!result.pending.empty()) return with_smaller_images(std::move(result), options, budget, bytes);
    throw BudgetError("the result with " + std::to_string(result.asset.report.faces_out) + " faces has " +
                      std::to_string(bytes) + " bytes, but --max-bytes allows " +
                      std::to_string(budget.bytes));
}

}  // namespace faqem::cli

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

// Number of choices that are made before the smallest images.
constexpr std::size_t most_choices = 4;

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

// The trials in the order in which they are made: the best ones that should fit, then the smallest one.
std::vector<std::size_t> ordered_trials(const ImageTrials& trials, std::span<const TriedFaces> faces,
                                        std::span<const TriedRounding> roundings, std::uint64_t bytes) {
    std::vector<std::size_t> result;
    for (const BudgetChoice& choice : budget_choices(faces, trials.tried(), roundings, bytes))
        if (result.size() < most_choices) result.push_back(choice.images);
    const auto smallest =
        std::min_element(trials.tried().begin(), trials.tried().end(),
                         [](const TriedImages& a, const TriedImages& b) { return a.bytes < b.bytes; });
    result.push_back(static_cast<std::size_t>(smallest - trials.tried().begin()));
    return result;
}

SimplifiedAsset with_smaller_images(detail::UnencodedResult result, const Options& options,
                                    const ByteBudget& budget, const PictureMeter& meter,
                                    std::uint64_t bytes_before) try {
    const std::array<TriedFaces, 1> faces = {
        {{result.asset.report.faces_out, fixed_bytes(result, budget), {}}}};
    const std::array<TriedRounding, 1> exact = {{{{}, std::max<std::uint64_t>(faces[0].bytes, 1), {}}}};
    SearchSteps steps(options);
    ImageTrials trials(result, meter, steps);
    trials.try_all(faces, exact, budget.bytes, begin_of_trials, end_of_trials);
    result.pending.clear();
    std::uint64_t bytes = 0;
    for (const std::size_t trial : ordered_trials(trials, faces, exact, budget.bytes)) {
        result.asset.asset.images = trials.encoded(trial, detail::ImageEffort::full);
        bytes = model_bytes(result.asset.asset, budget.file).total();
        if (bytes > budget.bytes) continue;
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
                                  const Options& options, const ByteBudget& budget,
                                  const PictureMeter& meter) {
    detail::UnencodedResult result = detail::bake_unencoded(source, simplified, options);
    detail::encode_images(result, options);
    if (result.asset.report.stop == StopReason::cancelled) return std::move(result.asset);
    detail::add_histories(simplified, options, result.asset);
    const std::uint64_t bytes = model_bytes(result.asset.asset, budget.file).total();
    if (bytes <= budget.bytes) return std::move(result.asset);
    if (!result.pending.empty()) return with_smaller_images(std::move(result), options, budget, meter, bytes);
    throw BudgetError("the result with " + std::to_string(result.asset.report.faces_out) + " faces has " +
                      std::to_string(bytes) + " bytes, but --max-bytes allows " +
                      std::to_string(budget.bytes));
}

}  // namespace faqem::cli

#include "result/fit_images.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "asset/file_format.hpp"
#include "faqem/error.hpp"
#include "result/image_trials.hpp"

namespace faqem::detail {

namespace {

// Number of choices that are made before the smallest images: a choice may have a few bytes more than expected.
constexpr int most_choices = 4;

// Shares of Phase::bake.
constexpr double begin_of_trials = 0.5, end_of_trials = 1;

// Bytes of a result without the images that are encoded again.
std::uint64_t fixed_bytes(UnencodedResult result, ModelFormat format) {
    const Image placeholder = encode_png({1, 1, {0, 0, 0, 255}, false}, "");
    std::uint64_t added = 0;
    for (const PendingImage& pending : result.pending) {
        result.asset.asset.images[pending.image].encoded = placeholder.encoded;
        added += placeholder.encoded.size();
    }
    const std::uint64_t total = model_size(result.asset.asset, format).total();
    return total - std::min(added, total);
}

}  // namespace

ModelSize model_size(const Asset& asset, ModelFormat format) {
    constexpr std::size_t name_length = 64;
    const std::string_view extension = result_format(format, format).extension;
    const EncodedModel model = encode_model(asset, std::string(name_length, 'm').append(extension));
    ModelSize size{model.bytes() - model.image_bytes(), model.image_bytes(), 0};
    for (const ResultView& view : model.views)
        if (is_animation(view)) size.fixed += view.bytes;
    return size;
}

ModelSize fit_images(UnencodedResult& result, const Options& options, const RunContext& context,
                     std::uint64_t bytes) try {
    const std::array<TriedFaces, 1> faces = {
        {{result.asset.report.faces_out, fixed_bytes(result, options.format), {}}}};
    const std::array<TriedRounding, 1> exact = {{{{}, std::max<std::uint64_t>(faces[0].bytes, 1), {}}}};
    ImageTrials trials(result, options.bake, context);
    trials.try_all(faces, exact, bytes, begin_of_trials, end_of_trials);
    result.pending.clear();
    std::uint64_t wanted = bytes;
    ModelSize size;
    const auto fits = [&](const std::vector<std::size_t>& images) {
        result.asset.asset.images = trials.chosen_images(images);
        size = model_size(result.asset.asset, options.format);
        return size.total() <= bytes;
    };
    bool is_found = false;
    for (int i = 0; i < most_choices && !is_found; ++i) {
        const std::vector<ResultChoice> choices = result_choices(faces, trials.tried(), exact, wanted);
        if (choices.empty()) break;
        is_found = fits(choices.front().images);
        if (!is_found) wanted -= std::min(wanted, size.total() - bytes);
    }
    if (!is_found) fits(smallest_images(trials.tried()));
    encode_images(result, options, context.quiet());  // none is pending, but all are reported
    return size;
} catch (const engine::Cancelled& stopped) {
    if (stopped.reason == StopReason::cancelled) throw;
    throw TimeLimitError("max_seconds was over before images were found that fit max_bytes");
}

}  // namespace faqem::detail

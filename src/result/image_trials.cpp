#include "result/image_trials.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "asset/file_format.hpp"
#include "bake/texture/image_choice.hpp"
#include "faqem/error.hpp"

namespace faqem::detail {

namespace {

// Sides of the smallest images, and of those that are tried first, texels: smaller ones are tried if these do not fit.
constexpr std::uint32_t least_side = 64, first_side = 256;

// The fineness that is measured for a new size; the errors of the others are estimated from what was measured.
constexpr std::uint32_t measured_fineness = 2 * fineness_step;

// An image is not tried in a larger size, or finer, if its error has less than this share of the error of all.
constexpr double least_share = 0.02;

// Images with a smaller share of the limit than one of these are not refined.
constexpr std::uint64_t many_images = 50;

// Most times that encodings next to the best choice are tried.
constexpr int most_rounds = 12;

// Weight of data that pictures do not show, relative to colours: 4 dB less, as for least_quality().
constexpr double data_weight = 0.4;

// Share of the pixels of an image that the views do not show: others may.
constexpr double least_seen = 0.001;

std::uint32_t longer_side(const Pixels& pixels) { return std::max(pixels.width, pixels.height); }

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

std::uint64_t encoded_bytes(const std::vector<Image>& images) {
    std::uint64_t result = 0;
    for (const Image& image : images) result += image.encoded.size();
    return result;
}

ImageTrials::ImageTrials(UnencodedResult full, const BakeOptions& bake, const RunContext& context)
    : full_(std::move(full)), bake_(bake), context_(context) {
    if (full_.pending.empty()) return;
    for (const PendingImage& pending : full_.pending) full_.asset.asset.images[pending.image].encoded.clear();
    meter_.emplace(full_.asset.asset, full_.pending, context_);
    full_.asset.asset.parts.clear();
    make_sizes();
    trials_.resize(sizes_.size());
    tried_.resize(sizes_.size());
}

// The pending images, and each half of them.
void ImageTrials::make_sizes() {
    sizes_.resize(full_.pending.size());
    std::uint32_t side = 0;
    for (const PendingImage& pending : full_.pending) side = std::max(side, longer_side(pending.pixels));
    for (;;) {
        for (std::size_t i = 0; i < sizes_.size(); ++i) {
            const PendingImage& pending = full_.pending[i];
            const bool is_new = sizes_[i].empty() ||
                                longer_side(sizes_[i].back().pending.pixels) > longer_side(pending.pixels);
            if (!is_new) continue;
            std::vector<ImageEncoding> encodings = image_encodings(pending, bake_);
            std::vector<std::uint8_t> is_tried(encodings.size(), 0);
            sizes_[i].push_back({pending, std::move(encodings), std::move(is_tried), {}, {}});
        }
        side /= 2;
        if (side < least_side) break;
        limit_image_sides(full_, side);
    }
    for (std::vector<Size>& sizes : sizes_) std::reverse(sizes.begin(), sizes.end());
    for (PendingImage& pending : full_.pending) pending.pixels = {};
}

void ImageTrials::try_all(std::span<const TriedFaces> faces, std::span<const TriedRounding> roundings,
                          std::uint64_t bytes, double begin, double end) {
    if (!are_encoded()) return;
    std::vector<Request> requests;
    for (std::size_t i = 0; i < sizes_.size(); ++i) {
        std::size_t size = 0;
        while (size + 1 < sizes_[i].size() && longer_side(sizes_[i][size + 1].pending.pixels) <= first_side)
            ++size;
        requests.push_back({i, size, 0, sizes_[i][size].encodings.back().fineness});
    }
    const auto best_choice = [&]() -> std::optional<ResultChoice> {
        std::vector<ResultChoice> found = result_choices(faces, tried_, roundings, bytes);
        if (found.empty()) return std::nullopt;
        measure_choice(found.front());
        return std::move(result_choices(faces, tried_, roundings, bytes).front());
    };
    const auto try_requests = [&] {
        encode(requests);
        context_.check_now();
        measure_sizes(requests);
    };
    for (int round = 0; round < most_rounds && !requests.empty(); ++round) {
        context_.report(Phase::bake, begin + (end - begin) * round / most_rounds);
        try_requests();
        const std::optional<ResultChoice> best = best_choice();
        requests = best ? next_requests(*best) : smaller_requests();
    }
    for (std::uint32_t distance = fineness_step / 2; distance > 0; distance /= 2) {
        const std::optional<ResultChoice> best = best_choice();
        if (!best) return;
        requests = refining_requests(*best, distance, bytes / many_images);
        try_requests();
    }
    best_choice();
}

std::vector<ImageTrials::Request> ImageTrials::smaller_requests() const {
    std::vector<Request> result;
    for (std::size_t i = 0; i < sizes_.size(); ++i) {
        std::size_t size = 0;
        while (!sizes_[i][size].finest_tried) ++size;
        if (size > 0) result.push_back({i, size - 1, 0, sizes_[i][size - 1].encodings.back().fineness});
    }
    return result;
}

std::vector<ImageTrials::Request> ImageTrials::next_requests(const ResultChoice& choice) const {
    std::vector<Request> result;
    const double least_error = least_share * mean_square_of(choice.psnr);
    for (std::size_t i = 0; i < sizes_.size(); ++i) {
        const Trial& trial = trials_[i][choice.images[i]];
        const Size& size = sizes_[i][trial.size];
        const SizeError& error = *size.error;
        if (trial.fineness == size.finest_tried && trial.fineness < size.encodings.back().fineness &&
            estimated_error(error, trial.difference).sum() - error.own.sum() > least_error)
            result.push_back({i, trial.size, 0, trial.fineness + fineness_step});
        const std::size_t next = trial.size + 1;
        if (next < sizes_[i].size() && !sizes_[i][next].finest_tried && error.own.sum() > least_error)
            result.push_back({i, next, 0, std::max(trial.fineness, measured_fineness)});
    }
    return result;
}

// What is between the chosen encodings and their neighbours.
// \param least_bytes  of images whose encoding matters
std::vector<ImageTrials::Request> ImageTrials::refining_requests(const ResultChoice& choice,
                                                                 std::uint32_t distance,
                                                                 std::uint64_t least_bytes) const {
    std::vector<Request> result;
    for (std::size_t i = 0; i < sizes_.size(); ++i) {
        const Trial& trial = trials_[i][choice.images[i]];
        if (trial.image.encoded.size() < least_bytes) continue;
        result.push_back({i, trial.size, trial.fineness - std::min(trial.fineness, distance),
                          trial.fineness + distance, 2 * distance});
    }
    return result;
}

void ImageTrials::encode(std::span<const Request> requests) {
    struct Task {
        std::size_t image, size, encoding;
    };
    std::vector<Task> tasks;
    for (const Request& request : requests) {
        Size& size = sizes_[request.image][request.size];
        for (std::size_t k = 0; k < size.encodings.size(); ++k) {
            const std::uint32_t fineness = size.encodings[k].fineness;
            const bool is_wanted = fineness >= request.first && fineness <= request.last &&
                                   (fineness - request.first) % request.step == 0;
            if (size.is_tried[k] || !is_wanted) continue;
            size.is_tried[k] = 1;
            size.finest_tried = std::max(size.finest_tried.value_or(0), fineness);
            tasks.push_back({request.image, request.size, k});
        }
    }
    std::vector<Trial> made(tasks.size());
    parallel_blocks(tasks.size(), 1, context_,
                    [&](std::size_t k, std::size_t, const RunContext& block_context) {
                        block_context.check_now();
                        const Size& size = sizes_[tasks[k].image][tasks[k].size];
                        const ImageEncoding& encoding = size.encodings[tasks[k].encoding];
                        Image image = encode_as(size.pending, bake_, encoding);
                        const double difference = mean_square_error(size.pending, image);
                        made[k] = {tasks[k].size, encoding.fineness, difference, std::move(image)};
                    });
    for (std::size_t k = 0; k < tasks.size(); ++k) trials_[tasks[k].image].push_back(std::move(made[k]));
}

// The errors of new sizes, alone and with one of their encodings.
void ImageTrials::measure_sizes(std::span<const Request> requests) {
    std::vector<Pixels> resized(sizes_.size()), encoded(sizes_.size());
    std::vector<double> differences(sizes_.size(), 0);
    for (const auto& [i, s, first, last, step] : requests) {
        if (sizes_[i][s].error) continue;
        if (s + 1 < sizes_[i].size()) resized[i] = sizes_[i][s].pending.pixels;
        const Trial* measured = nullptr;
        for (const Trial& trial : trials_[i]) {
            if (trial.size != s || !(trial.difference > 0)) continue;
            measured = &trial;
            if (trial.fineness >= measured_fineness) break;
        }
        if (!measured) continue;
        encoded[i] = decode(measured->image);
        differences[i] = measured->difference;
    }
    const std::vector<std::optional<PictureDifference>> own = (*meter_)(std::move(resized));
    const std::vector<std::optional<PictureDifference>> both = (*meter_)(std::move(encoded));
    // Seen images first: what errors of texels do in their pictures is assumed of the others.
    for (const auto& [i, s, first, last, step] : requests) {
        if (sizes_[i][s].error || !both[i]) continue;
        SizeError& error = sizes_[i][s].error.emplace();
        error.own = own[i].value_or(PictureDifference{});
        add_sample(error, *both[i], differences[i]);
        const double share = std::max(meter_->shares()[i], least_seen);
        seen_gain_ += error.samples[0].added.lit / (share * differences[i]);
        ++seen_sizes_;
    }
    const double gain = seen_sizes_ > 0 ? seen_gain_ / seen_sizes_ : 1;
    for (const auto& [i, s, first, last, step] : requests) {
        if (sizes_[i][s].error) continue;
        const PendingImage& largest = sizes_[i].back().pending;
        const double weight = data_weight * gain * std::max(meter_->shares()[i], least_seen);
        const double lost = mean_square_of(
            shown_quality(largest.pixels, sizes_[i][s].pending.pixels, *largest.known, largest.repeats)
                .whole);
        sizes_[i][s].error = SizeError{unseen_error(weight * lost), {{1, unseen_error(weight)}}};
    }
    update_errors();
}

// The errors of a choice, where they were not measured: those of fine encodings are not in proportion to those of
// coarse ones, since pictures average what changes from texel to texel.
void ImageTrials::measure_choice(const ResultChoice& choice) {
    std::vector<Pixels> encoded(sizes_.size());
    for (std::size_t i = 0; i < sizes_.size(); ++i) {
        const Trial& trial = trials_[i][choice.images[i]];
        const std::vector<Sample>& samples = sizes_[i][trial.size].error->samples;
        const bool is_measured =
            !(trial.difference > 0) ||
            std::ranges::find(samples, trial.difference, &Sample::difference) != samples.end();
        if (!is_measured) encoded[i] = decode(trial.image);
    }
    const std::vector<std::optional<PictureDifference>> both = (*meter_)(std::move(encoded));
    for (std::size_t i = 0; i < sizes_.size(); ++i) {
        const Trial& trial = trials_[i][choice.images[i]];
        if (both[i]) add_sample(*sizes_[i][trial.size].error, *both[i], trial.difference);
    }
    update_errors();
}

// \param both  with an encoding that has the difference
void ImageTrials::add_sample(SizeError& error, const PictureDifference& both, double difference) {
    const double unseen = least_seen * difference;
    PictureDifference added = {std::max(0.0, both.unlit - error.own.unlit),
                               std::max(0.0, both.lit - error.own.lit)};
    if (added.unlit > 0) added.unlit += unseen;
    added.lit += unseen;
    const auto at = std::find_if(error.samples.begin(), error.samples.end(),
                                 [&](const Sample& sample) { return sample.difference > difference; });
    error.samples.insert(at, {difference, added});
}

// Interpolates between no difference, the samples, and beyond.
PictureDifference ImageTrials::estimated_error(const SizeError& error, double difference) {
    Sample before;
    for (const Sample& sample : error.samples) {
        if (!(difference <= sample.difference)) {
            before = sample;
            continue;
        }
        const double share = (difference - before.difference) / (sample.difference - before.difference);
        return error.own + before.added * (1 - share) + sample.added * share;
    }
    if (!(before.difference > 0)) return error.own;
    return error.own + before.added * (difference / before.difference);
}

void ImageTrials::update_errors() {
    for (std::size_t i = 0; i < sizes_.size(); ++i) {
        tried_[i].clear();
        for (const Trial& trial : trials_[i])
            tried_[i].push_back({trial.image.encoded.size(),
                                 estimated_error(*sizes_[i][trial.size].error, trial.difference),
                                 longer_side(sizes_[i][trial.size].pending.pixels)});
    }
}

// Pictures without light are those of colours, if there are others.
PictureDifference ImageTrials::unseen_error(double error) const {
    return {meter_->has_lit_pictures() ? 0 : error, error};
}

std::vector<Image> ImageTrials::chosen_images(const std::vector<std::size_t>& chosen) const {
    std::vector<Image> result = full_.asset.asset.images;
    for (std::size_t i = 0; i < chosen.size(); ++i)
        result[full_.pending[i].image] = trials_[i][chosen[i]].image;
    return result;
}

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

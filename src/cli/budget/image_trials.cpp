#include "cli/budget/image_trials.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "bake/texture/image_choice.hpp"

namespace faqem::cli {

namespace {

// Sides of the smallest images, and of those that are tried first, texels: smaller ones are tried if these do not fit.
constexpr std::uint32_t least_side = 64, first_side = 256;

// The rung whose pictures are compared: the others have errors in proportion to their squared differences.
constexpr std::uint32_t measured_rung = 2 * detail::whole_rung;

// An image is not tried in a larger size, or finer, if its error has less than this share of the error of all.
constexpr double least_share = 0.02;

// Images with a smaller share of the budget than one of these are not refined.
constexpr std::uint64_t many_images = 50;

// Most times that encodings next to the best choice are tried.
constexpr int most_rounds = 12;

// Weight of data that pictures do not show, relative to colours: 4 dB less, as for least_quality().
constexpr double data_weight = 0.4;

// Share of the pixels of an image that the views do not show: others may.
constexpr double least_seen = 0.001;

PictureError scaled(const PictureError& error, double factor) {
    return {factor * error.unlit, factor * error.lit};
}

double sum(const PictureError& error) { return error.unlit + error.lit; }

std::uint32_t longer_side(const Pixels& pixels) { return std::max(pixels.width, pixels.height); }

}  // namespace

bool ImageTrials::Size::has_trials() const {
    return std::find(is_tried.begin(), is_tried.end(), 1) != is_tried.end();
}

std::uint32_t ImageTrials::Size::last_tried_rung() const {
    const auto last = std::find(is_tried.rbegin(), is_tried.rend(), 1);
    return encodings[static_cast<std::size_t>(is_tried.rend() - last) - 1].rung;
}

std::uint64_t encoded_bytes(const std::vector<Image>& images) {
    std::uint64_t result = 0;
    for (const Image& image : images) result += image.encoded.size();
    return result;
}

ImageTrials::ImageTrials(detail::UnencodedResult full, SearchSteps& steps)
    : full_(std::move(full)), steps_(steps) {
    if (full_.pending.empty()) return;
    for (const detail::PendingImage& pending : full_.pending)
        full_.asset.asset.images[pending.image].encoded.clear();
    meter_.emplace(full_.asset.asset, full_.pending, steps_.workers());
    full_.asset.asset.parts.clear();
    make_sizes();
    trials_.resize(sizes_.size());
    tried_.resize(sizes_.size());
    size_errors_.resize(sizes_.size());
    for (std::size_t i = 0; i < sizes_.size(); ++i) size_errors_[i].resize(sizes_[i].size());
}

// The pending images, and each half of them.
void ImageTrials::make_sizes() {
    sizes_.resize(full_.pending.size());
    std::uint32_t side = 0;
    for (const detail::PendingImage& pending : full_.pending)
        side = std::max(side, longer_side(pending.pixels));
    for (;;) {
        for (std::size_t i = 0; i < sizes_.size(); ++i) {
            const detail::PendingImage& pending = full_.pending[i];
            const bool is_new = sizes_[i].empty() ||
                                longer_side(sizes_[i].back().pending.pixels) > longer_side(pending.pixels);
            if (!is_new) continue;
            std::vector<detail::ImageEncoding> encodings =
                detail::image_encodings(pending, steps_.options().bake);
            std::vector<std::uint8_t> is_tried(encodings.size(), 0);
            sizes_[i].push_back({pending, std::move(encodings), std::move(is_tried)});
        }
        side /= 2;
        if (side < least_side) break;
        detail::limit_image_sides(full_, side);
    }
    for (std::vector<Size>& sizes : sizes_) std::reverse(sizes.begin(), sizes.end());
    for (detail::PendingImage& pending : full_.pending) pending.pixels = {};
}

void ImageTrials::try_all(std::span<const TriedFaces> faces, std::span<const TriedRounding> roundings,
                          std::uint64_t bytes, double begin, double end) {
    if (!are_encoded()) return;
    std::vector<Request> requests;
    for (std::size_t i = 0; i < sizes_.size(); ++i) {
        std::size_t size = 0;
        while (size + 1 < sizes_[i].size() && longer_side(sizes_[i][size + 1].pending.pixels) <= first_side)
            ++size;
        requests.push_back({i, size, 0, sizes_[i][size].encodings.back().rung});
    }
    const auto choices = [&] { return budget_choices(faces, tried_, roundings, bytes); };
    for (int round = 0; round < most_rounds && !requests.empty(); ++round) {
        steps_.report(begin + (end - begin) * round / most_rounds);
        encode(requests);
        steps_.check();
        measure(requests);
        const std::vector<BudgetChoice> found = choices();
        requests = found.empty() ? smaller_requests() : next_requests(found.front());
    }
    for (std::uint32_t distance = detail::whole_rung / 2; distance > 0; distance /= 2) {
        const std::vector<BudgetChoice> found = choices();
        if (found.empty()) return;
        requests = refining_requests(found.front(), distance, bytes / many_images);
        encode(requests);
        measure(requests);
    }
}

std::vector<ImageTrials::Request> ImageTrials::smaller_requests() const {
    std::vector<Request> result;
    for (std::size_t i = 0; i < sizes_.size(); ++i) {
        std::size_t size = 0;
        while (!sizes_[i][size].has_trials()) ++size;
        if (size > 0) result.push_back({i, size - 1, 0, sizes_[i][size - 1].encodings.back().rung});
    }
    return result;
}

std::vector<ImageTrials::Request> ImageTrials::next_requests(const BudgetChoice& choice) const {
    std::vector<Request> result;
    const double least_error = least_share * std::pow(10, -choice.psnr / 10);
    for (std::size_t i = 0; i < sizes_.size(); ++i) {
        const Trial& trial = trials_[i][choice.images[i]];
        const Size& size = sizes_[i][trial.size];
        const SizeError& error = *size_errors_[i][trial.size];
        if (trial.rung == size.last_tried_rung() && trial.rung < size.encodings.back().rung &&
            sum(error.by_difference) * trial.difference > least_error)
            result.push_back({i, trial.size, 0, trial.rung + detail::whole_rung});
        const std::size_t next = trial.size + 1;
        if (next < sizes_[i].size() && !sizes_[i][next].has_trials() && sum(error.own) > least_error)
            result.push_back({i, next, 0, std::max(trial.rung, measured_rung)});
    }
    return result;
}

// What is between the chosen encodings and their neighbours.
// \param least_bytes  of images whose encoding matters
std::vector<ImageTrials::Request> ImageTrials::refining_requests(const BudgetChoice& choice,
                                                                 std::uint32_t distance,
                                                                 std::uint64_t least_bytes) const {
    std::vector<Request> result;
    for (std::size_t i = 0; i < sizes_.size(); ++i) {
        const Trial& trial = trials_[i][choice.images[i]];
        if (trial.image.encoded.size() < least_bytes) continue;
        result.push_back({i, trial.size, trial.rung - std::min(trial.rung, distance), trial.rung + distance,
                          2 * distance});
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
            const std::uint32_t rung = size.encodings[k].rung;
            const bool is_wanted =
                rung >= request.first && rung <= request.last && (rung - request.first) % request.step == 0;
            if (size.is_tried[k] || !is_wanted) continue;
            size.is_tried[k] = 1;
            tasks.push_back({request.image, request.size, k});
        }
    }
    std::vector<Trial> made(tasks.size());
    detail::parallel_blocks(tasks.size(), 1, steps_.workers(),
                            [&](std::size_t k, std::size_t, detail::CancellationCheck check_cancelled) {
                                check_cancelled.now();
                                const Size& size = sizes_[tasks[k].image][tasks[k].size];
                                const detail::ImageEncoding& encoding = size.encodings[tasks[k].encoding];
                                Image image =
                                    detail::encode_as(size.pending, steps_.options().bake, encoding);
                                const double difference = detail::mean_square_error(size.pending, image);
                                made[k] = {tasks[k].size, encoding.rung, difference, std::move(image)};
                            });
    for (std::size_t k = 0; k < tasks.size(); ++k) trials_[tasks[k].image].push_back(std::move(made[k]));
}

void ImageTrials::measure(std::span<const Request> requests) {
    std::vector<Pixels> resized(sizes_.size()), encoded(sizes_.size());
    std::vector<const Trial*> measured(sizes_.size(), nullptr);
    for (const auto& [i, s, first, last, step] : requests) {
        if (size_errors_[i][s]) continue;
        if (s + 1 < sizes_[i].size()) resized[i] = sizes_[i][s].pending.pixels;
        for (const Trial& trial : trials_[i]) {
            if (trial.size != s || !(trial.difference > 0)) continue;
            measured[i] = &trial;
            if (trial.rung >= measured_rung) break;
        }
        if (measured[i]) encoded[i] = decode(measured[i]->image);
    }
    const std::vector<std::optional<PictureError>> own = (*meter_)(std::move(resized));
    const std::vector<std::optional<PictureError>> both = (*meter_)(std::move(encoded));
    // Seen images first: what errors of texels do in their pictures is assumed of the others.
    for (const auto& [i, s, first, last, step] : requests) {
        if (size_errors_[i][s] || !both[i]) continue;
        SizeError& error = size_errors_[i][s].emplace();
        error.own = own[i].value_or(PictureError{});
        const auto added = [&](double with, double without) {
            return std::max(0.0, with - without) / measured[i]->difference;
        };
        error.by_difference = {added(both[i]->unlit, error.own.unlit), added(both[i]->lit, error.own.lit)};
        const double share = std::max(meter_->shares()[i], least_seen);
        seen_gain_ += error.by_difference.lit / share;
        ++seen_sizes_;
        error.by_difference.lit += least_seen;
        if (error.by_difference.unlit > 0) error.by_difference.unlit += least_seen;
    }
    const double gain = seen_sizes_ > 0 ? seen_gain_ / seen_sizes_ : 1;
    for (const auto& [i, s, first, last, step] : requests) {
        if (size_errors_[i][s]) continue;
        const detail::PendingImage& largest = sizes_[i].back().pending;
        const double weight = data_weight * gain * std::max(meter_->shares()[i], least_seen);
        const double lost = std::pow(
            10, -detail::image_loss(largest.pixels, sizes_[i][s].pending.pixels, *largest.known).psnr / 10);
        size_errors_[i][s] = SizeError{unseen_error(weight * lost), unseen_error(weight)};
    }
    for (std::size_t i = 0; i < sizes_.size(); ++i) {
        tried_[i].clear();
        for (const Trial& trial : trials_[i]) {
            const SizeError& at = *size_errors_[i][trial.size];
            PictureError error = at.own;
            error += scaled(at.by_difference, trial.difference);
            tried_[i].push_back(
                {trial.image.encoded.size(), error, longer_side(sizes_[i][trial.size].pending.pixels)});
        }
    }
}

// Pictures without light are those of colours, if there are others.
PictureError ImageTrials::unseen_error(double error) const {
    return {meter_->has_lit_pictures() ? 0 : error, error};
}

std::vector<Image> ImageTrials::chosen_images(const std::vector<std::size_t>& chosen) const {
    std::vector<Image> result = full_.asset.asset.images;
    for (std::size_t i = 0; i < chosen.size(); ++i)
        result[full_.pending[i].image] = trials_[i][chosen[i]].image;
    return result;
}

}  // namespace faqem::cli

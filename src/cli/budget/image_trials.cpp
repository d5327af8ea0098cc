#include "cli/budget/image_trials.hpp"

#include <algorithm>
#include <array>

namespace faqem::cli {

namespace {

// Image qualities that are tried first, dB, and the distance of those that are tried around the best one.
constexpr std::array<double, 4> first_qualities = {43, 38, 33, 28};
constexpr double quality_step = 2.5;

// Sides of the smallest images, and of those that are tried first, texels: smaller ones are tried if these do not fit.
constexpr std::uint32_t least_side = 64, first_side = 256;

// Larger images are not tried if the last doubling made the error smaller by less than this factor.
constexpr double least_improvement = 0.97;

}  // namespace

std::uint64_t encoded_bytes(const std::vector<Image>& images) {
    std::uint64_t result = 0;
    for (const Image& image : images) result += image.encoded.size();
    return result;
}

ImageTrials::ImageTrials(detail::UnencodedResult full, const PictureMeter& meter, SearchSteps& steps)
    : full_(std::move(full)), meter_(meter), steps_(steps) {
    if (!full_.pending.empty()) make_sizes();
}

// The pending images of the largest size, and those of each half of it.
void ImageTrials::make_sizes() {
    std::uint32_t side = 0;
    for (const detail::PendingImage& image : full_.pending)
        side = std::max({side, image.pixels.width, image.pixels.height});
    for (;;) {
        sizes_.emplace_back(side, full_.pending);
        for (detail::PendingImage& image : sizes_.back().second) image.may_shrink = false;
        side /= 2;
        if (side < least_side || !detail::limit_image_sides(full_, side)) break;
    }
    full_.pending.clear();
}

void ImageTrials::try_all(std::span<const TriedFaces> faces, std::span<const TriedRounding> roundings,
                          std::uint64_t bytes, double begin, double end) {
    if (!are_encoded()) {
        tried_.push_back({{}, {}, encoded_bytes(full_.asset.asset.images), {}});
        return;
    }
    const std::vector<std::optional<double>> qualities =
        has_image_quality(steps_.options().bake.image_format)
            ? std::vector<std::optional<double>>(first_qualities.begin(), first_qualities.end())
            : std::vector<std::optional<double>>(1);
    const auto choices = [&] { return budget_choices(faces, tried_, roundings, bytes); };
    const auto report = [&](std::size_t size) {
        const double done = static_cast<double>(sizes_.size() - 1 - size);
        steps_.report(begin + (end - begin) * done / static_cast<double>(sizes_.size()));
    };
    // The smallest of the sizes that are tried first.
    std::size_t first = sizes_.size() - 1;
    while (first > 0 && sizes_[first].first < first_side) --first;
    double last = 0;
    for (std::size_t s = first + 1; s-- > 0;) {
        report(s);
        const std::size_t begin_of_size = tried_.size();
        try_qualities(s, qualities);
        const TriedImages& best = tried_[begin_of_size];
        const double error = best.error.unlit + best.error.lit;
        const bool fits = std::any_of(
            tried_.begin() + static_cast<std::ptrdiff_t>(begin_of_size), tried_.end(),
            [&](const TriedImages& images) { return images.bytes + faces.back().bytes <= bytes; });
        if (!fits || (last > 0 && error > least_improvement * last)) break;
        last = error;
    }
    for (std::size_t s = first + 1; s < sizes_.size() && choices().empty(); ++s) {
        report(s);
        try_qualities(s, qualities);
    }
    const std::vector<BudgetChoice> found = choices();
    if (found.empty()) return;
    const std::size_t best = found.front().images;
    const std::optional<double> quality = tried_[best].quality;
    if (!quality) return;
    const std::array<std::optional<double>, 2> around = {*quality - quality_step, *quality + quality_step};
    try_qualities(size_of_tried_[best], around);
}

void ImageTrials::try_qualities(std::size_t size, std::span<const std::optional<double>> qualities) {
    const std::vector<std::vector<Image>> images = encoded(size, qualities, detail::ImageEffort::estimate);
    for (std::size_t q = 0; q < qualities.size(); ++q) {
        steps_.check();
        const std::uint64_t bytes = encoded_bytes(images[q]);
        // The codec has no smaller ones.
        if (q > 0 && bytes == tried_.back().bytes) continue;
        full_.asset.asset.images = images[q];
        tried_.push_back({sizes_[size].first, qualities[q], bytes, meter_(full_.asset.asset)});
        size_of_tried_.push_back(size);
    }
}

std::vector<std::vector<Image>> ImageTrials::encoded(std::size_t size,
                                                     std::span<const std::optional<double>> qualities,
                                                     detail::ImageEffort effort) {
    const std::vector<detail::PendingImage>& pending = sizes_[size].second;
    std::vector<std::vector<Image>> encoded =
        detail::encode_alternatives(pending, steps_.options().bake, qualities, steps_.workers(), effort);
    std::vector<std::vector<Image>> result(qualities.size(), full_.asset.asset.images);
    for (std::size_t q = 0; q < qualities.size(); ++q)
        for (std::size_t i = 0; i < pending.size(); ++i)
            result[q][pending[i].image] = std::move(encoded[q][i]);
    return result;
}

std::vector<Image> ImageTrials::encoded(std::size_t trial, detail::ImageEffort effort) {
    if (!are_encoded()) return full_.asset.asset.images;
    return encoded(size_of_tried_[trial], std::span(&tried_[trial].quality, 1), effort).front();
}

}  // namespace faqem::cli

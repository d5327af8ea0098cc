#include "result/result_choices.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace faqem::detail {

namespace {

// Errors are interpolated as powers: none is 0.
constexpr double smallest_error = 1e-9;

double log_of(std::uint64_t count) {
    return std::log(static_cast<double>(std::max<std::uint64_t>(count, 1)));
}

// Position of x between a and b, 0 to 1.
double share_between(double a, double b, double x) {
    const double share = (x - a) / (b - a);
    return share >= 0 ? std::min(share, 1.0) : 0;
}

double power_between(double a, double b, double share) {
    const double from = std::log(std::max(a, smallest_error)), to = std::log(std::max(b, smallest_error));
    return std::exp(from + share * (to - from));
}

// Of the bytes of the geometry from one choice to the next.
constexpr double geometry_ratio = 0.97;

// How often images are chosen again with the weights of unlit and lit errors of the choice before.
constexpr int allocation_rounds = 3;

/// An exchange of an encoding for a larger one.
struct ImageStep {
    std::size_t image = 0, encoding = 0;  // the larger one
    std::uint64_t bytes = 0;              // more
    PictureDifference less;
};

struct Allocation {
    std::vector<std::size_t> chosen;
    std::uint64_t bytes = 0;
    PictureDifference error;  // with those of geometry
};

/// Chooses encodings for numbers of bytes.
class ImageAllocator {
public:
    // \param images  outlives this
    explicit ImageAllocator(const TriedImages& images) : images_(images) {
        for (std::size_t i = 0; i < images.size(); ++i) add(i, images[i]);
    }

    /// The smallest encodings.
    const Allocation& least() const { return least_; }

    // \param bytes  not less than those of least()
    // \param other  errors that do not depend on the images
    Allocation within(std::uint64_t bytes, const PictureDifference& other) const {
        Allocation result;
        PictureDifference total = least_.error + other;
        for (int round = 0; round < allocation_rounds; ++round) {
            result = chosen_by(bytes, {1 / (total.unlit + smallest_error), 1 / (total.lit + smallest_error)});
            result.error += other;
            total = result.error;
        }
        return result;
    }

    PictureDifference error_of(const std::vector<std::size_t>& chosen) const {
        PictureDifference result;
        for (std::size_t i = 0; i < chosen.size(); ++i) result += images_[i][chosen[i]].error;
        return result;
    }

private:
    // Adds the steps along the lower convex hull of an image's bytes and errors.
    void add(std::size_t image, const std::vector<TriedImage>& tried) {
        std::vector<std::size_t> order(tried.size());
        for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
        std::ranges::stable_sort(
            order, {}, [&](std::size_t k) { return std::pair(tried[k].bytes, tried[k].error.sum()); });
        std::size_t at = order[0];
        least_.chosen.push_back(at);
        least_.bytes += tried[at].bytes;
        least_.error += tried[at].error;
        for (;;) {
            std::size_t next = tried.size();
            double best = 0;
            for (const std::size_t k : order) {
                if (!(tried[k].bytes > tried[at].bytes)) continue;
                const double gain = (tried[at].error.sum() - tried[k].error.sum()) /
                                    static_cast<double>(tried[k].bytes - tried[at].bytes);
                if (!(gain > best)) continue;
                best = gain;
                next = k;
            }
            if (next == tried.size()) return;
            steps_.push_back(
                {image, next, tried[next].bytes - tried[at].bytes, tried[at].error - tried[next].error});
            at = next;
        }
    }

    Allocation chosen_by(std::uint64_t bytes, const PictureDifference& weights) const {
        std::vector<std::pair<double, std::size_t>> order(steps_.size());
        for (std::size_t s = 0; s < steps_.size(); ++s) {
            const double gain = weights.unlit * steps_[s].less.unlit + weights.lit * steps_[s].less.lit;
            order[s] = {gain / static_cast<double>(steps_[s].bytes), s};
        }
        // The steps of an image have falling gains, so that they stay in their order.
        std::ranges::stable_sort(order, [](const auto& a, const auto& b) { return a.first > b.first; });
        Allocation result = least_;
        std::vector<std::uint8_t> is_full(least_.chosen.size(), 0);
        std::vector<std::size_t> full;  // images, in the order of their gains
        for (const auto& [gain, s] : order) {
            const ImageStep& step = steps_[s];
            if (is_full[step.image]) continue;
            if (step.bytes > bytes - result.bytes) {
                is_full[step.image] = 1;
                full.push_back(step.image);
                continue;
            }
            exchange(step.image, step.encoding, result);
        }
        for (const std::size_t image : full) fill(image, bytes, weights, result);
        return result;
    }

    void exchange(std::size_t image, std::size_t encoding, Allocation& result) const {
        const TriedImage &before = images_[image][result.chosen[image]], &after = images_[image][encoding];
        result.chosen[image] = encoding;
        result.bytes = result.bytes - before.bytes + after.bytes;
        result.error += after.error - before.error;
    }

    // Takes the encoding with the least error that fits, which is not on the hull.
    void fill(std::size_t image, std::uint64_t bytes, const PictureDifference& weights,
              Allocation& result) const {
        const std::vector<TriedImage>& tried = images_[image];
        const auto weighted = [&](std::size_t k) {
            return weights.unlit * tried[k].error.unlit + weights.lit * tried[k].error.lit;
        };
        std::size_t best = result.chosen[image];
        const std::uint64_t most = bytes - result.bytes + tried[best].bytes;
        for (std::size_t k = 0; k < tried.size(); ++k)
            if (tried[k].bytes <= most && weighted(k) < weighted(best)) best = k;
        exchange(image, best, result);
    }

    const TriedImages& images_;
    Allocation least_;
    std::vector<ImageStep> steps_;
};

}  // namespace

std::optional<std::uint64_t> faces_within(std::span<const TriedFaces> tried, std::uint64_t bytes) {
    for (std::size_t i = 0; i < tried.size(); ++i) {
        if (tried[i].bytes > bytes) continue;
        if (i == 0) return tried[0].faces;
        const TriedFaces &more = tried[i - 1], &fewer = tried[i];
        const double share = share_between(log_of(fewer.bytes), log_of(more.bytes), log_of(bytes));
        const double faces =
            std::exp(log_of(fewer.faces) + share * (log_of(more.faces) - log_of(fewer.faces)));
        return std::clamp(static_cast<std::uint64_t>(faces), fewer.faces, more.faces);
    }
    return std::nullopt;
}

PictureDifference error_of_faces(std::span<const TriedFaces> tried, std::uint64_t faces) {
    if (faces >= tried.front().faces) return tried.front().error;
    for (std::size_t i = 1; i < tried.size(); ++i) {
        if (faces < tried[i].faces) continue;
        const TriedFaces &more = tried[i - 1], &fewer = tried[i];
        if (i == 1) {
            // With all faces there is hardly an error, so that it grows with what is missing.
            const auto area = [](std::uint64_t n) {
                return 1 / static_cast<double>(std::max<std::uint64_t>(n, 1));
            };
            const double share = share_between(area(more.faces), area(fewer.faces), area(faces));
            return more.error + (fewer.error - more.error) * share;
        }
        const double share = share_between(log_of(more.faces), log_of(fewer.faces), log_of(faces));
        return {power_between(more.error.unlit, fewer.error.unlit, share),
                power_between(more.error.lit, fewer.error.lit, share)};
    }
    return tried.back().error;
}

std::uint64_t as_first_rounding(std::span<const TriedRounding> roundings, std::size_t rounding,
                                std::uint64_t bytes) {
    if (rounding == 0) return bytes;
    const double factor =
        static_cast<double>(roundings[0].bytes) / static_cast<double>(roundings[rounding].bytes);
    return static_cast<std::uint64_t>(std::round(factor * static_cast<double>(bytes)));
}

std::vector<ResultChoice> result_choices(std::span<const TriedFaces> faces, const TriedImages& images,
                                         std::span<const TriedRounding> roundings, std::uint64_t bytes) {
    const ImageAllocator allocator(images);
    std::vector<ResultChoice> result;
    for (std::size_t r = 0; r < roundings.size(); ++r) {
        const auto rounded = [&](std::uint64_t first) {
            const double factor =
                static_cast<double>(roundings[r].bytes) / static_cast<double>(roundings[0].bytes);
            return static_cast<std::uint64_t>(std::ceil(factor * static_cast<double>(first)));
        };
        if (allocator.least().bytes > bytes) break;
        const std::uint64_t most = rounded(faces.front().bytes), least = rounded(faces.back().bytes);
        double geometry = static_cast<double>(std::min(most, bytes - allocator.least().bytes));
        for (; geometry >= static_cast<double>(least); geometry *= geometry_ratio) {
            const auto taken = static_cast<std::uint64_t>(geometry);
            const std::optional<std::uint64_t> count =
                faces_within(faces, as_first_rounding(roundings, r, taken));
            if (!count) break;
            const auto error_with = [&](std::uint64_t n) {
                return error_of_faces(faces, n) + roundings[r].error;
            };
            Allocation chosen = allocator.within(bytes - taken, error_with(*count));
            // Images that do not use all their bytes leave more for faces.
            const std::uint64_t more =
                *faces_within(faces, as_first_rounding(roundings, r, bytes - chosen.bytes));
            PictureDifference error = allocator.error_of(chosen.chosen);
            error += error_with(more);
            result.push_back({std::move(chosen.chosen), chosen.bytes, r, more, picture_psnr(error)});
            if (least == most) break;
        }
    }
    std::stable_sort(result.begin(), result.end(), [](const ResultChoice& a, const ResultChoice& b) {
        if (std::isnan(a.psnr) || std::isnan(b.psnr)) return !std::isnan(a.psnr) && std::isnan(b.psnr);
        return a.psnr > b.psnr;
    });
    return result;
}

std::vector<std::size_t> smallest_images(const TriedImages& images) {
    return ImageAllocator(images).least().chosen;
}

}  // namespace faqem::detail

#include "cli/budget/budget_choices.hpp"

#include <algorithm>
#include <cmath>

namespace faqem::cli {

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

PictureError error_of_faces(std::span<const TriedFaces> tried, std::uint64_t faces) {
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
            const auto between = [&](double a, double b) { return a + share * (b - a); };
            return {between(more.error.unlit, fewer.error.unlit), between(more.error.lit, fewer.error.lit)};
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
    return static_cast<std::uint64_t>(factor * static_cast<double>(bytes));
}

std::vector<BudgetChoice> budget_choices(std::span<const TriedFaces> faces,
                                         std::span<const TriedImages> images,
                                         std::span<const TriedRounding> roundings, std::uint64_t bytes) {
    std::vector<BudgetChoice> result;
    for (std::size_t i = 0; i < images.size(); ++i) {
        if (images[i].bytes >= bytes) continue;
        for (std::size_t r = 0; r < roundings.size(); ++r) {
            const std::optional<std::uint64_t> count =
                faces_within(faces, as_first_rounding(roundings, r, bytes - images[i].bytes));
            if (!count) continue;
            PictureError error = error_of_faces(faces, *count);
            error.unlit += images[i].error.unlit + roundings[r].error.unlit;
            error.lit += images[i].error.lit + roundings[r].error.lit;
            result.push_back({i, r, *count, picture_psnr(error)});
        }
    }
    std::stable_sort(result.begin(), result.end(), [](const BudgetChoice& a, const BudgetChoice& b) {
        if (std::isnan(a.psnr) || std::isnan(b.psnr)) return !std::isnan(a.psnr) && std::isnan(b.psnr);
        return a.psnr > b.psnr;
    });
    return result;
}

}  // namespace faqem::cli

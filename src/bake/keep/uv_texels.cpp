#include "bake/keep/uv_texels.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "asset/image/texel_reading.hpp"

namespace faqem::detail {
namespace {

// If all triangles together show this many times the texels of the image, it is a pattern that is repeated on the
// surface, and all of it is taken to be shown.
constexpr double max_repetitions = 4;

struct Texel {
    double x, y;
};

// Least and largest x of a triangle between two heights.
std::pair<double, double> range_between(const std::array<Texel, 3>& t, double top, double bottom) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    const auto add = [&](double x) {
        low = std::min(low, x);
        high = std::max(high, x);
    };
    for (std::size_t k = 0; k < 3; ++k) {
        const Texel &p = t[k], &q = t[(k + 1) % 3];
        if (p.y >= top && p.y <= bottom) add(p.x);
        for (const double y : {top, bottom}) {
            if ((p.y <= y) != (q.y <= y)) add(p.x + (y - p.y) / (q.y - p.y) * (q.x - p.x));
        }
    }
    return {low, high};
}

}  // namespace

UvTexels::UvTexels(std::uint32_t width, std::uint32_t height)
    : width_(width), height_(height), shown_(std::size_t{width} * height, 0) {}

void UvTexels::add(const std::array<Vec2f, 3>& uv, Wrap wrap_u, Wrap wrap_v) {
    std::array<Texel, 3> t;
    for (std::size_t k = 0; k < 3; ++k) t[k] = {double{uv[k][0]} * width_, double{uv[k][1]} * height_};
    const auto [low_x, high_x] = std::minmax({t[0].x, t[1].x, t[2].x});
    const auto [low_y, high_y] = std::minmax({t[0].y, t[1].y, t[2].y});
    constexpr double largest = 1e9;  // as MipImage::sample()
    const bool is_bounded = std::max(std::abs(low_x), std::abs(high_x)) < largest &&
                            std::max(std::abs(low_y), std::abs(high_y)) < largest;
    if (!is_bounded) return;
    is_empty_ = false;
    repetitions_ += (high_x - low_x + 2) * (high_y - low_y + 2) / (2.0 * width_ * height_);
    if (!(repetitions_ <= max_repetitions)) return;
    const auto index = [](double x) { return static_cast<std::int64_t>(std::floor(x)); };
    for (std::int64_t y = index(low_y - 0.5); y <= index(high_y + 0.5); ++y) {
        const auto row = static_cast<double>(y);
        const auto [left, right] = range_between(t, row - 0.5, row + 1.5);
        if (!(left <= right)) continue;
        std::uint8_t* const to =
            &shown_[static_cast<std::size_t>(wrapped_texel(y, height_, wrap_v)) * width_];
        for (std::int64_t x = index(left - 0.5); x <= index(right + 0.5); ++x)
            to[wrapped_texel(x, width_, wrap_u)] = 1;
    }
}

std::vector<std::uint8_t> UvTexels::finish() && {
    if (is_empty_ || !(repetitions_ <= max_repetitions))
        std::fill(shown_.begin(), shown_.end(), std::uint8_t{1});
    return std::move(shown_);
}

}  // namespace faqem::detail

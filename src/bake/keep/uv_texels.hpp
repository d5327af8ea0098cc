#pragma once
/// \file
/// The texels of an image that triangles with texture coordinates show.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "bake/atlas/point2.hpp"
#include "faqem/asset.hpp"
#include "render/texture_sampling.hpp"

namespace faqem::detail {

/// If all triangles together show this many times the texels of the image, it is a pattern that is repeated on the
/// surface, and all of it is taken to be shown.
inline constexpr double max_repetitions = 4;

/// Least and largest x of a triangle between two heights.
inline std::array<double, 2> range_between(const Triangle2& t, double top, double bottom) {
    const std::array above = crossing_range(t, top), below = crossing_range(t, bottom);
    std::array range = {std::min(above[0], below[0]), std::max(above[1], below[1])};
    for (const Point2& p : t)
        if (p.y >= top && p.y <= bottom) range = {std::min(range[0], p.x), std::max(range[1], p.x)};
    return range;
}

/// Marks the texels of an image that triangles show.
class UvTexels {
public:
    /// \param width, height  of the image, > 0
    UvTexels(std::uint32_t width, std::uint32_t height)
        : width_(width), height_(height), shown_(std::size_t{width} * height, 0) {}

    /// Marks the texels of a triangle, and those around it that bilinear filtering reads. Parts outside the image
    /// are marked according to the wrap modes.
    /// \param uv  of the corners, after the texture's transform, v pointing down
    /// Complexity: O(texels that are marked); at most O(texels of the image) over all calls.
    void add(const std::array<Vec2f, 3>& uv, Wrap wrap_u, Wrap wrap_v) {
        Triangle2 t;
        constexpr double largest = 1e9;  // as MipImage::sample()
        for (std::size_t k = 0; k < 3; ++k) {
            t[k] = {double{uv[k][0]} * width_, double{uv[k][1]} * height_};
            if (!(std::abs(t[k].x) < largest && std::abs(t[k].y) < largest)) return;
        }
        const Box2 box = bounding_box(t);
        is_empty_ = false;
        repetitions_ += (box.width() + 2) * (box.height() + 2) / (2.0 * width_ * height_);
        if (!(repetitions_ <= max_repetitions)) return;
        const auto index = [](double x) { return static_cast<std::int64_t>(std::floor(x)); };
        for (std::int64_t y = index(box.low.y - 0.5); y <= index(box.high.y + 0.5); ++y) {
            const auto row = static_cast<double>(y);
            const auto [left, right] = range_between(t, row - 0.5, row + 1.5);
            if (!(left <= right)) continue;
            std::uint8_t* const to =
                &shown_[static_cast<std::size_t>(wrapped_texel(y, height_, wrap_v)) * width_];
            for (std::int64_t x = index(left - 0.5); x <= index(right + 0.5); ++x)
                to[wrapped_texel(x, width_, wrap_u)] = 1;
        }
    }

    /// By texel, top row first: nonzero if it is shown. All texels, if none was marked, or if the image is repeated
    /// on the surface.
    std::vector<std::uint8_t> finish() && {
        if (is_empty_ || !(repetitions_ <= max_repetitions)) std::ranges::fill(shown_, std::uint8_t{1});
        return std::move(shown_);
    }

private:
    std::uint32_t width_, height_;
    std::vector<std::uint8_t> shown_;
    bool is_empty_ = true;
    double repetitions_ = 0;  // area of all triangles, in images
};

}  // namespace faqem::detail

#include "bake/page/shown_texels.hpp"

#include <algorithm>
#include <cmath>

namespace faqem::detail {
namespace {

// Index of the texel that contains a coordinate.
std::uint32_t texel_at(double coordinate, std::uint32_t size) {
    return static_cast<std::uint32_t>(std::clamp(coordinate, 0.0, size - 1.0));
}

// Marks the texels of a row whose centres are between the edges of a triangle.
void mark_row(const Triangle2& t, std::uint32_t y, std::uint32_t width, std::uint8_t* row) {
    const auto [left, right] = crossing_range(t, y + 0.5);
    if (!(left <= right)) return;
    const double first = std::max(std::ceil(left - 0.5), 0.0);
    const double last = std::min(std::floor(right - 0.5), width - 1.0);
    for (double x = first; x <= last; ++x) row[static_cast<std::size_t>(x)] = 1;
}

}  // namespace

std::vector<std::uint8_t> shown_texels(const Atlas& atlas) {
    std::vector<std::uint8_t> shown(std::size_t{atlas.width} * atlas.height, 0);
    for (const auto& placement : atlas.placements) {
        const Triangle2& t = placement.uv;
        const auto [low, high] = std::minmax({t[0].y, t[1].y, t[2].y});
        if (!std::isfinite(low) || !std::isfinite(high)) continue;
        for (std::uint32_t y = texel_at(low, atlas.height); y <= texel_at(high, atlas.height); ++y)
            mark_row(t, y, atlas.width, &shown[std::size_t{y} * atlas.width]);
        const double x = (t[0].x + t[1].x + t[2].x) / 3, y = (t[0].y + t[1].y + t[2].y) / 3;
        if (!std::isfinite(x)) continue;
        shown[std::size_t{texel_at(y, atlas.height)} * atlas.width + texel_at(x, atlas.width)] = 1;
    }
    return shown;
}

}  // namespace faqem::detail

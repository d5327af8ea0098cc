#include "render/occlusion.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "render/rasterizer.hpp"

namespace faqem::render {

namespace {

constexpr int directions = 12;
constexpr std::array<double, 3> radii = {0.006, 0.017, 0.04};  // fractions of the image size
constexpr double strength = 0.85;
constexpr double min_elevation_sine = 0.08;  // avoids occlusion on nearly flat surfaces of small faces

/// Position of the surface at a pixel, relative to the eye.
Vector3 point(const SurfelImage& surfels, const Camera& camera, std::int64_t x, std::int64_t y,
              double inverse_depth) {
    const double half = surfels.size / 2.0, depth = 1 / inverse_depth;
    return depth * (surfels.tan_half_fov * ((static_cast<double>(x) + 0.5 - half) / half * camera.right -
                                            (static_cast<double>(y) + 0.5 - half) / half * camera.up) -
                    camera.back);
}

struct Offset {
    std::int64_t x, y;
    double radius;
};
constexpr int rotations = 16;
using Pattern = std::vector<Offset>;

/// Offsets of the sampled neighbours in pixels, for each rotation of the pattern.
std::array<Pattern, rotations> patterns(std::uint32_t size) {
    std::array<Pattern, rotations> result;
    for (int r = 0; r < rotations; ++r) {
        for (const double radius : radii) {
            for (int d = 0; d < directions; ++d) {
                const double angle =
                    2 * std::numbers::pi / directions * (d + static_cast<double>(r) / rotations);
                result[static_cast<std::size_t>(r)].push_back({std::lround(radius * size * std::cos(angle)),
                                                               std::lround(radius * size * std::sin(angle)),
                                                               radius});
            }
        }
    }
    return result;
}

double accessibility_at(const SurfelImage& surfels, const Camera& camera, const Pattern& pattern,
                        std::int64_t x, std::int64_t y) {
    const auto size = static_cast<std::int64_t>(surfels.size);
    const Surfel& here = surfels.pixels[static_cast<std::size_t>(y * size + x)];
    const Vector3 p = point(surfels, camera, x, y, here.inverse_depth), n = here.normal.cast<double>();
    double occluded = 0;
    for (const Offset& offset : pattern) {
        const std::int64_t u = x + offset.x, v = y + offset.y;
        if (u < 0 || v < 0 || u >= size || v >= size) continue;
        const Surfel& there = surfels.pixels[static_cast<std::size_t>(v * size + u)];
        if (!(there.inverse_depth > 0)) continue;
        const Vector3 q = point(surfels, camera, u, v, there.inverse_depth) - p;
        const double distance = q.norm(), rise = q.dot(n);
        if (!(rise > min_elevation_sine * distance)) continue;
        const double reach = offset.radius * 2 * surfels.tan_half_fov / here.inverse_depth;
        occluded += (rise / distance - min_elevation_sine) * std::max(0.0, 1 - distance / (3 * reach));
    }
    return 1 - strength * std::min(1.0, occluded / (0.35 * static_cast<double>(pattern.size())));
}

}  // namespace

std::vector<float> ambient_accessibility(const SurfelImage& surfels, const Camera& camera) {
    std::vector<float> result(surfels.pixels.size(), 1.0f);
    const auto size = static_cast<std::int64_t>(surfels.size);
    const auto by_rotation = patterns(surfels.size);
    for (std::int64_t y = 0; y < size; ++y) {
        for (std::int64_t x = 0; x < size; ++x) {
            // Rotations are arranged in tiles of 4 x 4 samples; 2 x 2 samples are averaged to a pixel.
            const auto rotation = static_cast<std::size_t>(x % 4 * 4 + y % 4 * 5) % rotations;
            const auto i = static_cast<std::size_t>(y * size + x);
            if (surfels.pixels[i].inverse_depth > 0)
                result[i] =
                    static_cast<float>(accessibility_at(surfels, camera, by_rotation[rotation], x, y));
        }
    }
    return result;
}

}  // namespace faqem::render

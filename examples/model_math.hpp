#pragma once
/// \file
/// Vectors, smooth steps and noise for the example model. The noise is computed from an integer hash, so that
/// the model is reproducible.

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "faqem/mesh.hpp"

namespace model {

using faqem::Vec3;

inline constexpr double pi = 3.14159265358979323846;

inline Vec3 add(const Vec3& a, const Vec3& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
inline Vec3 subtract(const Vec3& a, const Vec3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline Vec3 scaled(const Vec3& a, double s) { return {s * a[0], s * a[1], s * a[2]}; }
inline double dot(const Vec3& a, const Vec3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline Vec3 cross(const Vec3& a, const Vec3& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline Vec3 unit(const Vec3& a) {
    const double length = std::sqrt(dot(a, a));
    return length > 0 ? scaled(a, 1 / length) : a;
}
/// Linear interpolation, clamped: a for t <= 0, b for t >= 1.
inline Vec3 mix(const Vec3& a, const Vec3& b, double t) {
    const double u = std::clamp(t, 0.0, 1.0);
    return add(scaled(a, 1 - u), scaled(b, u));
}

/// 0 below `from`, 1 above `to`, a cubic in between.
inline double smooth_step(double from, double to, double x) {
    const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

/// 1 within a line of half-width w around distance 0, with smooth edges.
inline double line(double distance, double w) {
    return 1 - smooth_step(w - 0.002, w + 0.002, std::abs(distance));
}

/// 1 inside (from, to), with smooth transitions of width `edge` inside both ends.
inline double window(double from, double to, double edge, double x) {
    return smooth_step(from, from + edge, x) * (1 - smooth_step(to - edge, to, x));
}

inline double fraction(double x) { return x - std::floor(x); }

/// Distance from x to the centre of its unit interval, in [0, 0.5].
inline double from_middle(double x) { return std::abs(fraction(x) - 0.5); }

inline std::uint32_t hash(std::int64_t x, std::int64_t y, std::uint32_t salt) {
    auto h = static_cast<std::uint64_t>(x) * 0x9e3779b97f4a7c15u ^
             static_cast<std::uint64_t>(y) * 0xc2b2ae3d27d4eb4fu ^
             (std::uint64_t{salt} + 1) * 0x165667b19e3779f9u;
    h = (h ^ (h >> 31)) * 0xd6e8feb86659fd93u;
    h = (h ^ (h >> 32)) * 0xd6e8feb86659fd93u;
    return static_cast<std::uint32_t>(h >> 32);
}

inline double random(std::int64_t x, std::int64_t y, std::uint32_t salt) {
    return hash(x, y, salt) / 4294967296.0;
}

/// Smooth value noise in [0, 1] with cells of size 1; repeats in x every `period` cells.
inline double noise(double x, double y, std::int64_t period, std::uint32_t salt) {
    const double fx = std::floor(x), fy = std::floor(y);
    const auto ix = static_cast<std::int64_t>(fx), iy = static_cast<std::int64_t>(fy);
    const auto at = [&](std::int64_t dx, std::int64_t dy) {
        return random(((ix + dx) % period + period) % period, iy + dy, salt);
    };
    const double s = smooth_step(0, 1, x - fx), t = smooth_step(0, 1, y - fy);
    return (1 - t) * ((1 - s) * at(0, 0) + s * at(1, 0)) + t * ((1 - s) * at(0, 1) + s * at(1, 1));
}

/// Cellular noise: the difference between the distances to the second-nearest and the nearest of randomly
/// scattered points, one per cell of size 1. Small values form thin lines like cracks in a glaze. Repeats in
/// x every `period` cells.
inline double crack_distance(double x, double y, std::int64_t period, std::uint32_t salt) {
    const auto ix = static_cast<std::int64_t>(std::floor(x)), iy = static_cast<std::int64_t>(std::floor(y));
    double first = 1e9, second = 1e9;
    for (std::int64_t dy = -1; dy <= 1; ++dy) {
        for (std::int64_t dx = -1; dx <= 1; ++dx) {
            const std::int64_t cx = ((ix + dx) % period + period) % period, cy = iy + dy;
            const double px = static_cast<double>(ix + dx) + random(cx, cy, salt) - x;
            const double py = static_cast<double>(iy + dy) + random(cx, cy, salt + 1) - y;
            const double d = std::sqrt(px * px + py * py);
            if (d < first) {
                second = first;
                first = d;
            } else if (d < second) {
                second = d;
            }
        }
    }
    return second - first;
}

/// Distance from (x, y) to the segment between (ax, ay) and (bx, by).
inline double segment_distance(double x, double y, double ax, double ay, double bx, double by) {
    const double dx = bx - ax, dy = by - ay, length_squared = dx * dx + dy * dy;
    const double t =
        length_squared > 0 ? std::clamp(((x - ax) * dx + (y - ay) * dy) / length_squared, 0.0, 1.0) : 0.0;
    const double ex = x - ax - t * dx, ey = y - ay - t * dy;
    return std::sqrt(ex * ex + ey * ey);
}

}  // namespace model

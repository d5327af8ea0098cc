#include <array>

#include "model_parts.hpp"

namespace model {

namespace {

/// Centre line of a handle in a plane through the axis, for t in [0, 1]: from the shoulder outwards, upwards,
/// and back to the neck below the lip.
struct CentreLine {
    std::array<Vec3, 8> knots;  ///< distance from the axis, height, 0

    Vec3 at(double t) const {
        const double x = std::clamp(t, 0.0, 1.0) * (knots.size() - 3.0);
        const auto i = std::min(static_cast<std::size_t>(x), knots.size() - 4);
        const double u = x - static_cast<double>(i);
        // A uniform cubic B-spline, which has continuous curvature and does not interpolate the knots.
        const double b0 = (1 - u) * (1 - u) * (1 - u) / 6, b1 = (3 * u * u * u - 6 * u * u + 4) / 6;
        const double b2 = (-3 * u * u * u + 3 * u * u + 3 * u + 1) / 6, b3 = u * u * u / 6;
        return add(add(scaled(knots[i], b0), scaled(knots[i + 1], b1)),
                   add(scaled(knots[i + 2], b2), scaled(knots[i + 3], b3)));
    }
    Vec3 tangent(double t) const { return unit(subtract(at(t + 1e-4), at(t - 1e-4))); }
};

constexpr CentreLine handle_line = {{{{0.30, 1.92, 0},
                                      {0.74, 1.98, 0},
                                      {1.22, 1.98, 0},
                                      {1.46, 2.42, 0},
                                      {1.34, 2.92, 0},
                                      {0.86, 3.02, 0},
                                      {0.45, 2.82, 0},
                                      {0.02, 2.62, 0}}}};

/// Rotates a point of the plane of the centre line around the axis.
Vec3 around(const Vec3& p, double angle) {
    return {p[0] * std::sin(angle) - p[2] * std::cos(angle), p[1],
            p[0] * std::cos(angle) + p[2] * std::sin(angle)};
}

/// A tube with an elliptic cross-section along a handle.
struct Tube {
    double angle;     ///< of the handle around the axis, radians
    double radius;    ///< long half-axis of the cross-section
    double flatness;  ///< ratio of the long to the short axis of the cross-section
    double twists;    ///< number of revolutions of the cross-section over the length
    double winding;   ///< number of revolutions of the tube around the centre line
    double distance;  ///< from the centre line
};

Vec3 tube_point(const Tube& tube, double s, double t) {
    const Vec3 centre = handle_line.at(t), along = handle_line.tangent(t);
    const Vec3 out = {-along[1], along[0], 0}, across = cross(along, out);
    const double swell = 1 + 0.35 * std::pow(2 * t - 1, 4.0), end = t == 0 || t == 1 ? 0 : 1;
    const double wind = 2 * pi * tube.winding * t, twist = 2 * pi * tube.twists * t, phi = 2 * pi * s;
    const double a = tube.radius * swell * end, b = a / tube.flatness;
    const double x = a * std::cos(phi), y = b * std::sin(phi);
    const double u = tube.distance * std::cos(wind) + x * std::cos(twist) - y * std::sin(twist);
    const double v = tube.distance * std::sin(wind) + x * std::sin(twist) + y * std::cos(twist);
    return around(add(centre, add(scaled(out, u), scaled(across, v))), tube.angle);
}

Grid tube_grid(const Tube& tube, int columns, int rows, std::function<Vec3(double, double)> paint) {
    Grid grid;
    grid.columns = columns;
    grid.rows = rows;
    grid.position = [=](int column, int row) {
        return tube_point(tube, double(column % columns) / columns, double(row) / rows);
    };
    grid.paint = std::move(paint);
    return grid;
}

Vec3 paint_handle(double s, double t) {
    const double bands = from_middle(22 * t + 2 * s);
    Vec3 colour = mix(cobalt, night, noise(8 * s, 60 * t, 8, 23));
    colour = mix(colour, gold, line(bands, 0.07));
    colour = mix(colour, ivory, line(std::abs(bands - 0.0) - 0.16, 0.02));
    const double dots = std::hypot((fraction(2 * s) - 0.5) * 1.5, (fraction(22 * t + 2 * s + 0.5) - 0.5));
    return mix(colour, coral, 1 - smooth_step(0.12, 0.16, dots));
}

Vec3 paint_vine(double s, double t) {
    const Vec3 colour = mix(gold, scaled(gold, 0.7), noise(4 * s, 160 * t, 4, 29));
    return mix(colour, jade, line(from_middle(70 * t + s) - 0.5, 0.14));
}

/// A thin closed solid around a mid-surface: `middle` maps s in [-1, 1] across and t in [0, 1] along to a
/// point.
struct Blade {
    std::function<Vec3(double, double)> middle;
    double thickness;
};

Vec3 blade_point(const Blade& blade, double s, double t, double side) {
    const Vec3 p = blade.middle(s, t);
    // Exactly zero at the outline, where both sides have the same positions.
    const double half = 0.5 * blade.thickness * (1 - s * s) * std::min(1.0, 12 * std::min(t, 1 - t));
    if (half == 0) return p;
    const double e = 1e-3;
    const Vec3 across = subtract(blade.middle(s + e, t), blade.middle(s - e, t));
    const Vec3 along = subtract(blade.middle(s, t + e), blade.middle(s, t - e));
    return add(p, scaled(unit(cross(across, along)), side * half));
}

/// Adds the two sides of a blade as two grids with different colours.
void add_blade(std::vector<Grid>& grids, const Blade& blade, int columns, int rows, double width,
               double length, const std::function<Vec3(double, double)>& front,
               const std::function<Vec3(double, double)>& back) {
    for (const double side : {1.0, -1.0}) {
        Grid grid;
        grid.columns = columns;
        grid.rows = rows;
        grid.position = [=](int column, int row) {
            // The columns of the back run in the opposite direction, so that its faces are oriented outwards.
            const int mirrored_column = side > 0 ? column : columns - column;
            return blade_point(blade, double(2 * mirrored_column - columns) / columns, double(row) / rows,
                               side);
        };
        grid.paint = side > 0 ? front : back;
        grid.charts = split_into_charts(grid, 1, 1, width, length);
        grids.push_back(std::move(grid));
    }
}

/// An acanthus leaf close to the belly, with a tip that curls outwards.
Blade leaf(double angle) {
    const double begin = band_begin(band::petals) + 0.012, end = band_begin(band::petals) + 0.195;
    return {
        [=](double s, double t) -> Vec3 {
            const ProfilePoint p = profile(begin + (end - begin) * t);
            const double lobes = 1 + 0.16 * std::cos(2 * pi * (5.5 * t + 0.1 * std::abs(s)));
            const double width =
                0.15 * (0.12 + std::pow(std::sin(pi * std::pow(std::min(t, 1.0) * 0.96 + 0.02, 0.8)), 0.8)) *
                lobes;
            // The offset is horizontal, because the normal of the body points downwards here.
            const double curl = 0.05 + 0.03 * t + 0.09 * std::pow(t, 6.0) + 0.03 * s * s;
            const double radius = p.radius + curl, height = p.height - 0.3 * curl - 0.07 * std::pow(t, 8.0);
            const Vec3 centre = {radius * std::sin(angle), height, radius * std::cos(angle)};
            const Vec3 across = {std::cos(angle), 0, -std::sin(angle)};
            return add(centre, scaled(across, width * s));
        },
        0.016};
}

/// A feather on the shoulder, in a plane through the axis, with a barbed edge.
Blade feather(double angle) {
    return {[=](double s, double t) -> Vec3 {
                const double rise = 0.72 * t, sweep = 0.16 * std::sin(0.9 * pi * t) + 0.20 * t * t;
                const double barbs = s > 0 ? 1 + 0.14 * std::abs(std::sin(9 * pi * t)) * s : 1;
                const double width =
                    0.115 * (0.10 + std::pow(std::sin(pi * std::pow(0.94 * t + 0.03, 0.7)), 0.9)) * barbs;
                const double bend = 0.35 * t * t;
                const Vec3 centre = {0.80 + sweep, 2.12 + rise, 0};
                const Vec3 across = unit({1, -0.55 + 0.5 * t, 0});
                const Vec3 p = add(centre, scaled(across, width * s));
                return around(
                    {p[0] * std::cos(bend * 0.4), p[1], p[0] * std::sin(bend * 0.4) + 0.03 * std::sin(3 * s)},
                    angle);
            },
            0.014};
}

Vec3 paint_leaf_front(double s, double t) {
    const double x = std::abs(2 * s - 1);
    Vec3 colour = mix(jade, {0.45, 0.62, 0.25}, 0.8 * noise(5 * s, 14 * t, 1000, 31) * t + 0.2 * x);
    colour = mix(colour, gold, 0.9 * line(from_middle(11 * t - 2.6 * x) - 0.5, 0.06));
    colour = mix(colour, ivory,
                 line(x, 0.05) + 0.8 * line(from_middle(44 * t - 10.4 * x) - 0.5, 0.07) * (x > 0.5 ? 1 : 0));
    return mix(colour, gold, smooth_step(0.88, 0.92, x));
}

Vec3 paint_leaf_back(double s, double t) {
    const double x = std::abs(2 * s - 1);
    const Vec3 colour = mix(coral, umber, 0.6 * noise(6 * s, 18 * t, 1000, 37));
    return mix(colour, ivory, line(from_middle(16 * t - 2 * x) - 0.5, 0.08) + line(x, 0.04));
}

Vec3 paint_feather_front(double s, double t) {
    const double x = 2 * s - 1, barb = from_middle(34 * t - 2.2 * std::abs(x)) - 0.5;
    Vec3 colour = mix(sky, cobalt, smooth_step(0.0, 0.8, t + 0.2 * std::abs(x)));
    colour = mix(colour, ivory, 0.7 * line(barb, 0.10));
    const double eye = std::hypot(x * 0.8, (t - 0.72) * 4);
    colour = mix(colour, gold, 1 - smooth_step(0.50, 0.54, eye));
    colour = mix(colour, jade, 1 - smooth_step(0.36, 0.40, eye));
    colour = mix(colour, night, 1 - smooth_step(0.18, 0.22, eye));
    return mix(colour, ivory, line(x, 0.035) * (t < 0.6 ? 1 : 0));
}

Vec3 paint_feather_back(double s, double t) {
    const double x = 2 * s - 1, barb = from_middle(34 * t + 2.2 * std::abs(x)) - 0.5;
    return mix(mix(gold, coral, t), umber, 0.8 * line(barb, 0.12) + line(x, 0.04));
}

}  // namespace

std::vector<Grid> ornaments(double detail) {
    const auto lines = [detail](double n) { return std::max(4, static_cast<int>(std::lround(n * detail))); };
    std::vector<Grid> grids;
    for (const double angle : {0.5 * pi, 1.5 * pi}) {
        Grid handle = tube_grid({angle, 0.075, 1.9, 3, 0, 0}, 2 * lines(13), 3 * lines(88), paint_handle);
        handle.charts = split_into_charts(handle, 2, 3, 0.40, 2.3);
        grids.push_back(std::move(handle));
        Grid vine = tube_grid({angle, 0.020, 1, 0, 7, 0.105}, 2 * lines(4), 6 * lines(70), paint_vine);
        vine.charts = split_into_charts(vine, 1, 6, 0.11, 3.6);
        grids.push_back(std::move(vine));
    }
    for (int i = 0; i < 10; ++i) {
        add_blade(grids, leaf(2 * pi * (i + 0.5) / 10), 2 * lines(8), lines(44), 0.28, 0.62, paint_leaf_front,
                  paint_leaf_back);
    }
    for (int i = 0; i < 8; ++i) {
        const double off_front = (i % 4 - 1.5) * 0.19 * pi;
        // The side with the eye faces the front or the back of the urn.
        const bool mirrored = off_front < 0;
        add_blade(grids, feather((i < 4 ? 0 : 1) * pi + off_front), 2 * lines(7), lines(60), 0.20, 0.68,
                  mirrored ? paint_feather_back : paint_feather_front,
                  mirrored ? paint_feather_front : paint_feather_back);
    }
    return grids;
}

}  // namespace model

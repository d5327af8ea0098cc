// Painting of the body. Lengths are in model units, unless they are relative to a cell.

#include <array>
#include <string_view>

#include "model_parts.hpp"

namespace model {

namespace {

/// One cell of the meander pattern; '#' is painted.
constexpr std::array<std::string_view, 7> key = {"#######.", "#.....#.", "#.###.#.", "#.#...#.",
                                                 "#.#####.", "#.......", "########"};

double key_ink(double x, double y) {
    const auto row = static_cast<std::size_t>(std::clamp(y, 0.0, 0.999) * 7);
    const auto column = static_cast<std::size_t>(fraction(x) * 8);
    return key[row][column] == '#' ? 1 : 0;
}

/// Ink of an invented letter, a random walk of six steps on a 3 x 4 grid, at (x, y) in its unit cell.
double glyph_ink(std::int64_t letter, double x, double y) {
    int ax = static_cast<int>(hash(letter, -1, 41) % 3), ay = static_cast<int>(hash(letter, -2, 41) % 4);
    double nearest = 1;
    for (std::int64_t step = 0; step < 6; ++step) {
        const std::uint32_t h = hash(letter, step, 41);
        const int bx = (ax + 1 + static_cast<int>(h % 2)) % 3,
                  by = std::clamp(ay + static_cast<int>(h / 2 % 3) - 1, 0, 3);
        const bool upright = h / 8 % 2 == 0;
        const int cx = upright ? ax : bx, cy = upright ? (ay + 1 + static_cast<int>(h / 16 % 2)) % 4 : by;
        nearest = std::min(nearest, segment_distance(x, y, 0.20 + 0.30 * ax, 0.08 + 0.28 * ay,
                                                     0.20 + 0.30 * cx, 0.08 + 0.28 * cy));
        ax = cx;
        ay = cy;
    }
    return 1 - smooth_step(0.035, 0.065, nearest);
}

/// Cream glaze with fine cracks and a little dirt.
Vec3 glaze(double turns, double y) {
    const double mottle = 0.6 * noise(60 * turns, 10 * y, 60, 1) + 0.4 * noise(180 * turns, 30 * y, 180, 2);
    Vec3 colour = mix(ivory, scaled(ivory, 0.86), mottle);
    const double crack = crack_distance(90 * turns, 15 * y, 90, 5);
    return mix(colour, umber, 0.45 * (1 - smooth_step(0.012, 0.035, crack)));
}

Vec3 gilding(double turns, double y) {
    const double wear = noise(240 * turns, 40 * y, 240, 7);
    return mix(gold, scaled(gold, 0.72), wear);
}

Vec3 paint_foot(double turns, double t, double y) {
    const double x = 2 * from_middle(10 * turns);
    Vec3 colour = mix(cobalt, night, noise(90 * turns, 15 * y, 90, 11));
    colour = mix(colour, gilding(turns, y), line(x - 0.55, 0.05) * window(0.15, 0.92, 0.05, t));
    colour = mix(colour, ivory, line(from_middle(80 * turns) - 0.0, 0.10) * window(0.90, 0.96, 0.01, t));
    colour = mix(colour, ivory,
                 line(from_middle(t * 12) - 0.0, 0.03) * window(0.15, 0.9, 0.02, t) * (x < 0.45 ? 1 : 0));
    return mix(colour, gilding(turns, y), 1 - smooth_step(0.10, 0.12, t));
}

Vec3 paint_petals(double turns, double t, double y) {
    const double x = 2 * from_middle(20 * turns), side = fraction(20 * turns) - 0.5;
    const double edge = 0.86 * std::sqrt(std::max(0.0, 1 - std::pow(std::max(0.0, t - 0.55) / 0.40, 2.0)));
    const bool even = static_cast<std::int64_t>(std::floor(20 * turns)) % 2 == 0;
    const Vec3 ground = mix(jade, scaled(jade, 0.6), noise(100 * turns, 16 * y, 100, 13));
    Vec3 petal = even ? glaze(turns, y) : mix(sky, cobalt, smooth_step(0.1, 0.9, 1 - t));
    const double vein = from_middle(14 * t + 3.2 * std::abs(side)) - 0.0;
    petal = mix(petal, even ? cobalt : ivory, 0.85 * line(vein, 0.05) * smooth_step(0.06, 0.12, x));
    petal = mix(petal, coral,
                line(x, 0.05) + (1 - smooth_step(0.05, 0.07, std::hypot(side * 2, (t - 0.84) * 4) - 0.2)));
    Vec3 colour = x < edge ? petal : ground;
    colour = mix(colour, gilding(turns, y), line(x - edge, 0.055) * (t < 0.97 ? 1 : 0));
    const double dots = std::hypot(fraction(20 * turns + 0.5) - 0.5, (t - 0.93) * 3.2);
    return mix(colour, ivory, 1 - smooth_step(0.055, 0.07, dots));
}

Vec3 paint_frieze(double turns, double t, double y) {
    const double rise = relief(2 * pi * turns, band_begin(band::frieze) + t * (band_begin(band::shoulder) -
                                                                               band_begin(band::frieze)));
    const double hatch =
        line(from_middle(190 * turns + 9 * t), 0.10) + line(from_middle(190 * turns - 9 * t), 0.10);
    Vec3 colour = mix(night, cobalt, std::min(1.0, 0.75 * hatch));
    const double ex = (fraction(14 * turns) - 0.5) * 0.45 / 0.40, ey = t - 0.5, r = std::hypot(ex, ey);
    const bool flower = r < 0.14;
    if (rise > 0.008 && !flower) {
        colour = gilding(turns, y);
        const double twist = line(from_middle(112 * turns + 2 * t), 0.12);
        colour = mix(colour, umber, 0.55 * twist);
        colour = mix(colour, umber, 1 - smooth_step(0.008, 0.016, rise));
    }
    if (flower && rise > 0.004) {
        const double angle = std::atan2(ey, ex);
        colour = mix(coral, ivory, line(from_middle(8 * angle / (2 * pi) + 0.5) - 0.5, 0.07));
        colour = mix(colour, gold, 1 - smooth_step(0.038, 0.044, r));
        colour = mix(colour, umber, line(r - 0.05, 0.004));
    }
    const double dots = std::hypot(fraction(56 * turns) - 0.5, (std::abs(t - 0.5) - 0.435) * 5);
    return mix(colour, ivory, 1 - smooth_step(0.16, 0.22, dots));
}

/// A line of letters between two fine lines, the meander pattern below, spiral stripes above.
Vec3 paint_shoulder(double turns, double t, double y) {
    Vec3 colour = glaze(turns, y);
    if (t < 0.24) {
        colour = mix(colour, cobalt, key_ink(40 * turns, (t - 0.03) / 0.18) * (t > 0.03 && t < 0.21 ? 1 : 0));
    } else if (t < 0.56) {
        const double x = 36 * turns, in_cell = (t - 0.28) / 0.24;
        const auto letter = static_cast<std::int64_t>(std::floor(x));
        if (in_cell > 0 && in_cell < 1)
            colour = mix(colour, umber, glyph_ink(letter, fraction(x), 1 - in_cell));
        colour = mix(
            colour, coral,
            line(t - 0.25, 0.005) + line(t - 0.265, 0.002) + line(t - 0.535, 0.002) + line(t - 0.55, 0.005));
    } else {
        const double stripe = fraction(24 * turns + 1.1 * t);
        if (std::abs(stripe - 0.5) > 0.25) colour = mix(cobalt, night, noise(120 * turns, 20 * y, 120, 17));
        colour = mix(colour, gilding(turns, y), line(std::abs(stripe - 0.5) - 0.25, 0.035));
        const double dots = std::hypot(stripe - 0.5, fraction(9 * t) - 0.5);
        colour = mix(colour, coral, 1 - smooth_step(0.08, 0.11, dots));
    }
    return colour;
}

Vec3 paint_neck(double turns, double t, double y) {
    const double u = 9 * turns + 1.5 * t, v = 9 * turns - 1.5 * t;
    const double lattice = std::max(std::cos(2 * pi * u), std::cos(2 * pi * v));
    Vec3 colour = mix(coral, scaled(coral, 0.7), noise(80 * turns, 14 * y, 80, 19));
    const double scales = line(from_middle(4 * u) - 0.5, 0.05) + line(from_middle(4 * v) - 0.5, 0.05);
    colour = mix(colour, scaled(coral, 0.35), std::min(1.0, scales));
    colour = mix(colour, gilding(turns, y), smooth_step(0.45, 0.55, lattice));
    colour = mix(colour, ivory, line(lattice - 0.5, 0.06));
    const double dots = std::hypot(fraction(2 * u) - 0.5, fraction(2 * v) - 0.5);
    return mix(colour, night, 0.9 * (1 - smooth_step(0.07, 0.10, dots)));
}

Vec3 paint_lip(double turns, double t, double y) {
    Vec3 colour = glaze(turns, y);
    const double egg = std::hypot(fraction(28 * turns) - 0.5, (t - 0.43) * 0.9);
    colour = mix(cobalt, colour, 1 - smooth_step(0.33, 0.35, egg));
    colour = mix(colour, gilding(turns, y), line(egg - 0.37, 0.03));
    colour = mix(colour, coral, 1 - smooth_step(0.10, 0.13, egg));
    if (t > 0.74) {
        colour = mix(night, gilding(turns, y),
                     key_ink(56 * turns, (0.93 - t) / 0.16) * (t > 0.77 && t < 0.93 ? 1 : 0));
        colour = mix(colour, gilding(turns, y), smooth_step(0.95, 0.96, t) + line(t - 0.75, 0.006));
    }
    return colour;
}

}  // namespace

Vec3 paint_body(double angle, double arc) {
    const double turns = fraction(angle / (2 * pi)), y = 5.4 * arc;
    int b = band::base;
    while (b + 1 < band::count && arc > band_begin(b + 1)) ++b;
    const double t = (arc - band_begin(b)) / (band_begin(b + 1) - band_begin(b));
    Vec3 colour = umber;
    if (b == band::foot) colour = paint_foot(turns, t, y);
    if (b == band::knot) colour = mix(gilding(turns, y), coral, line(from_middle(14 * turns), 0.2));
    if (b == band::petals) colour = paint_petals(turns, t, y);
    if (b == band::frieze) colour = paint_frieze(turns, t, y);
    if (b == band::shoulder) colour = paint_shoulder(turns, t, y);
    if (b == band::neck) colour = paint_neck(turns, t, y);
    if (b == band::lip) colour = paint_lip(turns, t, y);
    for (const int border : {band::petals, band::frieze, band::shoulder, band::neck, band::lip}) {
        colour = mix(colour, gilding(turns, y), line(arc - band_begin(border), 0.006));
        colour = mix(colour, umber, line(std::abs(arc - band_begin(border)) - 0.0075, 0.0008));
    }
    return colour;
}

}  // namespace model

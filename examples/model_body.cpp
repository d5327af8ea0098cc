#include <array>

#include "model_parts.hpp"

namespace model {

namespace {

struct Knot {
    double radius, height;
};

// The profile curve, from the axis below the foot to the rim.
constexpr std::array<Knot, 24> outline = {{
    {0.00, 0.00}, {0.30, 0.00}, {0.60, 0.00}, {0.67, 0.05}, {0.62, 0.13}, {0.42, 0.22},
    {0.27, 0.33}, {0.21, 0.45}, {0.28, 0.52}, {0.21, 0.59}, {0.30, 0.70}, {0.58, 0.90},
    {0.83, 1.15}, {0.99, 1.45}, {1.03, 1.68}, {0.99, 1.92}, {0.86, 2.15}, {0.66, 2.32},
    {0.50, 2.45}, {0.43, 2.60}, {0.41, 2.76}, {0.46, 2.92}, {0.60, 3.06}, {0.80, 3.13},
}};
// Index of the knot at which each band begins.
constexpr std::array<std::size_t, band::count + 1> band_knots = {0, 2, 7, 9, 13, 15, 18, 21, 23};

/// Catmull-Rom spline through the outline; integer values of x are the knots.
Knot spline(double x) {
    const auto last = outline.size() - 1;
    const auto i = std::min(static_cast<std::size_t>(std::max(x, 0.0)), last - 1);
    const double t = x - static_cast<double>(i);
    const Knot &a = outline[i > 0 ? i - 1 : 0], &b = outline[i], &c = outline[i + 1],
               &d = outline[std::min(i + 2, last)];
    const auto at = [t](double p, double q, double r, double s) {
        return q + 0.5 * t * (r - p + t * (2 * p - 5 * q + 4 * r - s + t * (3 * (q - r) + s - p)));
    };
    return {std::max(0.0, at(a.radius, b.radius, c.radius, d.radius)),
            at(a.height, b.height, c.height, d.height)};
}

/// Table of the outline's arc length over the spline parameter.
struct ArcLength {
    static constexpr int steps = 4600;
    std::array<double, steps + 1> length = {};

    static double parameter(int step) { return (outline.size() - 1.0) * step / steps; }

    ArcLength() {
        Knot before = spline(0);
        for (int i = 1; i <= steps; ++i) {
            const Knot here = spline(parameter(i));
            const double dr = here.radius - before.radius, dh = here.height - before.height;
            length[static_cast<std::size_t>(i)] =
                length[static_cast<std::size_t>(i) - 1] + std::sqrt(dr * dr + dh * dh);
            before = here;
        }
    }
    /// Spline parameter at a share of the total length.
    double at(double share) const {
        const double wanted = share * length.back();
        const auto above = std::upper_bound(length.begin(), length.end(), wanted);
        if (above == length.end()) return parameter(steps);
        const auto i = static_cast<int>(above - length.begin());
        const double low = above[-1], t = *above > low ? (wanted - low) / (*above - low) : 0;
        return parameter(i - 1) + t * (parameter(i) - parameter(i - 1));
    }
};

const ArcLength& arcs() {
    static const ArcLength table;
    return table;
}

/// Height of a ring of half-round moulding around arc length `centre`.
double moulding(double arc, double centre, double half_width, double height) {
    const double x = (arc - centre) / half_width;
    return std::abs(x) < 1 ? height * std::sqrt(1 - x * x) : 0;
}

/// Height of `count` half-ellipsoids around the axis; t in [0, 1] across the band.
double beads(double turns, double t, double count, double height) {
    const double x = 2.2 * (fraction(turns * count) - 0.5), y = 2.2 * (t - 0.5);
    const double d = 1 - x * x - y * y;
    return d > 0 ? height * std::sqrt(d) : 0;
}

/// Height of two interlaced strands with a flower in each gap (a guilloche); t in [0, 1] across the band.
double guilloche(double turns, double t) {
    constexpr double crossings = 14;
    const double phase = pi * crossings * turns, y = t - 0.5;
    double height = 0;
    for (const double sign : {1.0, -1.0}) {
        const double centre = 0.27 * sign * std::sin(phase);
        const double slope = 0.27 * crossings / 2 * 0.16 * std::abs(std::cos(phase));
        const double x = (y - centre) / (0.11 * std::sqrt(1 + slope * slope));
        if (std::abs(x) >= 1) continue;
        const double over = 0.75 + 0.25 * sign * std::cos(phase);
        const double groove = 1 - 0.25 * smooth_step(0.25, 0.0, std::abs(x));
        height = std::max(height, 0.052 * over * groove * std::sqrt(1 - x * x));
    }
    const double ex = (fraction(crossings * turns) - 0.5) * 0.45 / 0.40, ey = y;
    const double r = std::sqrt(ex * ex + ey * ey), petals = 0.105 + 0.03 * std::cos(8 * std::atan2(ey, ex));
    if (r < petals) height = std::max(height, 0.034 * std::sqrt(1 - r * r / (petals * petals)));
    return height;
}

}  // namespace

double band_begin(int which) {
    static const auto begins = [] {
        std::array<double, band::count + 1> shares;
        for (std::size_t b = 0; b < shares.size(); ++b) {
            const double step =
                static_cast<double>(band_knots[b]) / (outline.size() - 1.0) * ArcLength::steps;
            shares[b] = arcs().length[static_cast<std::size_t>(std::lround(step))] / arcs().length.back();
        }
        return shares;
    }();
    return begins[static_cast<std::size_t>(which)];
}

ProfilePoint profile(double arc) {
    const double x = arcs().at(arc), e = 1e-3;
    const Knot p = spline(x), a = spline(std::max(x - e, 0.0)),
               b = spline(std::min(x + e, outline.size() - 1.0));
    const double dr = b.radius - a.radius, dh = b.height - a.height, length = std::sqrt(dr * dr + dh * dh);
    return {p.radius, p.height, dh / length, -dr / length};
}

double relief(double angle, double arc) {
    const double turns = angle / (2 * pi);
    double height = 0;
    for (const int b :
         {band::foot, band::knot, band::petals, band::frieze, band::shoulder, band::neck, band::lip}) {
        const double from = band_begin(b), to = band_begin(b + 1);
        if (!(arc > from && arc <= to)) continue;
        const double t = (arc - from) / (to - from), inside = window(0.02, 0.98, 0.1, t);
        if (b == band::foot)
            height += 0.030 * window(0.12, 0.9, 0.2, t) * std::abs(std::cos(10 * pi * turns));
        if (b == band::knot) height += beads(turns, t, 14, 0.035);
        if (b == band::petals) {
            const double x = 2 * from_middle(20 * turns);  // 0 at the centre of a petal, 1 between two petals
            height += 0.045 * inside * std::sqrt(std::max(0.0, 1 - x * x));
        }
        if (b == band::frieze) height += inside * guilloche(turns, t);
        if (b == band::shoulder)
            height += 0.022 * inside * (0.5 + 0.5 * std::cos(2 * pi * (24 * turns + 1.1 * t)));
        if (b == band::neck) {
            const double u = 2 * pi * (9 * turns + 1.5 * t), v = 2 * pi * (9 * turns - 1.5 * t);
            height += 0.020 * inside * (std::max(0.0, std::cos(u)) + std::max(0.0, std::cos(v)));
        }
        if (b == band::lip) {
            height += beads(turns, (t - 0.18) / 0.5, 28, 0.035);
            height += 0.03 * smooth_step(0.72, 1.0, t) * std::cos(2 * pi * 14 * turns);
        }
    }
    for (const int b : {band::petals, band::frieze, band::shoulder, band::neck, band::lip}) {
        height += moulding(arc, band_begin(b), 0.007, 0.022);
    }
    return height;
}

Grid body(double detail) {
    Grid grid;
    grid.columns = 16 * static_cast<int>(std::lround(22 * detail));
    grid.rows = static_cast<int>(std::lround(258 * detail));
    const int columns = grid.columns, rows = grid.rows;
    grid.position = [columns, rows](int column, int row) -> Vec3 {
        const double angle = 2 * pi * (column % columns) / columns, arc = double(row) / rows;
        if (row == 0) return {0, profile(0).height, 0};
        const ProfilePoint p = profile(arc);
        const double h = relief(angle, arc);
        const double rim = 0.035 * smooth_step(0.965, 1.0, arc) * std::cos(14 * angle);
        const double radius = p.radius + h * p.normal_out;
        return {radius * std::sin(angle), p.height + h * p.normal_up + rim, radius * std::cos(angle)};
    };
    grid.paint = [](double s, double t) { return paint_body(2 * pi * s, t); };
    const double length = arcs().length.back();
    for (int b = 0; b < band::count; ++b) {
        const auto line = [&](int which) { return static_cast<int>(std::lround(band_begin(which) * rows)); };
        const int first = line(b), last = line(b + 1);
        const double middle = (band_begin(b) + band_begin(b + 1)) / 2,
                     share = band_begin(b + 1) - band_begin(b);
        const int sectors = b == band::base || b == band::knot ? 4 : 8;
        for (int i = 0; i < sectors; ++i) {
            // The bottom is rarely seen, so it gets fewer texels.
            const double density = b == band::base ? 0.3 : 1;
            grid.charts.push_back({columns * i / sectors, columns * (i + 1) / sectors, first, last,
                                   density * 2 * pi * profile(middle).radius / sectors,
                                   density * share * length});
        }
    }
    return grid;
}

}  // namespace model

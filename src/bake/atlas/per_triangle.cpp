#include "bake/atlas/per_triangle.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace faqem::detail {
namespace {

constexpr std::uint32_t largest_grain = 16;

// Size class of a cell at some scale. Legs lie along the sides of the cell, the longer one along its width.
struct Shape {
    std::uint32_t width = 1, height = 1;
    std::uint32_t grain = 1;   // the cell's place and sides are multiples of it, a power of two
    std::uint32_t margin = 0;  // texels of each side beyond the leg
    bool turned = false;       // the second leg is the longer one
    bool single = true;        // all of the triangle is one texel

    // All that makes cells look the same.
    auto key() const { return std::tuple(grain, height, width, margin, turned, single); }
    auto size() const { return std::tuple(grain, height, width); }
};

// Mip level k is clean in cells on a grid of 2^k texels if the legs run from centre to centre of its texels:
// those lie in one cell, half of the outermost ones outside of the legs.
// A leg is at least a grain long: measured, clean levels are worth more than the texels they cost.
std::uint32_t grain_of(double shorter_leg) {
    std::uint32_t grain = 1;
    while (grain < largest_grain && 2 * grain <= shorter_leg) grain *= 2;
    return grain;
}

// Between the hypotenuses of strangers, one shifted by (m, m) against the other, m texels: 2 for bilinear
// reads of the page itself, more to keep coarser levels cleaner.
std::uint32_t margin_of(std::uint32_t grain, bool joined) {
    return grain + (joined ? 0 : std::max(2u, grain));
}

// To four classes to the octave and whole grains.
std::uint32_t size_class(double x, std::uint32_t grain) {
    const double octave = std::exp2(std::floor(std::log2(std::max(1.0, x))) - 2);
    const double step = std::max(octave, double(grain));
    return static_cast<std::uint32_t>(std::lround(x / step) * step);
}

std::uint32_t side_of(double leg, std::uint32_t grain, std::uint32_t margin) {
    std::uint32_t side = size_class(leg + margin, grain);
    while (side <= margin) side += grain;
    return side;
}

Shape shape_of(const std::array<double, 2>& legs, double scale, bool joined) {
    const double a = legs[0] * scale, b = legs[1] * scale;
    Shape shape;
    if (!(std::max(a, b) >= 0.75)) return shape;
    shape.single = false;
    shape.turned = a < b;
    shape.grain = grain_of(std::min(a, b));
    shape.margin = margin_of(shape.grain, joined);
    shape.width = side_of(std::max(a, b), shape.grain, shape.margin);
    shape.height = side_of(std::min(a, b), shape.grain, shape.margin);
    return shape;
}

// One or two triangles that fill a cell.
struct Unit {
    Shape shape;
    Index first = no_index, second = no_index;
    std::uint64_t order = 0;
    bool joined = false;
};

double root_mean_square(double a, double b) { return std::sqrt((a * a + b * b) / 2); }

// Places the corners of a triangle in its cell: the first, or the second, which is turned by 180 degrees.
// On the page triangles turn clockwise in (u, v down), as unmirrored glTF textures do.
AtlasPlace place_in(const AtlasCell& cell, const Shape& shape, const AtlasTriangle& triangle, bool second) {
    AtlasPlace place;
    if (shape.single) {
        for (auto& uv : place.uv) uv = {cell.x + 0.5, cell.y + 0.5};
        return place;
    }
    const std::uint32_t along = shape.width - shape.margin, up = shape.height - shape.margin;
    const double inset = shape.grain / 2.0;
    std::array<std::array<double, 2>, 3> local;  // right corner, end of the first leg, end of the second
    if (shape.turned) {
        local = {{{inset, inset}, {inset, inset + up}, {inset + along, inset}}};
        place.legs = {up, along};
    } else {
        const double base = shape.height - inset;
        local = {{{inset, base}, {inset + along, base}, {inset, base - up}}};
        place.legs = {along, up};
    }
    for (std::size_t i = 0; i < 3; ++i) {
        const double x = second ? shape.width - local[i][0] : local[i][0];
        const double y = second ? shape.height - local[i][1] : local[i][1];
        place.uv[(triangle.right + i) % 3] = {cell.x + x, cell.y + y};
    }
    return place;
}

// Place number along a Hilbert curve over a square of 2^16 by 2^16.
std::uint64_t hilbert(std::uint32_t x, std::uint32_t y) {
    std::uint64_t result = 0;
    for (std::uint32_t s = 1u << 15; s > 0; s /= 2) {
        const bool right = x & s, low = y & s;
        result = 4 * result + (low ? (right ? 2 : 1) : (right ? 3 : 0));
        if (!low) {
            if (right) {
                x = ~x;
                y = ~y;
            }
            std::swap(x, y);
        }
    }
    return result;
}

// One attempt at a scale and a page.
class Packing {
public:
    Packing(std::span<const AtlasTriangle> triangles, double scale, engine::Poll poll)
        : triangles_(triangles), scale_(scale), poll_(poll) {
        std::vector<Unit> strangers;
        for (std::size_t i = 0; i < triangles.size(); ++i) {
            poll();
            const auto t = static_cast<Index>(i);
            const AtlasTriangle& a = triangles[i];
            if (a.partner != no_index) {
                const AtlasTriangle& b = triangles[a.partner];
                const std::array<double, 2> legs = {root_mean_square(a.legs[0], b.legs[0]),
                                                    root_mean_square(a.legs[1], b.legs[1])};
                const Shape shape = shape_of(legs, scale, true);
                if (!shape.single) {
                    if (t < a.partner) units_.push_back({shape, t, a.partner, a.order, true});
                    continue;
                }
                units_.push_back({shape, t, no_index, a.order, false});
                continue;
            }
            strangers.push_back({shape_of(a.legs, scale, false), t, no_index, a.order, false});
        }
        std::sort(strangers.begin(), strangers.end(), [poll](const Unit& a, const Unit& b) {
            poll();
            return std::tuple(a.shape.key(), a.order, a.first) < std::tuple(b.shape.key(), b.order, b.first);
        });
        for (std::size_t i = 0; i < strangers.size(); ++i) {
            poll();
            Unit unit = strangers[i];
            const bool two = !unit.shape.single && i + 1 < strangers.size() &&
                             unit.shape.key() == strangers[i + 1].shape.key();
            if (two) unit.second = strangers[++i].first;
            units_.push_back(unit);
        }
        std::sort(units_.begin(), units_.end(), [poll](const Unit& a, const Unit& b) {
            poll();
            if (a.shape.size() != b.shape.size()) return a.shape.size() > b.shape.size();
            return std::tuple(a.order, a.first) < std::tuple(b.order, b.first);
        });
    }

    // Calls place(number of the unit, x, y) for all units, shelf by shelf, the highest first; false if they
    // do not fit. Grains come from coarse to fine, so every unit lies on its own.
    template <class Place>
    bool shelves(std::uint32_t width, std::uint32_t height, Place&& place) const {
        std::uint64_t x = 0, y = 0, shelf = 0;
        for (std::size_t i = 0; i < units_.size(); ++i) {
            poll_();
            const Shape& shape = units_[i].shape;
            if (shape.width > width) return false;
            if (shape.height > shelf || x + shape.width > width) {
                y += shelf;
                x = 0;
                shelf = shape.height;
                if (y + shelf > height) return false;
            }
            place(i, static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y));
            x += shape.width;
        }
        return true;
    }

    bool fits(std::uint32_t width, std::uint32_t height) const {
        return shelves(width, height, [](std::size_t, std::uint32_t, std::uint32_t) {});
    }

    Atlas atlas(std::uint32_t width, std::uint32_t height) const {
        Atlas result{width, height, std::vector<AtlasPlace>(triangles_.size()), {}, scale_};
        std::vector<Spot> spots;
        spots.reserve(units_.size());
        shelves(width, height, [&](std::size_t i, std::uint32_t x, std::uint32_t y) {
            const Shape& shape = units_[i].shape;
            spots.push_back({hilbert(x / shape.width, y / shape.height), x, y});
        });
        for (std::size_t begin = 0, end; begin < units_.size(); begin = end) {
            for (end = begin; end < units_.size() && units_[end].shape.size() == units_[begin].shape.size();)
                ++end;
            std::sort(spots.begin() + std::ptrdiff_t(begin), spots.begin() + std::ptrdiff_t(end),
                      engine::polled_less(poll_));
        }
        for (std::size_t i = 0; i < units_.size(); ++i) {
            poll_();
            const Unit& unit = units_[i];
            const AtlasCell cell{spots[i].x, spots[i].y,  unit.shape.width, unit.shape.height,
                                 unit.first, unit.second, unit.joined};
            result.cells.push_back(cell);
            for (Index t : {cell.first, cell.second}) {
                if (t == no_index) continue;
                result.places[t] = place_in(cell, unit.shape, triangles_[t], t == cell.second);
            }
        }
        return result;
    }

private:
    // A place for a unit of some size, in the order of a space-filling curve.
    struct Spot {
        std::uint64_t curve;
        std::uint32_t x, y;
        auto operator<=>(const Spot&) const = default;  // NOLINT(modernize-use-nullptr)
    };

    std::span<const AtlasTriangle> triangles_;
    double scale_;
    engine::Poll poll_;
    std::vector<Unit> units_;
};

// The largest scale in [low, high] that fits, to a thousandth; low must fit.
double largest_scale(std::span<const AtlasTriangle> triangles, std::uint32_t width, std::uint32_t height,
                     double low, double high, engine::Poll poll) {
    if (Packing(triangles, high, poll).fits(width, height)) return high;
    for (int i = 0; i < 40 && high - low > 1e-3 * high; ++i) {
        const double middle = (low + high) / 2;
        (Packing(triangles, middle, poll).fits(width, height) ? low : high) = middle;
    }
    return low;
}

double squared(double x) { return x * x; }

}  // namespace

std::optional<Atlas> pack_triangles(std::span<const AtlasTriangle> triangles, std::uint32_t side,
                                    engine::Poll poll) {
    const Packing wanted(triangles, 1, poll);
    for (std::uint32_t width = 4; width <= side; width *= 2) {
        for (std::uint32_t height : {width / 2, width}) {
            if (!wanted.fits(width, height)) continue;
            const double scale = largest_scale(triangles, width, height, 1, std::sqrt(2.0), poll);
            return Packing(triangles, scale, poll).atlas(width, height);
        }
    }
    if (!Packing(triangles, 0, poll).fits(side, side)) return std::nullopt;
    return Packing(triangles, largest_scale(triangles, side, side, 0, 1, poll), poll).atlas(side, side);
}

AtlasFrame::AtlasFrame(const AtlasPlace& place) : place_(place) {
    const auto &a = place.uv[0], &b = place.uv[1], &c = place.uv[2];
    const double x1 = b[0] - a[0], y1 = b[1] - a[1], x2 = c[0] - a[0], y2 = c[1] - a[1];
    const double twice = x1 * y2 - x2 * y1;
    if (twice == 0) return;
    gradient_[0] = {y2 / twice, -x2 / twice, (x2 * a[1] - y2 * a[0]) / twice};
    gradient_[1] = {-y1 / twice, x1 / twice, (y1 * a[0] - x1 * a[1]) / twice};
}

Vec3 AtlasFrame::at(double x, double y) const {
    const double v = gradient_[0][0] * x + gradient_[0][1] * y + gradient_[0][2];
    const double w = gradient_[1][0] * x + gradient_[1][1] * y + gradient_[1][2];
    return {1 - v - w, v, w};
}

Vec3 AtlasFrame::closest(double x, double y) const {
    const Vec3 inside = at(x, y);
    if (inside[0] >= 0 && inside[1] >= 0 && inside[2] >= 0) return inside;
    Vec3 best = {1, 0, 0};
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t j = (i + 1) % 3;
        const auto &a = place_.uv[i], &b = place_.uv[j];
        const double dx = b[0] - a[0], dy = b[1] - a[1], length = dx * dx + dy * dy;
        const double t = length > 0 ? std::clamp(((x - a[0]) * dx + (y - a[1]) * dy) / length, 0.0, 1.0) : 0;
        const double d = squared(a[0] + t * dx - x) + squared(a[1] + t * dy - y);
        if (!(d < least)) continue;
        least = d;
        best = {0, 0, 0};
        best[i] = 1 - t;
        best[j] = t;
    }
    return best;
}

}  // namespace faqem::detail

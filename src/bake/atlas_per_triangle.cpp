#include "bake/atlas_per_triangle.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace faqem::detail {
namespace {

// Size class of a triangle at some scale. Legs lie along the sides of the cell, the longer one along its
// width.
struct Shape {
    std::uint32_t width = 1, height = 1;  // of the cell
    std::uint32_t gutter = 0;
    bool turned = false;  // the second leg is the longer one
    bool single = true;   // all of the triangle is one texel
};

constexpr std::uint32_t largest_gutter = 8;

std::uint32_t gutter_of(double shorter_leg) {
    return static_cast<std::uint32_t>(std::clamp(shorter_leg / 12, 0.0, double(largest_gutter)));
}

// Texels of a cell beyond the leg. One, because legs run from texel centre to texel centre, and the gutters.
// Between the two hypotenuses, one shifted by (m, m) against the other, lie margins as wide as two gutters;
// the texels that bilinear reads on the hypotenuse touch need m = 2.
std::uint32_t margin_of(std::uint32_t gutter) { return 1 + 2 * gutter + std::max(2u, 2 * gutter); }

// Four classes to the octave.
std::uint32_t size_class(double x) {
    const double exact = std::max(1.0, x);
    if (exact < 8) return static_cast<std::uint32_t>(std::lround(exact));
    const double step = std::exp2(std::floor(std::log2(exact)) - 2);
    return static_cast<std::uint32_t>(std::lround(exact / step) * step);
}

Shape shape_of(const AtlasTriangle& triangle, double scale) {
    const double a = triangle.legs[0] * scale, b = triangle.legs[1] * scale;
    Shape shape;
    if (!(std::max(a, b) >= 0.75)) return shape;
    shape.single = false;
    shape.turned = a < b;
    shape.gutter = gutter_of(std::min(a, b));
    const std::uint32_t margin = margin_of(shape.gutter);
    shape.width = std::max(margin + 1, size_class(std::max(a, b) + margin));
    shape.height = std::max(margin + 1, size_class(std::min(a, b) + margin));
    return shape;
}

bool same_class(const Shape& a, const Shape& b) {
    return a.width == b.width && a.height == b.height && a.gutter == b.gutter && a.turned == b.turned &&
           a.single == b.single;
}

bool before(const Shape& a, const Shape& b) {
    if (a.height != b.height) return a.height > b.height;
    if (a.width != b.width) return a.width > b.width;
    if (a.gutter != b.gutter) return a.gutter > b.gutter;
    if (a.turned != b.turned) return a.turned < b.turned;
    return a.single < b.single;
}

// Places the corners of a triangle in its cell: the first, or the second, which is turned by 180 degrees.
// On the page triangles turn clockwise in (u, v down), as unmirrored glTF textures do.
AtlasPlace place_in(const AtlasCell& cell, const Shape& shape, const AtlasTriangle& triangle, bool second) {
    AtlasPlace place;
    if (shape.single) {
        for (auto& uv : place.uv) uv = {cell.x + 0.5, cell.y + 0.5};
        return place;
    }
    const std::uint32_t margin = margin_of(shape.gutter);
    const std::uint32_t along = shape.width - margin, up = shape.height - margin;
    const double inset = shape.gutter + 0.5;
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

// One attempt at a scale and a page.
class Packing {
public:
    Packing(std::span<const AtlasTriangle> triangles, double scale) : triangles_(triangles), scale_(scale) {
        shapes_.reserve(triangles.size());
        for (const AtlasTriangle& t : triangles) shapes_.push_back(shape_of(t, scale));
        order_.resize(triangles.size());
        for (std::size_t i = 0; i < order_.size(); ++i) order_[i] = static_cast<Index>(i);
        std::sort(order_.begin(), order_.end(), [&](Index i, Index j) {
            if (!same_class(shapes_[i], shapes_[j])) return before(shapes_[i], shapes_[j]);
            return triangles_[i].order != triangles_[j].order ? triangles_[i].order < triangles_[j].order
                                                              : i < j;
        });
    }

    // Calls place(cell) for all cells, shelf by shelf, the highest first; false if they do not fit.
    template <class Place>
    bool shelves(std::uint32_t width, std::uint32_t height, Place&& place) const {
        std::uint64_t x = 0, y = 0, shelf = 0;
        for (std::size_t i = 0; i < order_.size();) {
            const Shape& shape = shapes_[order_[i]];
            const bool pair =
                !shape.single && i + 1 < order_.size() && same_class(shape, shapes_[order_[i + 1]]);
            if (shape.width > width) return false;
            if (shelf == 0 || x + shape.width > width) {
                y += shelf;
                x = 0;
                shelf = shape.height;
                if (y + shelf > height) return false;
            }
            place(AtlasCell{static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y), shape.width,
                            shape.height, order_[i], pair ? order_[i + 1] : no_index});
            x += shape.width;
            i += pair ? 2 : 1;
        }
        return true;
    }

    bool fits(std::uint32_t width, std::uint32_t height) const {
        return shelves(width, height, [](const AtlasCell&) {});
    }

    Atlas atlas(std::uint32_t width, std::uint32_t height) const {
        Atlas result{width, height, std::vector<AtlasPlace>(triangles_.size()), {}, scale_};
        shelves(width, height, [&](const AtlasCell& cell) {
            result.cells.push_back(cell);
            for (Index t : {cell.first, cell.second}) {
                if (t == no_index) continue;
                result.places[t] = place_in(cell, shapes_[t], triangles_[t], t == cell.second);
            }
        });
        return result;
    }

private:
    std::span<const AtlasTriangle> triangles_;
    double scale_;
    std::vector<Shape> shapes_;
    std::vector<Index> order_;
};

// The largest scale in [low, high] that fits, to a thousandth; low must fit.
double largest_scale(std::span<const AtlasTriangle> triangles, std::uint32_t width, std::uint32_t height,
                     double low, double high) {
    if (Packing(triangles, high).fits(width, height)) return high;
    for (int i = 0; i < 40 && high - low > 1e-3 * high; ++i) {
        const double middle = (low + high) / 2;
        (Packing(triangles, middle).fits(width, height) ? low : high) = middle;
    }
    return low;
}

double squared(double x) { return x * x; }

}  // namespace

std::optional<Atlas> pack_triangles(std::span<const AtlasTriangle> triangles, std::uint32_t side) {
    const Packing wanted(triangles, 1);
    for (std::uint32_t width = 4; width <= side; width *= 2) {
        for (std::uint32_t height : {width / 2, width}) {
            if (!wanted.fits(width, height)) continue;
            const double scale = largest_scale(triangles, width, height, 1, std::sqrt(2.0));
            return Packing(triangles, scale).atlas(width, height);
        }
    }
    if (!Packing(triangles, 0).fits(side, side)) return std::nullopt;
    return Packing(triangles, largest_scale(triangles, side, side, 0, 1)).atlas(side, side);
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

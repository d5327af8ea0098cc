#include "bake/atlas/per_triangle.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <tuple>

#include "bake/atlas/triangle_pairs.hpp"

namespace faqem::detail {
namespace {

// Size class of a cell at a given scale. The legs are parallel to the sides of the cell, the longer one to
// its width.
struct CellShape {
    std::uint32_t width = 1, height = 1;
    std::uint32_t block_size = 1;  // a power of two; position and sides of the cell are multiples of it
    std::uint32_t margin = 0;      // texels by which each side is longer than the leg
    bool is_transposed = false;    // the second leg is the longer one
    bool is_single_texel = true;   // the whole triangle is one texel

    // Equal for cells of equal layout.
    auto key() const { return std::tuple(block_size, height, width, margin, is_transposed, is_single_texel); }
    auto size() const { return std::tuple(block_size, height, width); }
};

// Rounds to four size classes per octave and to a multiple of the block size.
std::uint32_t cell_size_class(double x, std::uint32_t block_size) {
    const double octave = std::exp2(std::floor(std::log2(std::max(1.0, x))) - 2);
    const double step = std::max(octave, double(block_size));
    return static_cast<std::uint32_t>(std::lround(x / step) * step);
}

std::uint32_t cell_side(double leg, std::uint32_t block_size, std::uint32_t margin) {
    std::uint32_t side = cell_size_class(leg + margin, block_size);
    while (side <= margin) side += block_size;
    return side;
}

CellShape cell_shape(const std::array<double, 2>& legs, double scale, bool has_shared_hypotenuse) {
    const double a = legs[0] * scale, b = legs[1] * scale;
    CellShape shape;
    if (!(std::max(a, b) >= 0.75)) return shape;
    shape.is_single_texel = false;
    shape.is_transposed = a < b;
    // Mip level k of a cell is free of other cells' texels if the cell is aligned to a grid of 2^k texels and the
    // legs run between centres of texels of this level: all of these are in the cell, with half of each outermost
    // texel outside of the legs. Legs are at least a block long: measurements show that the quality gained on
    // coarser levels is worth the texels.
    const double shorter = std::clamp<double>(std::min(a, b), 1, max_block_size);
    shape.block_size = std::bit_floor(static_cast<std::uint32_t>(shorter));
    // The hypotenuses of two triangles that are not partners are shifted against each other by (m, m) texels.
    // m = 2 is enough for bilinear reads of level 0; larger margins reduce mixing on coarser levels.
    shape.margin = shape.block_size + (has_shared_hypotenuse ? 0 : std::max(2u, shape.block_size));
    shape.width = cell_side(std::max(a, b), shape.block_size, shape.margin);
    shape.height = cell_side(std::min(a, b), shape.block_size, shape.margin);
    return shape;
}

// One or two triangles that fill a cell.
struct Unit {
    CellShape shape;
    Index first = no_index, second = no_index;
    std::uint64_t order = 0;
    bool has_shared_hypotenuse = false;
};

// Places the corners of the first or the second triangle of a cell; the second is rotated by 180 degrees.
// Triangles are clockwise on the page in (u, v) with v down, as in glTF textures that are not mirrored.
Triangle2 place_triangle(const AtlasCell& cell, const CellShape& shape, const AtlasTriangle& triangle,
                         bool second) {
    Triangle2 placement;
    if (shape.is_single_texel) {
        placement.fill({cell.x + 0.5, cell.y + 0.5});
        return placement;
    }
    const std::uint32_t along = shape.width - shape.margin, up = shape.height - shape.margin;
    const double inset = shape.block_size / 2.0, base = shape.height - inset;
    // The right-angle corner, the end of the first leg, and that of the second.
    Triangle2 local = {{{inset, base}, {inset + along, base}, {inset, base - up}}};
    if (shape.is_transposed) local = {{{inset, inset}, {inset, inset + up}, {inset + along, inset}}};
    for (std::size_t i = 0; i < 3; ++i) {
        const double x = second ? shape.width - local[i].x : local[i].x;
        const double y = second ? shape.height - local[i].y : local[i].y;
        placement[(triangle.right_angle_corner + i) % 3] = {cell.x + x, cell.y + y};
    }
    return placement;
}

// The cells of all triangles at one scale, packed on shelves.
class ShelfPacking {
public:
    ShelfPacking(std::span<const AtlasTriangle> triangles, double scale, const engine::RunContext& context)
        : triangles_(triangles), scale_(scale) {
        std::vector<Unit> unpaired;
        for (std::size_t i = 0; i < triangles.size(); ++i) {
            const auto t = static_cast<Index>(i);
            const AtlasTriangle& a = triangles[i];
            if (a.partner != no_index) {
                const AtlasTriangle& b = triangles[a.partner];
                const std::array<double, 2> legs = {shared_side(a.legs[0], b.legs[0]),
                                                    shared_side(a.legs[1], b.legs[1])};
                const CellShape shape = cell_shape(legs, scale, true);
                if (shape.is_single_texel)
                    units_.push_back({shape, t, no_index, a.order, false});
                else if (t < a.partner)
                    units_.push_back({shape, t, a.partner, a.order, true});
                continue;
            }
            unpaired.push_back({cell_shape(a.legs, scale, false), t, no_index, a.order, false});
        }
        context.check_now();
        std::ranges::sort(unpaired, {}, [](const Unit& unit) {
            return std::tuple(unit.shape.key(), unit.order, unit.first);
        });
        for (std::size_t i = 0; i < unpaired.size(); ++i) {
            Unit unit = unpaired[i];
            const bool two = !unit.shape.is_single_texel && i + 1 < unpaired.size() &&
                             unit.shape.key() == unpaired[i + 1].shape.key();
            if (two) unit.second = unpaired[++i].first;
            units_.push_back(unit);
        }
        context.check_now();
        std::sort(units_.begin(), units_.end(), [](const Unit& a, const Unit& b) {
            if (a.shape.size() != b.shape.size()) return a.shape.size() > b.shape.size();
            return std::tuple(a.order, a.first) < std::tuple(b.order, b.first);
        });
    }

    // Calls place(unit index, x, y) for all units, shelf by shelf, the largest first. Returns false if they
    // do not fit. Units come in descending order of block size, so that each is aligned to its block size.
    template <class Place>
    bool place_on_shelves(std::uint32_t width, std::uint32_t height, Place&& place) const {
        std::uint64_t x = 0, y = 0, shelf = 0;
        for (std::size_t i = 0; i < units_.size(); ++i) {
            const CellShape& shape = units_[i].shape;
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
        return place_on_shelves(width, height, [](std::size_t, std::uint32_t, std::uint32_t) {});
    }

    Atlas atlas(std::uint32_t width, std::uint32_t height) const {
        Atlas result{width, height, std::vector<Triangle2>(triangles_.size()), {}, scale_};
        place_on_shelves(width, height, [&](std::size_t i, std::uint32_t x, std::uint32_t y) {
            const Unit& unit = units_[i];
            result.cells.push_back({x, y, unit.shape.width, unit.shape.height, unit.first, unit.second,
                                    unit.has_shared_hypotenuse});
            for (Index t : {unit.first, unit.second})
                if (t != no_index)
                    result.placements[t] =
                        place_triangle(result.cells.back(), unit.shape, triangles_[t], t == unit.second);
        });
        return result;
    }

private:
    std::span<const AtlasTriangle> triangles_;
    double scale_;
    std::vector<Unit> units_;
};

// The largest scale in [low, high] that fits, with a relative accuracy of 0.001; `low` must fit.
// \param pack  double -> ShelfPacking
template <class Pack>
double largest_scale(const Pack& pack, std::uint32_t width, std::uint32_t height, double low, double high) {
    if (pack(high).fits(width, height)) return high;
    for (int i = 0; i < 40 && high - low > 1e-3 * high; ++i) {
        const double middle = (low + high) / 2;
        (pack(middle).fits(width, height) ? low : high) = middle;
    }
    return low;
}

}  // namespace

std::optional<Atlas> pack_triangles(std::span<const AtlasTriangle> triangles, std::uint32_t max_size,
                                    const engine::RunContext& context) {
    const auto pack = [&](double scale) { return ShelfPacking(triangles, scale, context); };
    const ShelfPacking wanted = pack(1);
    for (std::uint32_t width = 4; width <= max_size; width *= 2) {
        for (std::uint32_t height : {width / 2, width}) {
            if (!wanted.fits(width, height)) continue;
            return pack(largest_scale(pack, width, height, 1, std::sqrt(2.0))).atlas(width, height);
        }
    }
    if (!pack(0).fits(max_size, max_size)) return std::nullopt;
    return pack(largest_scale(pack, max_size, max_size, 0, 1)).atlas(max_size, max_size);
}

BarycentricFrame::BarycentricFrame(const Triangle2& triangle) : triangle_(triangle) {
    const Point2& a = triangle[0];
    const Point2 ab = triangle[1] - a, ac = triangle[2] - a;
    const double twice = cross(ab, ac);
    if (twice == 0) return;
    gradient_[0] = {ac.y / twice, -ac.x / twice, cross(ac, a) / twice};
    gradient_[1] = {-ab.y / twice, ab.x / twice, cross(a, ab) / twice};
}

Vec3 BarycentricFrame::at(double x, double y) const {
    const double v = gradient_[0][0] * x + gradient_[0][1] * y + gradient_[0][2];
    const double w = gradient_[1][0] * x + gradient_[1][1] * y + gradient_[1][2];
    return {1 - v - w, v, w};
}

Vec3 BarycentricFrame::closest(double x, double y) const {
    const Vec3 inside = at(x, y);
    if (inside[0] >= 0 && inside[1] >= 0 && inside[2] >= 0) return inside;
    Vec3 best = {1, 0, 0};
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t j = (i + 1) % 3;
        const Point2 &a = triangle_[i], &b = triangle_[j];
        const double t = closest_on_segment(a, b, {x, y});
        const double d = squared_length(point_on_line(a, b, t) - Point2{x, y});
        if (!(d < least)) continue;
        least = d;
        best = {0, 0, 0};
        best[i] = 1 - t;
        best[j] = t;
    }
    return best;
}

}  // namespace faqem::detail

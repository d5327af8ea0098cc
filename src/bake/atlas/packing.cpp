#include "bake/atlas/packing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include "faqem/engine/mesh/index_lists.hpp"

namespace faqem::detail {
namespace {

// Largest block size relative to a chart's size, which is the square root of its texels.
constexpr double max_block_size_ratio = 1.0 / 8;

// For this many of the largest charts all rows are searched, so that they can fill any hole.
constexpr std::size_t exhaustively_searched_charts = 256;

// A chart rotated so that its bounding box has minimum area and is wider than high. The box begins at the
// origin.
struct OrientedChart {
    std::vector<Triangle2> points;
    double width = 0, height = 0, area = 0;
};

// Convex hull, counter-clockwise (Andrew's monotone chain).
std::vector<Point2> convex_hull(const Chart& chart) {
    std::vector<Point2> points;
    for (const Triangle2& t : chart.points) points.insert(points.end(), t.begin(), t.end());
    const auto less = [](const Point2& a, const Point2& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; };
    std::sort(points.begin(), points.end(), less);
    points.erase(std::unique(points.begin(), points.end()), points.end());
    std::vector<Point2> hull;
    for (int side = 0; side < 2; ++side) {
        const std::size_t begin = hull.size();
        for (const Point2& p : points) {
            while (hull.size() >= begin + 2 &&
                   !(twice_signed_area(hull[hull.size() - 2], hull.back(), p) > 0))
                hull.pop_back();
            hull.push_back(p);
        }
        hull.pop_back();
        std::reverse(points.begin(), points.end());
    }
    return hull;
}

// Products of larger numbers could overflow.
constexpr double max_coordinate = 1e100;

// Whether no coordinate is too large or NaN.
bool has_valid_coordinates(const Chart& chart) {
    return std::all_of(chart.points.begin(), chart.points.end(), [](const Triangle2& t) {
        return std::all_of(t.begin(), t.end(), [](const Point2& p) {
            return std::abs(p.x) <= max_coordinate && std::abs(p.y) <= max_coordinate;
        });
    });
}

// Rotates a chart; tries the directions of the edges of its convex hull.
OrientedChart orient(const Chart& chart) {
    if (!has_valid_coordinates(chart))
        return {std::vector<Triangle2>(chart.points.size()), 0, 0, 0};  // one texel
    const std::vector<Point2> hull = convex_hull(chart);
    Point2 best = {1, 0};
    double least = HUGE_VAL;
    for (std::size_t i = 0; i < hull.size(); ++i) {
        const Point2 edge = hull[(i + 1) % hull.size()] - hull[i];
        const double edge_length = length(edge);
        if (!(edge_length > 0)) continue;
        const Point2 rotation = {edge.x / edge_length, -edge.y / edge_length};  // maps the edge to the x axis
        Box2 bounds;
        for (const Point2& p : hull) bounds.add(rotated(p, rotation));
        if (!(bounds.width() * bounds.height() < least * (1 - 1e-9))) continue;
        least = bounds.width() * bounds.height();
        best = bounds.width() < bounds.height() ? rotated(rotation, {0, 1}) : rotation;
    }
    OrientedChart shape;
    Box2 bounds;
    for (const Point2& p : hull) bounds.add(rotated(p, best));
    for (const Triangle2& t : chart.points) {
        shape.points.push_back({rotated(t[0], best) - bounds.low, rotated(t[1], best) - bounds.low,
                                rotated(t[2], best) - bounds.low});
        shape.area += twice_signed_area(t[0], t[1], t[2]) / 2;
    }
    shape.width = bounds.width();
    shape.height = bounds.height();
    return shape;
}

// The blocks of a chart at a given scale and page size.
struct ChartRaster {
    double scale_x = 1, scale_y = 1;
    std::uint32_t block_size = 1;
    bool is_single_texel = true;
    BlockMask mask;

    // Position of a corner in texels from the top left of the mask: v down, inset by half a block.
    Point2 texel_point(const Point2& p) const {
        return {block_size / 2.0 + p.x * scale_x,
                mask.rows * double(block_size) - block_size / 2.0 - p.y * scale_y};
    }
};

// Whether the interior of a triangle intersects that of the square with the given centre and half side.
bool overlaps_square(const Triangle2& t, const Point2& centre, double half) {
    const double slack = 1e-9 * half;
    for (std::size_t i = 0; i < 3; ++i) {
        const Point2 a = t[i], b = t[(i + 1) % 3], c = t[(i + 2) % 3];
        // There is no overlap if the square is on the outer side of edge ab.
        const Point2 d = b - a;
        const double sign = twice_signed_area(a, b, c) > 0 ? 1 : -1;
        const double inside = sign * cross(d, centre - a);
        const double reach = half * (std::abs(d.x) + std::abs(d.y));
        if (!(inside + reach > slack * length(d))) return false;
    }
    return true;
}

// The blocks that the triangles of a chart overlap.
BlockMask block_mask(const OrientedChart& shape, const ChartRaster& raster) {
    const double block_size = raster.block_size;
    BlockMask mask = raster.mask;
    mask.blocks.assign(std::size_t{mask.columns} * mask.rows, 0);
    const auto clamped = [](double i, std::uint32_t n) {
        return static_cast<std::uint32_t>(std::clamp(i, 0.0, double(n - 1)));
    };
    for (const Triangle2& t : shape.points) {
        const Triangle2 p = {raster.texel_point(t[0]), raster.texel_point(t[1]), raster.texel_point(t[2])};
        const Box2 bounds = bounding_box(p);
        const std::uint32_t x0 = clamped(std::floor(bounds.low.x / block_size - 0.5), mask.columns);
        const std::uint32_t x1 = clamped(std::ceil(bounds.high.x / block_size - 0.5), mask.columns);
        const std::uint32_t y0 = clamped(std::floor(bounds.low.y / block_size - 0.5), mask.rows);
        const std::uint32_t y1 = clamped(std::ceil(bounds.high.y / block_size - 0.5), mask.rows);
        for (std::uint32_t y = y0; y <= y1; ++y) {
            for (std::uint32_t x = x0; x <= x1; ++x) {
                std::uint8_t& block = mask.blocks[std::size_t{y} * mask.columns + x];
                if (!block)
                    block = overlaps_square(p, {(x + 0.5) * block_size, (y + 0.5) * block_size}, block_size);
            }
        }
    }
    return mask;
}

ChartRaster rasterize(const OrientedChart& shape, double scale, std::uint32_t width, std::uint32_t height) {
    ChartRaster raster{scale, scale, 1, true, {}};
    if (!(std::max(shape.width, shape.height) * scale >= 0.75)) return raster;
    raster.is_single_texel = false;
    const double size = std::sqrt(shape.area) * scale;
    while (raster.block_size < max_block_size && 16 * raster.block_size < height &&
           2 * raster.block_size <= max_block_size_ratio * size)
        raster.block_size *= 2;
    const auto squeezed = [&](double length, std::uint32_t page) {
        const double available = page - double(raster.block_size);
        return length * scale > available ? available / length : scale;
    };
    raster.scale_x = squeezed(shape.width, width);
    raster.scale_y = squeezed(shape.height, height);
    const auto blocks = [&](double length) {
        return 1 + static_cast<std::uint32_t>(std::ceil(length / raster.block_size - 1e-9));
    };
    raster.mask.columns = blocks(shape.width * raster.scale_x);
    raster.mask.rows = blocks(shape.height * raster.scale_y);
    raster.mask = block_mask(shape, raster);
    return raster;
}

// Size classes, four per octave.
std::uint32_t size_class(std::uint32_t blocks) {
    return static_cast<std::uint32_t>(std::lround(4 * std::log2(double(blocks))));
}

struct ChartPlacement {
    OccupancyGrid::BlockPosition position = {0, 0};
    std::uint32_t quarter_turns = 0;  // clockwise
};

// An attempt to pack all charts at a given scale on a page of a given size.
class ChartPacking {
public:
    ChartPacking(std::span<const OrientedChart> shapes, double scale, std::uint32_t width,
                 std::uint32_t height)
        : width_(width), height_(height) {
        rasters_.reserve(shapes.size());
        for (const OrientedChart& shape : shapes) rasters_.push_back(rasterize(shape, scale, width, height));
    }

    // Returns whether all charts fit.
    bool run(const engine::RunContext& context) {
        context.check_now();
        std::uint64_t texels = 0;
        for (const ChartRaster& raster : rasters_) {
            const auto blocks =
                std::ranges::count_if(raster.mask.blocks, [](std::uint8_t b) { return b != 0; });
            texels += static_cast<std::uint64_t>(blocks) * raster.block_size * raster.block_size;
        }
        if (texels > std::uint64_t{width_} * height_) return false;
        std::vector<Index> order = engine::all_indices(rasters_.size());
        std::ranges::stable_sort(order, std::ranges::greater{}, [&](std::size_t i) {
            const ChartRaster& raster = rasters_[i];
            return std::tuple(raster.block_size, std::max(raster.mask.columns, raster.mask.rows),
                              std::min(raster.mask.columns, raster.mask.rows));
        });
        std::uint32_t block_size = std::min({max_block_size, width_, height_});
        OccupancyGrid grid(width_ / block_size, height_ / block_size);
        placements_.assign(rasters_.size(), {});
        // By block size and size class: the row of the last chart. The search for the next chart of the class
        // starts there, since above it only holes are free.
        std::map<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>, std::uint32_t> first_row;
        for (std::size_t number = 0; number < order.size(); ++number) {
            const std::size_t i = order[number];
            context.count(1 + height_ / block_size / 32);  // up to that many rows are tested
            for (; block_size > rasters_[i].block_size; block_size /= 2) grid.refine();
            std::optional<ChartPlacement> best;
            std::uint32_t best_end = height_ / block_size + 1;
            BlockMask mask = rasters_[i].mask, best_mask;
            const std::size_t blocks = mask.blocks.size();
            // Masks of few blocks hardly change with a rotation by 180 degrees; a single block needs none.
            const std::uint32_t quarter_turns = blocks > 16 ? 4 : blocks > 1 ? 2 : 1;
            for (std::uint32_t t = 0; t < quarter_turns; ++t, mask = mask.rotated()) {
                if (mask.rows >= best_end) continue;
                std::uint32_t top = 0;
                const bool is_exhaustive = number < exhaustively_searched_charts;
                std::uint32_t& from =
                    is_exhaustive ? top
                                  : first_row[{block_size, size_class(mask.columns), size_class(mask.rows)}];
                const std::uint32_t step = is_exhaustive ? 1 : 1 + mask.rows / 8;
                const auto position = grid.find_free(mask, from, best_end - mask.rows, step);
                if (!position) continue;
                from = position->y;
                best = ChartPlacement{*position, t};
                best_end = position->y + mask.rows;
                best_mask = mask;
            }
            if (!best) return false;
            grid.occupy(best_mask, best->position);
            placements_[i] = *best;
        }
        return true;
    }

    const ChartRaster& raster(std::size_t i) const { return rasters_[i]; }
    const ChartPlacement& placement(std::size_t i) const { return placements_[i]; }

private:
    std::uint32_t width_, height_;
    std::vector<ChartRaster> rasters_;
    std::vector<ChartPlacement> placements_;
};

// Position on the page of a point of the mask, after the chart's rotation. Rotations preserve orientation.
Point2 page_point(const ChartRaster& raster, const ChartPlacement& placement, const Point2& p) {
    const double width = double(raster.mask.columns) * raster.block_size,
                 height = double(raster.mask.rows) * raster.block_size;
    const Point2 corner = {double(placement.position.x) * raster.block_size,
                           double(placement.position.y) * raster.block_size};
    const std::array turned = {p, Point2{height - p.y, p.x}, Point2{width - p.x, height - p.y},
                               Point2{p.y, width - p.x}};
    return corner + turned[placement.quarter_turns];
}

// The page of a successful attempt.
ChartPage make_page(std::span<const Chart> charts, std::span<const OrientedChart> shapes,
                    const ChartPacking& packing, std::size_t faces, std::uint32_t width, std::uint32_t height,
                    double scale) {
    ChartPage page{{width, height, std::vector<Triangle2>(faces), {}, scale}, {}};
    for (std::size_t i = 0; i < charts.size(); ++i) {
        const ChartRaster& raster = packing.raster(i);
        const ChartPlacement& placement = packing.placement(i);
        BlockMask mask = raster.mask;
        for (std::uint32_t t = 0; t < placement.quarter_turns; ++t) mask = mask.rotated();
        AtlasChart chart{placement.position.x * raster.block_size,
                         placement.position.y * raster.block_size,
                         raster.block_size,
                         std::move(mask),
                         charts[i].faces,
                         raster.is_single_texel};
        for (std::size_t k = 0; k < charts[i].faces.size(); ++k) {
            Triangle2& uv = page.atlas.placements[charts[i].faces[k]];
            for (std::size_t c = 0; c < 3; ++c) {
                uv[c] = raster.is_single_texel
                            ? Point2{chart.x + 0.5, chart.y + 0.5}
                            : page_point(raster, placement, raster.texel_point(shapes[i].points[k][c]));
            }
        }
        page.charts.push_back(std::move(chart));
    }
    return page;
}

// The search for the largest scale with which the charts fit.
struct ScaleSearch {
    double low, high;  // the largest scale that fits, and the smallest that does not
    double next = 0;   // to be tried

    void start(double scale) {
        next = scale;
        settle();
    }
    bool is_done() const { return !(high - low > 0.01 * high && high > 1e-6); }
    // fits: the charts fit with `next`
    void proceed(bool fits) {
        (fits ? low : high) = next;
        next *= fits ? 1.07 : 1 / 1.07;
        settle();
    }

    // `next`, and the scales that are tried after it if the following results are as the last one.
    std::vector<double> likely_scales(bool last, std::size_t count) const {
        std::vector<double> result;
        for (ScaleSearch ahead = *this; result.size() < count && !ahead.is_done(); ahead.proceed(last))
            result.push_back(ahead.next);
        return result;
    }

private:
    void settle() {
        if (!(next > low && next < high)) next = (low + high) / 2;
    }
};

// Packs with several scales in parallel.
std::map<double, std::optional<ChartPacking>> attempt_all(const std::vector<double>& scales,
                                                          std::span<const OrientedChart> shapes,
                                                          std::uint32_t width, std::uint32_t height,
                                                          const RunContext& context) {
    std::map<double, std::optional<ChartPacking>> result;
    for (const double scale : scales) result[scale];
    parallel_blocks(scales.size(), 1, context,
                    [&](std::size_t i, std::size_t, const engine::RunContext& block_context) {
                        ChartPacking packing(shapes, scales[i], width, height);
                        if (packing.run(block_context)) result.at(scales[i]) = std::move(packing);
                    });
    return result;
}

}  // namespace

std::optional<ChartPage> pack_charts(std::span<const Chart> charts, std::size_t faces, std::uint32_t max_size,
                                     const RunContext& context) {
    std::vector<OrientedChart> shapes;
    double area = 0, height_of_charts = 0;
    for (const Chart& chart : charts) {
        shapes.push_back(orient(chart));
        area += shapes.back().area;
        height_of_charts = std::max(height_of_charts, shapes.back().height);
    }
    std::uint32_t width = 4, height = 4;
    std::optional<ChartPacking> best;
    const auto fits = [&](double scale) {
        ChartPacking packing(shapes, scale, width, height);
        if (!packing.run(context)) return false;
        best = std::move(packing);
        return true;
    };
    for (;; width *= 2) {
        for (const std::uint32_t h : {width / 2, width}) {
            height = h;
            const bool has_room = height_of_charts <= height || height == max_size;
            if (has_room && area <= double(width) * height && fits(1)) break;
        }
        if (best || width == max_size) break;
    }
    if (charts.size() > std::size_t{width} * height) return std::nullopt;
    ScaleSearch search = best ? ScaleSearch{1, std::sqrt(2.0)} : ScaleSearch{0, 1};
    // Most pages end up about half full, so the search starts there and proceeds in small steps.
    search.start(std::sqrt(0.55 * double(width) * height / area));
    std::map<double, std::optional<ChartPacking>> attempts;  // nothing: the charts do not fit
    for (bool last = true; !search.is_done();) {
        if (!attempts.contains(search.next))
            attempts = attempt_all(search.likely_scales(last, thread_count(context.threads)), shapes, width,
                                   height, context);
        std::optional<ChartPacking>& attempt = attempts[search.next];
        last = attempt.has_value();
        if (attempt) best = std::move(attempt);
        search.proceed(last);
    }
    if (!best && !fits(search.low)) return std::nullopt;
    return make_page(charts, shapes, *best, faces, width, height, search.low);
}

}  // namespace faqem::detail

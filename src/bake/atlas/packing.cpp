#include "bake/atlas/packing.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "bake/atlas/occupancy_grid.hpp"

namespace faqem::detail {
namespace {

constexpr std::uint32_t largest_grain = 16;
// Grains are at most that share of a chart's size, the root of its texels.
constexpr double grain_share = 1.0 / 8;

// So many of the largest charts are tried in all holes.
constexpr std::size_t searched_well = 256;

using Flat = std::array<ChartPoint, 3>;

// Turned so that its box is least and lies on its longer side; its low corner is the origin.
struct Shape {
    std::vector<Flat> places;
    double width = 0, height = 0, area = 0;
};

// Andrew's monotone chain, counter-clockwise.
std::vector<ChartPoint> convex_hull(const Chart& chart, engine::Poll poll) {
    std::vector<ChartPoint> points;
    for (const Flat& t : chart.places) points.insert(points.end(), t.begin(), t.end());
    const auto less = [](const ChartPoint& a, const ChartPoint& b) {
        return a.real() != b.real() ? a.real() < b.real() : a.imag() < b.imag();
    };
    std::sort(points.begin(), points.end(), engine::polled_less(poll, less));
    points.erase(std::unique(points.begin(), points.end()), points.end());
    std::vector<ChartPoint> hull;
    for (int side = 0; side < 2; ++side) {
        const std::size_t begin = hull.size();
        for (const ChartPoint& p : points) {
            while (hull.size() >= begin + 2 && !(turn(hull[hull.size() - 2], hull.back(), p) > 0))
                hull.pop_back();
            hull.push_back(p);
        }
        hull.pop_back();
        std::reverse(points.begin(), points.end());
    }
    return hull;
}

struct Extent {
    double low_x = HUGE_VAL, low_y = HUGE_VAL, high_x = -HUGE_VAL, high_y = -HUGE_VAL;

    void add(const ChartPoint& p) {
        low_x = std::min(low_x, p.real());
        high_x = std::max(high_x, p.real());
        low_y = std::min(low_y, p.imag());
        high_y = std::max(high_y, p.imag());
    }
    double width() const { return high_x - low_x; }
    double height() const { return high_y - low_y; }
};

// Of numbers beyond this a product is none any more.
constexpr double farthest = 1e100;

bool is_measurable(const Chart& chart) {
    return std::all_of(chart.places.begin(), chart.places.end(), [](const Flat& t) {
        return std::all_of(t.begin(), t.end(), [](const ChartPoint& p) {
            return std::abs(p.real()) <= farthest && std::abs(p.imag()) <= farthest;
        });
    });
}

Shape shape_of(const Chart& chart, engine::Poll poll) {
    if (!is_measurable(chart)) return {std::vector<Flat>(chart.places.size()), 0, 0, 0};  // one texel
    const std::vector<ChartPoint> hull = convex_hull(chart, poll);
    ChartPoint best = 1;
    double least = HUGE_VAL;
    for (std::size_t i = 0; i < hull.size(); ++i) {
        const ChartPoint edge = hull[(i + 1) % hull.size()] - hull[i];
        if (!(std::abs(edge) > 0)) continue;
        ChartPoint turned = std::conj(edge) / std::abs(edge);
        Extent extent;
        for (const ChartPoint& p : hull) extent.add(p * turned);
        if (!(extent.width() * extent.height() < least * (1 - 1e-9))) continue;
        least = extent.width() * extent.height();
        best = extent.width() < extent.height() ? turned * ChartPoint(0, 1) : turned;
    }
    Shape shape;
    Extent extent;
    for (const ChartPoint& p : hull) extent.add(p * best);
    const ChartPoint low = {extent.low_x, extent.low_y};
    for (const Flat& t : chart.places) {
        shape.places.push_back({t[0] * best - low, t[1] * best - low, t[2] * best - low});
        shape.area += turn(t[0], t[1], t[2]) / 2;
    }
    shape.width = extent.width();
    shape.height = extent.height();
    return shape;
}

// A chart at some scale on some page.
struct Cut {
    double scale_x = 1, scale_y = 1;
    std::uint32_t grain = 1;
    bool single = true;
    BlockMask mask;

    // Corner in texels from the mask's top left: v down, half a block inside.
    ChartPoint place(const ChartPoint& p) const {
        return {grain / 2.0 + p.real() * scale_x,
                mask.rows * double(grain) - grain / 2.0 - p.imag() * scale_y};
    }
};

// Whether the inside of a triangle meets that of a square around (x, y).
bool meets(const Flat& t, double x, double y, double half) {
    const double slack = 1e-9 * half;
    for (std::size_t i = 0; i < 3; ++i) {
        const ChartPoint a = t[i], b = t[(i + 1) % 3], c = t[(i + 2) % 3];
        // The side of ab away from c.
        const ChartPoint d = b - a;
        const double sign = turn(a, b, c) > 0 ? 1 : -1;
        const double centre = sign * (std::conj(d) * (ChartPoint(x, y) - a)).imag();
        const double reach = half * (std::abs(d.real()) + std::abs(d.imag()));
        if (!(centre + reach > slack * std::abs(d))) return false;
    }
    return true;
}

BlockMask mask_of(const Shape& shape, const Cut& cut, engine::Poll poll) {
    const double grain = cut.grain;
    BlockMask mask = cut.mask;
    mask.blocks.assign(std::size_t{mask.columns} * mask.rows, 0);
    const auto clamped = [](double i, std::uint32_t n) {
        return static_cast<std::uint32_t>(std::clamp(i, 0.0, double(n - 1)));
    };
    for (const Flat& t : shape.places) {
        poll();
        const Flat p = {cut.place(t[0]), cut.place(t[1]), cut.place(t[2])};
        Extent extent;
        for (const ChartPoint& corner : p) extent.add(corner);
        const std::uint32_t x0 = clamped(std::floor(extent.low_x / grain - 0.5), mask.columns);
        const std::uint32_t x1 = clamped(std::ceil(extent.high_x / grain - 0.5), mask.columns);
        const std::uint32_t y0 = clamped(std::floor(extent.low_y / grain - 0.5), mask.rows);
        const std::uint32_t y1 = clamped(std::ceil(extent.high_y / grain - 0.5), mask.rows);
        for (std::uint32_t y = y0; y <= y1; ++y) {
            for (std::uint32_t x = x0; x <= x1; ++x) {
                std::uint8_t& block = mask.blocks[std::size_t{y} * mask.columns + x];
                if (!block) block = meets(p, (x + 0.5) * grain, (y + 0.5) * grain, grain);
            }
        }
    }
    return mask;
}

Cut cut_at(const Shape& shape, double scale, std::uint32_t width, std::uint32_t height, engine::Poll poll) {
    Cut cut{scale, scale, 1, true, {}};
    if (!(std::max(shape.width, shape.height) * scale >= 0.75)) return cut;
    cut.single = false;
    const double size = std::sqrt(shape.area) * scale;
    while (cut.grain < largest_grain && 16 * cut.grain < height && 2 * cut.grain <= grain_share * size)
        cut.grain *= 2;
    const auto squeezed = [&](double length, std::uint32_t page) {
        const double room = page - double(cut.grain);
        return length * scale > room ? room / length : scale;
    };
    cut.scale_x = squeezed(shape.width, width);
    cut.scale_y = squeezed(shape.height, height);
    const auto blocks = [&](double length) {
        return 1 + static_cast<std::uint32_t>(std::ceil(length / cut.grain - 1e-9));
    };
    cut.mask.columns = blocks(shape.width * cut.scale_x);
    cut.mask.rows = blocks(shape.height * cut.scale_y);
    cut.mask = mask_of(shape, cut, poll);
    return cut;
}

// Four to the octave.
std::uint32_t size_class(std::uint32_t blocks) {
    return static_cast<std::uint32_t>(std::lround(4 * std::log2(double(blocks))));
}

struct Placed {
    BlockSheet::Spot spot = {0, 0};
    std::uint32_t turns = 0;  // quarters
};

// One attempt at a scale and a page.
class Packing {
public:
    Packing(std::span<const Shape> shapes, double scale, std::uint32_t width, std::uint32_t height,
            engine::Poll poll)
        : width_(width), height_(height), poll_(poll) {
        cuts_.reserve(shapes.size());
        for (const Shape& shape : shapes) {
            poll();
            cuts_.push_back(cut_at(shape, scale, width, height, poll));
        }
    }

    bool run() {
        std::uint64_t texels = 0;
        for (const Cut& cut : cuts_) {
            const auto blocks = std::count_if(cut.mask.blocks.begin(), cut.mask.blocks.end(),
                                              [](std::uint8_t b) { return b != 0; });
            texels += static_cast<std::uint64_t>(blocks) * cut.grain * cut.grain;
        }
        if (texels > std::uint64_t{width_} * height_) return false;
        std::vector<std::size_t> order(cuts_.size());
        for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
        std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
            const auto key = [&](std::size_t i) {
                const Cut& cut = cuts_[i];
                return std::tuple(cut.grain, std::max(cut.mask.columns, cut.mask.rows),
                                  std::min(cut.mask.columns, cut.mask.rows));
            };
            return key(a) != key(b) ? key(a) > key(b) : a < b;
        });
        std::uint32_t grain = std::min({largest_grain, width_, height_});
        BlockSheet sheet(width_ / grain, height_ / grain);
        placed_.assign(cuts_.size(), {});
        // Where the last one of that size went: before it there is no room for the next one but for holes.
        std::map<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>, std::uint32_t> first_row;
        for (std::size_t number = 0; number < order.size(); ++number) {
            const std::size_t i = order[number];
            for (; grain > cuts_[i].grain; grain /= 2) sheet.refine();
            std::optional<Placed> best;
            std::uint32_t best_end = height_ / grain + 1;
            BlockMask mask = cuts_[i].mask, best_mask;
            const std::size_t blocks = mask.blocks.size();
            // Few blocks look alike after half a turn, and where one did not fit another one won't.
            const std::uint32_t turns = blocks > 16 ? 4 : blocks > 1 ? 2 : 1;
            for (std::uint32_t t = 0; t < turns; ++t, mask = mask.turned()) {
                if (mask.rows >= best_end) continue;
                std::uint32_t top = 0;
                const bool well = number < searched_well;
                std::uint32_t& from =
                    well ? top : first_row[{grain, size_class(mask.columns), size_class(mask.rows)}];
                const std::uint32_t step = well ? 1 : 1 + mask.rows / 8;
                const auto spot = sheet.find(mask, from, best_end - mask.rows, step, poll_);
                if (!spot) continue;
                from = spot->y;
                best = Placed{*spot, t};
                best_end = spot->y + mask.rows;
                best_mask = mask;
            }
            if (!best) return false;
            sheet.take(best_mask, best->spot);
            placed_[i] = *best;
        }
        return true;
    }

    const Cut& cut(std::size_t i) const { return cuts_[i]; }
    const Placed& placed(std::size_t i) const { return placed_[i]; }

private:
    std::uint32_t width_, height_;
    engine::Poll poll_;
    std::vector<Cut> cuts_;
    std::vector<Placed> placed_;
};

// On the page, after the chart's turns. All of them keep the sense of rotation.
ChartPoint page_point(const Cut& cut, const Placed& placed, const ChartPoint& p) {
    const double width = double(cut.mask.columns) * cut.grain, height = double(cut.mask.rows) * cut.grain;
    const ChartPoint corner = {double(placed.spot.x) * cut.grain, double(placed.spot.y) * cut.grain};
    switch (placed.turns) {
        case 1:
            return corner + ChartPoint(height - p.imag(), p.real());
        case 2:
            return corner + ChartPoint(width - p.real(), height - p.imag());
        case 3:
            return corner + ChartPoint(p.imag(), width - p.real());
        default:
            return corner + p;
    }
}

ChartPage page_of(std::span<const Chart> charts, std::span<const Shape> shapes, const Packing& packing,
                  std::size_t faces, std::uint32_t width, std::uint32_t height, double scale) {
    ChartPage page{{width, height, std::vector<AtlasPlace>(faces), {}, scale}, {}};
    for (std::size_t i = 0; i < charts.size(); ++i) {
        const Cut& cut = packing.cut(i);
        const Placed& placed = packing.placed(i);
        BlockMask mask = cut.mask;
        for (std::uint32_t t = 0; t < placed.turns; ++t) mask = mask.turned();
        AtlasChart chart{placed.spot.x * cut.grain,
                         placed.spot.y * cut.grain,
                         cut.grain,
                         mask.columns,
                         mask.rows,
                         mask.blocks,
                         charts[i].faces,
                         cut.single};
        for (std::size_t k = 0; k < charts[i].faces.size(); ++k) {
            auto& uv = page.atlas.places[charts[i].faces[k]].uv;
            for (std::size_t c = 0; c < 3; ++c) {
                const ChartPoint p = cut.single ? ChartPoint(chart.x + 0.5, chart.y + 0.5)
                                                : page_point(cut, placed, cut.place(shapes[i].places[k][c]));
                uv[c] = {p.real(), p.imag()};
            }
        }
        page.charts.push_back(std::move(chart));
    }
    return page;
}

}  // namespace

std::optional<ChartPage> pack_charts(std::span<const Chart> charts, std::size_t faces, std::uint32_t side,
                                     engine::Poll poll) {
    std::vector<Shape> shapes;
    double area = 0;
    for (const Chart& chart : charts) {
        poll(chart.places.size());
        shapes.push_back(shape_of(chart, poll));
        area += shapes.back().area;
    }
    std::uint32_t width = 4, height = 4;
    bool fits = false;
    for (; !fits; width *= 2) {
        for (const std::uint32_t h : {width / 2, width}) {
            height = h;
            fits = area <= double(width) * height && Packing(shapes, 1, width, height, poll).run();
            if (fits) break;
        }
        if (fits || width == side) break;
    }
    if (charts.size() > std::size_t{width} * height) return std::nullopt;
    double low = fits ? 1 : 0, high = fits ? std::sqrt(2.0) : 1;
    // Most pages end up about half full: the search begins there and goes on in small steps.
    double next = std::sqrt(0.55 * double(width) * height / area);
    while (high - low > 0.01 * high && high > 1e-6) {
        if (!(next > low && next < high)) next = (low + high) / 2;
        const bool good = Packing(shapes, next, width, height, poll).run();
        (good ? low : high) = next;
        next *= good ? 1.07 : 1 / 1.07;
    }
    Packing packing(shapes, low, width, height, poll);
    if (!packing.run()) return std::nullopt;
    return page_of(charts, shapes, packing, faces, width, height, low);
}

}  // namespace faqem::detail

#include "bake/atlas/tiles.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace faqem::detail {
namespace {

constexpr std::uint32_t max_tile_size = 64;

// Samples of a tile inside a box of texel coordinates; x1 and y1 are exclusive.
struct Range {
    std::uint32_t x0, x1, y0, y1;
};

class SampleOwners {
public:
    SampleOwners(const Atlas& atlas, const AtlasChart& chart, const ChartTile& tile, std::uint32_t samples)
        : atlas_(atlas),
          chart_(chart),
          tile_(tile),
          samples_(samples),
          columns_(tile.width * samples),
          rows_(tile.height * samples),
          owner_(std::size_t{columns_} * rows_, no_index) {}

    // Assigns samples inside a triangle to it, unless they are inside one that was visited before.
    void assign_covered(Index triangle) {
        Triangle2 uv = atlas_.placements[triangle];
        if (chart_.is_given && twice_signed_area(uv[0], uv[1], uv[2]) > 0) std::swap(uv[1], uv[2]);
        const Range range = range_of(bounding_box(uv));
        for (std::uint32_t j = range.y0; j < range.y1; ++j) {
            std::uint32_t begin = range.x0, end = range.x1;
            for (std::size_t c = 0; c < 3; ++c) cut_row(uv[c], uv[(c + 1) % 3], j, begin, end);
            for (std::uint32_t i = begin; i < end; ++i) {
                Index& owner = owner_[std::size_t{j} * columns_ + i];
                if (owner == no_index) owner = triangle;
            }
        }
    }

    // Assigns samples outside all triangles to this one if its edge opposite corner c is the closest so far.
    void assign_nearest(Index triangle, std::size_t c, double reach) {
        if (squared_distance_.empty())
            for (const Index owner : owner_) squared_distance_.push_back(owner == no_index ? HUGE_VAL : 0);
        const Triangle2& uv = atlas_.placements[triangle];
        const Point2 &a = uv[(c + 1) % 3], &b = uv[(c + 2) % 3];
        const Range range = range_of(bounding_box(std::array{a, b}).expanded(reach));
        for (std::uint32_t j = range.y0; j < range.y1; ++j) {
            for (std::uint32_t i = range.x0; i < range.x1; ++i) {
                const std::size_t at = std::size_t{j} * columns_ + i;
                if (!(squared_distance_[at] > 0)) continue;
                const double d = squared_distance_to_segment(a, b, position(i, j));
                if (!(d < squared_distance_[at])) continue;
                squared_distance_[at] = d;
                owner_[at] = triangle;
            }
        }
    }

    // Whether any sample of the chart has no triangle yet.
    bool has_unassigned() const {
        bool result = false;
        for_each_owned_sample([&](std::size_t at) { result = result || owner_[at] == no_index; });
        return result;
    }

    TileOwners finish() {
        TileOwners result;
        // Most samples have the same triangle as the one before.
        Index last = no_index;
        for_each_owned_sample([&](std::size_t at) {
            if (owner_[at] == last) return;
            last = owner_[at];
            if (last != no_index) result.triangles.push_back(last);
        });
        std::ranges::sort(result.triangles);
        result.triangles.erase(std::unique(result.triangles.begin(), result.triangles.end()),
                               result.triangles.end());
        result.owners.assign(owner_.size(), TileOwners::none);
        std::uint32_t number = TileOwners::none;
        last = no_index;
        for_each_owned_sample([&](std::size_t at) {
            if (owner_[at] != last) {
                last = owner_[at];
                const auto found = std::ranges::lower_bound(result.triangles, last);
                number = found != result.triangles.end()
                             ? static_cast<std::uint32_t>(found - result.triangles.begin())
                             : TileOwners::none;
            }
            result.owners[at] = number;
        });
        return result;
    }

private:
    // The samples of the tile inside a box, rounded outwards.
    Range range_of(const Box2& box) const {
        const auto index = [&](double texel, std::uint32_t from, std::uint32_t count) {
            return static_cast<std::uint32_t>(std::clamp((texel - from) * samples_, 0.0, double(count)));
        };
        return {index(box.low.x, tile_.x, columns_), index(box.high.x + 1, tile_.x, columns_),
                index(box.low.y, tile_.y, rows_), index(box.high.y + 1, tile_.y, rows_)};
    }

    Point2 position(std::uint32_t i, std::uint32_t j) const {
        return {tile_.x + (i + 0.5) / samples_, tile_.y + (j + 0.5) / samples_};
    }

    // Cuts samples of row j that are outside of edge ab. The area is a monotonic function of x, also with rounding, so
    // that they are at one end of the row.
    void cut_row(const Point2& a, const Point2& b, std::uint32_t j, std::uint32_t& begin,
                 std::uint32_t& end) const {
        const auto is_outside = [&](std::uint32_t i) {
            return twice_signed_area(a, b, position(i, j)) > 0;  // as v points down
        };
        // Skips halves of the row, then samples from the end that is cut.
        constexpr std::uint32_t few = 4;
        const bool cuts_begin = b.y > a.y;
        std::uint32_t from = begin, to = end;
        while (from < to) {
            const std::uint32_t next = cuts_begin ? from : to - 1;
            const std::uint32_t i = to - from > few ? from + (to - from) / 2 : next;
            if (is_outside(i) == cuts_begin)
                from = i + 1;
            else
                to = i;
        }
        (cuts_begin ? begin : end) = from;
    }

    template <class Visit>
    void for_each_owned_sample(Visit&& visit) const {
        for (std::uint32_t j = 0; j < rows_; ++j) {
            std::size_t at = std::size_t{j} * columns_;
            for (std::uint32_t x = 0; x < tile_.width; ++x) {
                const bool is_owned = chart_.owns(tile_.x + x, tile_.y + j / samples_);
                for (std::uint32_t i = 0; i < samples_; ++i, ++at)
                    if (is_owned) visit(at);
            }
        }
    }

    const Atlas& atlas_;
    const AtlasChart& chart_;
    const ChartTile& tile_;
    std::uint32_t samples_, columns_, rows_;
    std::vector<Index> owner_;              // by sample
    std::vector<double> squared_distance_;  // by sample, to its triangle; 0 inside
};

// Whether the neighbour across the edge opposite corner c of a triangle is there on the page, too.
bool is_beside(const Atlas& atlas, Index triangle, std::size_t c, const AdjacentTriangle& other) {
    const Triangle2 &own = atlas.placements[triangle], &its = atlas.placements[other.triangle];
    return own[(c + 1) % 3] == its[(other.corner + 2) % 3] && own[(c + 2) % 3] == its[(other.corner + 1) % 3];
}

}  // namespace

std::vector<ChartTile> split_into_tiles(std::span<const AtlasChart> charts) {
    std::vector<ChartTile> result;
    for (std::size_t i = 0; i < charts.size(); ++i) {
        const AtlasChart& chart = charts[i];
        const std::uint32_t step = std::max(1u, max_tile_size / chart.block_size);  // blocks
        for (std::uint32_t y = 0; y < chart.mask.rows; y += step) {
            for (std::uint32_t x = 0; x < chart.mask.columns; x += step) {
                const std::uint32_t columns = std::min(step, chart.mask.columns - x),
                                    rows = std::min(step, chart.mask.rows - y);
                bool any = false;
                for (std::uint32_t j = y; j < y + rows; ++j)
                    for (std::uint32_t k = x; k < x + columns; ++k) any = any || chart.mask(k, j);
                if (!any) continue;
                result.push_back({static_cast<Index>(i), chart.x + x * chart.block_size,
                                  chart.y + y * chart.block_size, columns * chart.block_size,
                                  rows * chart.block_size});
            }
        }
    }
    return result;
}

TileOwners tile_owners(const Atlas& atlas, const AtlasChart& chart, std::span<const PageTriangle> triangles,
                       const ChartTile& tile, std::uint32_t samples) {
    if (chart.is_single_texel) {
        // All triangles share the texel: its samples are assigned to them in turn.
        TileOwners result{chart.triangles, {}};
        for (std::uint32_t i = 0; i < samples * samples; ++i)
            result.owners.push_back(i % static_cast<std::uint32_t>(chart.triangles.size()));
        return result;
    }
    SampleOwners owners(atlas, chart, tile, samples);
    for (Index t : chart.triangles) owners.assign_covered(t);
    if (!owners.has_unassigned()) return owners.finish();
    // Samples in the chart's blocks are at most 1.5 blocks away from the chart along each axis.
    const double reach = 2 * chart.block_size;
    for (Index t : chart.triangles) {
        for (std::size_t c = 0; c < 3; ++c) {
            const AdjacentTriangle& other = triangles[t].adjacent[c];
            const bool within = other.triangle != no_index &&
                                std::ranges::binary_search(chart.triangles, other.triangle) &&
                                (!chart.is_given || is_beside(atlas, t, c, other));
            if (!within) owners.assign_nearest(t, c, reach);
        }
    }
    return owners.finish();
}

}  // namespace faqem::detail

#include "bake/atlas/box_grid.hpp"

#include <cmath>
#include <limits>

namespace faqem::detail {

BoxGrid::BoxGrid(std::span<const Box2> boxes) {
    Box2 all;
    for (const Box2& b : boxes) {
        all.add(b.low);
        all.add(b.high);
    }
    low_ = all.low;
    const double cell = std::max({std::sqrt(all.width() * all.height() / static_cast<double>(boxes.size())),
                                  all.size() / 4096, std::numeric_limits<double>::min()});
    scale_ = 1 / cell;
    columns_ = static_cast<std::size_t>(all.width() * scale_) + 1;
    rows_ = static_cast<std::size_t>(all.height() * scale_) + 1;
}

std::optional<BoxGrid> BoxGrid::build(std::span<const Box2> boxes, std::uint64_t& work) {
    for (const Box2& b : boxes) {
        if (!std::isfinite(b.low.x + b.low.y + b.high.x + b.high.y)) return std::nullopt;
    }
    BoxGrid grid(boxes);
    std::uint64_t entries = 0;
    for (const Box2& b : boxes) {
        entries += grid.covered_cell_count(b);
        if (entries > work) {
            work = 0;
            return std::nullopt;
        }
    }
    work -= entries;
    grid.members_ = Buckets<Index>(grid.cells(), [&](auto&& put) {
        for (Index i = 0; i < boxes.size(); ++i)
            grid.visit(boxes[i], [&](std::size_t cell) { put(cell, i); });
    });
    return grid;
}

}  // namespace faqem::detail

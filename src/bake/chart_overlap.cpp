#include "bake/chart_overlap.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace faqem::detail {
namespace {

using Flat = std::array<ChartPoint, 3>;

struct Box {
    double low_x, low_y, high_x, high_y;

    double size() const { return std::max(high_x - low_x, high_y - low_y); }
};

Box box_of(const Flat& t) {
    const auto [x0, x1] = std::minmax({t[0].real(), t[1].real(), t[2].real()});
    const auto [y0, y1] = std::minmax({t[0].imag(), t[1].imag(), t[2].imag()});
    return {x0, y0, x1, y1};
}

// Whether an edge of a has all of b outside of it, or within `slack` of that.
bool parted_by_edge(const Flat& a, const Flat& b, double slack) {
    for (std::size_t i = 0; i < 3; ++i) {
        const ChartPoint &from = a[i], &to = a[(i + 1) % 3];
        const double limit = slack * std::abs(to - from);
        if (turn(from, to, b[0]) <= limit && turn(from, to, b[1]) <= limit && turn(from, to, b[2]) <= limit) {
            return true;
        }
    }
    return false;
}

// Two convex shapes are apart if and only if an edge of one of them parts them.
bool parted(const Flat& a, const Box& box_a, const Flat& b, const Box& box_b) {
    const double slack = 1e-9 * std::max(box_a.size(), box_b.size());
    if (box_a.high_x <= box_b.low_x + slack || box_b.high_x <= box_a.low_x + slack) return true;
    if (box_a.high_y <= box_b.low_y + slack || box_b.high_y <= box_a.low_y + slack) return true;
    return parted_by_edge(a, b, slack) || parted_by_edge(b, a, slack);
}

// A grid of about as many cells as triangles.
class Grid {
public:
    Grid(std::span<const Box> boxes) {
        constexpr double inf = std::numeric_limits<double>::infinity();
        Box all{inf, inf, -inf, -inf};
        for (const Box& b : boxes) {
            all = {std::min(all.low_x, b.low_x), std::min(all.low_y, b.low_y), std::max(all.high_x, b.high_x),
                   std::max(all.high_y, b.high_y)};
        }
        low_x_ = all.low_x;
        low_y_ = all.low_y;
        const double width = all.high_x - all.low_x, height = all.high_y - all.low_y;
        const double cell = std::max({std::sqrt(width * height / static_cast<double>(boxes.size())),
                                      all.size() / 4096, std::numeric_limits<double>::min()});
        scale_ = 1 / cell;
        columns_ = static_cast<std::size_t>(width * scale_) + 1;
        rows_ = static_cast<std::size_t>(height * scale_) + 1;
    }

    std::size_t cells() const { return columns_ * rows_; }

    template <class Visit>
    void visit(const Box& box, Visit&& visit) const {
        const std::size_t x0 = column(box.low_x), x1 = column(box.high_x);
        for (std::size_t y = row(box.low_y); y <= row(box.high_y); ++y) {
            for (std::size_t x = x0; x <= x1; ++x) visit(y * columns_ + x);
        }
    }

    // Of a point.
    std::size_t cell(double x, double y) const { return row(y) * columns_ + column(x); }

    std::size_t cells_under(const Box& box) const {
        return (column(box.high_x) - column(box.low_x) + 1) * (row(box.high_y) - row(box.low_y) + 1);
    }

private:
    std::size_t column(double x) const {
        return std::min(columns_ - 1, static_cast<std::size_t>((x - low_x_) * scale_));
    }
    std::size_t row(double y) const {
        return std::min(rows_ - 1, static_cast<std::size_t>((y - low_y_) * scale_));
    }

    double low_x_, low_y_, scale_;
    std::size_t columns_, rows_;
};

}  // namespace

bool apart(std::span<const Flat> triangles, std::uint64_t& work, engine::Poll poll) {
    if (triangles.size() < 2) return true;
    std::vector<Box> boxes;
    boxes.reserve(triangles.size());
    for (const Flat& t : triangles) boxes.push_back(box_of(t));
    for (const Box& b : boxes) {
        if (!std::isfinite(b.low_x + b.low_y + b.high_x + b.high_y)) return false;
    }
    const Grid grid(boxes);
    std::vector<std::uint64_t> begin(grid.cells() + 1, 0);
    std::uint64_t entries = 0;
    for (const Box& b : boxes) {
        entries += grid.cells_under(b);
        if (entries > work) {
            work = 0;
            return false;
        }
    }
    work -= entries;
    for (const Box& b : boxes) grid.visit(b, [&](std::size_t cell) { ++begin[cell + 1]; });
    for (std::size_t i = 0; i + 1 < begin.size(); ++i) begin[i + 1] += begin[i];
    std::vector<Index> members(entries);
    std::vector<std::uint64_t> fill(begin.begin(), begin.end() - 1);
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        grid.visit(boxes[i], [&](std::size_t cell) { members[fill[cell]++] = static_cast<Index>(i); });
    }
    for (std::size_t cell = 0; cell < grid.cells(); ++cell) {
        poll();
        for (std::uint64_t i = begin[cell]; i < begin[cell + 1]; ++i) {
            const Box& a = boxes[members[i]];
            for (std::uint64_t j = i + 1; j < begin[cell + 1]; ++j) {
                poll();
                if (work-- == 0) {
                    work = 0;
                    return false;
                }
                const Box& b = boxes[members[j]];
                // Once per pair: in the first cell that both are in.
                if (grid.cell(std::max(a.low_x, b.low_x), std::max(a.low_y, b.low_y)) != cell) continue;
                if (!parted(triangles[members[i]], a, triangles[members[j]], b)) return false;
            }
        }
    }
    return true;
}

}  // namespace faqem::detail

#pragma once
/// \file
/// Broad phase for intersection tests in the plane: pairs of boxes that share a cell of a grid.

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>

#include "bake/atlas/point2.hpp"
#include "faqem/detail/base/buckets.hpp"
#include "faqem/mesh.hpp"

namespace faqem::detail {

/// A uniform grid with about as many cells as boxes, and the boxes that overlap each cell.
class BoxGrid {
public:
    /// Builds the grid.
    /// \param boxes  at least one
    /// \param work   maximum number of entries; decreased by the number made
    /// \return nothing if `work` is used up or a box is not finite
    static std::optional<BoxGrid> build(std::span<const Box2> boxes, std::uint64_t& work);

    /// Calls test(a, b) once for every pair of boxes that share a cell, until it returns false.
    /// \param boxes  those that the grid was built from
    /// \param work   maximum number of pairs visited; decreased by the number visited
    /// \return whether `test` always returned true; false also if `work` is used up before
    /// Complexity: O(n) expected.
    template <class Test>
    bool all_pairs(std::span<const Box2> boxes, std::uint64_t& work, const Test& test) const {
        for (std::size_t cell = 0; cell < cells(); ++cell) {
            const std::span<const Index> members = members_[cell];
            for (std::size_t i = 0; i < members.size(); ++i) {
                const Box2& a = boxes[members[i]];
                for (std::size_t j = i + 1; j < members.size(); ++j) {
                    if (work == 0) return false;
                    --work;
                    const Box2& b = boxes[members[j]];
                    // A pair is tested once, in the first cell that both boxes overlap.
                    if (cell_at({std::max(a.low.x, b.low.x), std::max(a.low.y, b.low.y)}) != cell) continue;
                    if (!test(members[i], members[j])) return false;
                }
            }
        }
        return true;
    }

private:
    /// Chooses the extent and the cell size; the cells are still empty.
    explicit BoxGrid(std::span<const Box2> boxes);

    /// Calls visit_cell(cell) for every cell that the box overlaps.
    template <class Visit>
    void visit(const Box2& box, const Visit& visit_cell) const {
        const std::size_t x0 = column(box.low.x), x1 = column(box.high.x);
        for (std::size_t y = row(box.low.y); y <= row(box.high.y); ++y) {
            for (std::size_t x = x0; x <= x1; ++x) visit_cell(y * columns_ + x);
        }
    }
    /// Number of cells that the box overlaps.
    std::size_t covered_cell_count(const Box2& box) const {
        return (column(box.high.x) - column(box.low.x) + 1) * (row(box.high.y) - row(box.low.y) + 1);
    }
    std::size_t cells() const { return columns_ * rows_; }
    /// Index of the cell that contains p.
    std::size_t cell_at(const Point2& p) const { return row(p.y) * columns_ + column(p.x); }
    std::size_t column(double x) const {
        return std::min(columns_ - 1, static_cast<std::size_t>((x - low_.x) * scale_));
    }
    std::size_t row(double y) const {
        return std::min(rows_ - 1, static_cast<std::size_t>((y - low_.y) * scale_));
    }

    Point2 low_;    ///< lower left corner of the grid
    double scale_;  ///< cells per unit of length
    std::size_t columns_, rows_;
    Buckets<Index> members_;  ///< indices of boxes by cell
};

}  // namespace faqem::detail

#pragma once
/// \file
/// Broad phase for intersection tests in the plane: pairs of boxes that share a cell of a grid.

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "faqem/engine/util/cancellation.hpp"
#include "faqem/mesh.hpp"

namespace faqem::detail {

/// Axis-aligned bounding box in the plane.
struct Box2 {
    double low_x, low_y, high_x, high_y;

    double size() const { return std::max(high_x - low_x, high_y - low_y); }
};

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
    /// \throws whatever `check_cancelled` throws
    template <class Test>
    bool all_pairs(std::span<const Box2> boxes, std::uint64_t& work,
                   engine::CancellationCheck check_cancelled, const Test& test) const {
        for (std::size_t cell = 0; cell + 1 < begin_.size(); ++cell) {
            check_cancelled();
            for (std::uint64_t i = begin_[cell]; i < begin_[cell + 1]; ++i) {
                const Box2& a = boxes[members_[i]];
                for (std::uint64_t j = i + 1; j < begin_[cell + 1]; ++j) {
                    check_cancelled();
                    if (work == 0) return false;
                    --work;
                    const Box2& b = boxes[members_[j]];
                    // A pair is tested once, in the first cell that both boxes overlap.
                    if (cell_at(std::max(a.low_x, b.low_x), std::max(a.low_y, b.low_y)) != cell) continue;
                    if (!test(members_[i], members_[j])) return false;
                }
            }
        }
        return true;
    }

private:
    explicit BoxGrid(std::span<const Box2> boxes);

    template <class Visit>
    void visit(const Box2& box, const Visit& visit) const {
        const std::size_t x0 = column(box.low_x), x1 = column(box.high_x);
        for (std::size_t y = row(box.low_y); y <= row(box.high_y); ++y) {
            for (std::size_t x = x0; x <= x1; ++x) visit(y * columns_ + x);
        }
    }
    std::size_t covered_cell_count(const Box2& box) const {
        return (column(box.high_x) - column(box.low_x) + 1) * (row(box.high_y) - row(box.low_y) + 1);
    }
    std::size_t cell_at(double x, double y) const { return row(y) * columns_ + column(x); }
    std::size_t column(double x) const {
        return std::min(columns_ - 1, static_cast<std::size_t>((x - low_x_) * scale_));
    }
    std::size_t row(double y) const {
        return std::min(rows_ - 1, static_cast<std::size_t>((y - low_y_) * scale_));
    }

    double low_x_, low_y_, scale_;
    std::size_t columns_, rows_;
    std::vector<std::uint64_t> begin_;  ///< by cell: offset of its boxes in members_; one more at the end
    std::vector<Index> members_;        ///< indices of boxes, cell by cell
};

}  // namespace faqem::detail

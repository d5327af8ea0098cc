#pragma once
/// \file
/// Which boxes in the plane meet.

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "faqem/engine/util/cancellation.hpp"
#include "faqem/mesh.hpp"

namespace faqem::detail {

struct Box2 {
    double low_x, low_y, high_x, high_y;

    double size() const { return std::max(high_x - low_x, high_y - low_y); }
};

/// A grid of about as many cells as boxes, and which boxes are in which cell.
class BoxGrid {
public:
    /// \param work  entries to make at most; lowered by those made
    /// \return none if the work is used up, or a box is not finite
    static std::optional<BoxGrid> build(std::span<const Box2> boxes, std::uint64_t& work);

    /// Calls test(a, b) once for each two boxes that share a cell, until it says no. Expected O(n).
    /// \param work  pairs to look at at most; lowered by those
    /// \return whether it always said yes; false too if the work is used up before
    /// \throws what the poll throws
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
                    // Once per pair: in the first cell that both are in.
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
    std::vector<std::uint64_t> begin_;  ///< by cell, one more: into members_
    std::vector<Index> members_;
};

}  // namespace faqem::detail

#pragma once
/// \file
/// Free and taken blocks of a page.

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "faqem/engine/util/cancellation.hpp"

namespace faqem::detail {

/// The blocks that a chart needs, row by row.
struct BlockMask {
    std::uint32_t columns = 1, rows = 1;
    std::vector<std::uint8_t> blocks = {1};

    bool operator()(std::uint32_t x, std::uint32_t y) const {
        return blocks[std::size_t{y} * columns + x] != 0;
    }
    /// By a quarter: what was right is down then.
    BlockMask rotated() const;
};

/// A rectangle of blocks, one bit each.
class OccupancyGrid {
public:
    OccupancyGrid(std::uint32_t columns, std::uint32_t rows);

    /// Every block becomes four.
    void refine();

    struct BlockPosition {
        std::uint32_t x, y;
    };
    /// The first place, by row and then by column, where all of the mask's blocks are free.
    /// \param from, end  range of rows for the mask's first one
    /// \param step  only every step-th of them
    /// \throws what the poll throws
    std::optional<BlockPosition> find_free(const BlockMask& mask, std::uint32_t from, std::uint32_t end,
                                           std::uint32_t step,
                                           engine::CancellationCheck check_cancelled = {}) const;

    void occupy(const BlockMask& mask, BlockPosition position);

private:
    using Row = std::vector<std::uint64_t>;
    struct Run {
        std::uint32_t row, begin, length;
    };
    static std::vector<Run> runs_of(const BlockMask& mask);
    void update_longest_run(std::uint32_t y);
    bool find_free_columns(std::span<const Run> runs, std::uint32_t y, Row& candidates, Row& scratch) const;

    std::uint32_t columns_, rows_;
    std::vector<Row> free_;
    std::vector<std::uint32_t> longest_free_run_;  // free stretch of every row
};

}  // namespace faqem::detail

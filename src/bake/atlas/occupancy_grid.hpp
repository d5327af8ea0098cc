#pragma once
/// \file
/// Free and occupied blocks of a page.

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace faqem::detail {

/// The blocks that a chart occupies.
struct BlockMask {
    std::uint32_t columns = 1, rows = 1;
    std::vector<std::uint8_t> blocks = {1};  ///< row by row: nonzero for occupied blocks

    bool operator()(std::uint32_t x, std::uint32_t y) const {
        return blocks[std::size_t{y} * columns + x] != 0;
    }
    /// Rotated 90 degrees clockwise.
    BlockMask rotated() const;
};

/// A rectangular bitmap of free blocks.
class OccupancyGrid {
public:
    OccupancyGrid(std::uint32_t columns, std::uint32_t rows);

    /// Halves the size of blocks: every block becomes four.
    void refine();

    struct BlockPosition {
        std::uint32_t x, y;
    };
    /// The first position, by row and then by column, at which all blocks of the mask are free.
    /// \param mask  blocks to be occupied
    /// \param from  first row to be tried for the mask's first row
    /// \param end   end (exclusive) of these rows
    /// \param step  only every step-th row is tried
    /// \return nothing if the mask does not fit
    std::optional<BlockPosition> find_free(const BlockMask& mask, std::uint32_t from, std::uint32_t end,
                                           std::uint32_t step) const;

    /// Marks the blocks of the mask as occupied.
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
    std::vector<std::uint32_t> longest_free_run_;  // by row, for early rejection
};

}  // namespace faqem::detail

#include "bake/atlas/occupancy_grid.hpp"

#include <algorithm>
#include <bit>

namespace faqem::detail {
namespace {

// row &= row >> by, where bits beyond the end are 0.
void and_with_shifted(std::vector<std::uint64_t>& row, std::uint32_t by) {
    const std::size_t words = by / 64, bits = by % 64;
    for (std::size_t i = 0; i < row.size(); ++i) {
        const std::uint64_t low = i + words < row.size() ? row[i + words] : 0;
        const std::uint64_t high = i + words + 1 < row.size() ? row[i + words + 1] : 0;
        row[i] &= bits ? (low >> bits) | (high << (64 - bits)) : low;
    }
}

}  // namespace

BlockMask BlockMask::rotated() const {
    BlockMask result{rows, columns, std::vector<std::uint8_t>(blocks.size())};
    for (std::uint32_t y = 0; y < rows; ++y) {
        for (std::uint32_t x = 0; x < columns; ++x) {
            result.blocks[std::size_t{x} * rows + (rows - 1 - y)] = blocks[std::size_t{y} * columns + x];
        }
    }
    return result;
}

OccupancyGrid::OccupancyGrid(std::uint32_t columns, std::uint32_t rows)
    : columns_(columns), rows_(rows), free_(rows, Row((columns + 63) / 64, 0)) {
    for (Row& row : free_) {
        for (std::uint32_t x = 0; x < columns; ++x) row[x / 64] |= std::uint64_t{1} << (x % 64);
    }
    longest_free_run_.assign(rows, columns);
}

void OccupancyGrid::refine() {
    OccupancyGrid fine(2 * columns_, 2 * rows_);
    for (std::uint32_t y = 0; y < fine.rows_; ++y) {
        for (std::uint32_t x = 0; x < fine.columns_; ++x) {
            if (!(free_[y / 2][x / 128] >> (x / 2 % 64) & 1)) {
                fine.free_[y][x / 64] &= ~(std::uint64_t{1} << (x % 64));
            }
        }
        fine.longest_free_run_[y] = 2 * longest_free_run_[y / 2];
    }
    *this = std::move(fine);
}

std::vector<OccupancyGrid::Run> OccupancyGrid::runs_of(const BlockMask& mask) {
    std::vector<Run> result;
    for (std::uint32_t y = 0; y < mask.rows; ++y) {
        for (std::uint32_t x = 0; x < mask.columns; ++x) {
            if (!mask(x, y)) continue;
            const std::uint32_t begin = x;
            while (x < mask.columns && mask(x, y)) ++x;
            result.push_back({y, begin, x - begin});
        }
    }
    // Longest runs first: they are the least likely to fit, so that the search ends early.
    std::stable_sort(result.begin(), result.end(),
                     [](const Run& a, const Run& b) { return a.length > b.length; });
    return result;
}

void OccupancyGrid::update_longest_run(std::uint32_t y) {
    std::uint32_t longest = 0, run = 0;
    for (std::uint64_t word : free_[y]) {
        for (std::uint32_t left = 64; left > 0;) {
            const std::uint32_t ones = std::min(left, static_cast<std::uint32_t>(std::countr_one(word)));
            run += ones;
            longest = std::max(longest, run);
            if ((left -= ones) == 0) break;
            run = 0;
            word >>= ones;
            const std::uint32_t zeros = std::min(left, static_cast<std::uint32_t>(std::countr_zero(word)));
            left -= zeros;
            word = zeros < 64 ? word >> zeros : 0;
        }
    }
    longest_free_run_[y] = longest;
}

// Sets bit x of `candidates` if the mask fits at row y with its first column at x. Returns false if it fits
// nowhere in this row.
bool OccupancyGrid::find_free_columns(std::span<const Run> runs, std::uint32_t y, Row& candidates,
                                      Row& scratch) const {
    for (const Run& run : runs) {
        if (longest_free_run_[y + run.row] < run.length) return false;
    }
    candidates.assign(free_[0].size(), ~std::uint64_t{0});
    for (const Run& run : runs) {
        scratch = free_[y + run.row];
        // Bit x of `scratch`: the `known` blocks from x on are free.
        for (std::uint32_t known = 1; known < run.length;) {
            const std::uint32_t more = std::min(known, run.length - known);
            and_with_shifted(scratch, more);
            known += more;
        }
        const std::size_t words = run.begin / 64, bits = run.begin % 64;
        std::uint64_t any = 0;
        for (std::size_t i = 0; i < candidates.size(); ++i) {
            const std::uint64_t low = i + words < scratch.size() ? scratch[i + words] : 0;
            const std::uint64_t high = i + words + 1 < scratch.size() ? scratch[i + words + 1] : 0;
            candidates[i] &= bits ? (low >> bits) | (high << (64 - bits)) : low;
            any |= candidates[i];
        }
        if (any == 0) return false;
    }
    return true;
}

std::optional<OccupancyGrid::BlockPosition> OccupancyGrid::find_free(const BlockMask& mask,
                                                                     std::uint32_t from, std::uint32_t end,
                                                                     std::uint32_t step) const {
    if (mask.columns > columns_ || mask.rows > rows_) return std::nullopt;
    const std::vector<Run> runs = runs_of(mask);
    Row candidates, scratch;
    for (std::uint32_t y = from; y < std::min(end, rows_ - mask.rows + 1); y += step) {
        if (!find_free_columns(runs, y, candidates, scratch)) continue;
        for (std::uint32_t i = 0; i < candidates.size(); ++i) {
            if (candidates[i])
                return BlockPosition{64 * i + static_cast<std::uint32_t>(std::countr_zero(candidates[i])), y};
        }
    }
    return std::nullopt;
}

void OccupancyGrid::occupy(const BlockMask& mask, BlockPosition position) {
    for (std::uint32_t y = 0; y < mask.rows; ++y) {
        for (std::uint32_t x = 0; x < mask.columns; ++x) {
            if (!mask(x, y)) continue;
            free_[position.y + y][(position.x + x) / 64] &= ~(std::uint64_t{1} << ((position.x + x) % 64));
        }
        update_longest_run(position.y + y);
    }
}

}  // namespace faqem::detail

#include "bake/atlas/occupancy_grid.hpp"

#include <algorithm>
#include <bit>

namespace faqem::detail {
namespace {

// Word i of a row of bits that is shifted down. The row must have words up to i + by / 64 + 1.
std::uint64_t shifted_word(const std::uint64_t* row, std::size_t i, std::uint32_t by) {
    const std::size_t at = i + by / 64, bits = by % 64;
    return (row[at] >> bits) | ((row[at + 1] << 1) << (63 - bits));
}

// row &= row >> by, for the first `count` words. The row must have words up to count + by / 64.
void and_with_shifted(std::uint64_t* row, std::size_t count, std::uint32_t by) {
    for (std::size_t i = 0; i < count; ++i) row[i] &= shifted_word(row, i, by);
}

// Every bit of the lower half of a word twice.
std::uint64_t doubled_bits(std::uint64_t word) {
    word &= 0xffffffff;
    word = (word | word << 16) & 0x0000ffff0000ffff;
    word = (word | word << 8) & 0x00ff00ff00ff00ff;
    word = (word | word << 4) & 0x0f0f0f0f0f0f0f0f;
    word = (word | word << 2) & 0x3333333333333333;
    word = (word | word << 1) & 0x5555555555555555;
    return word | word << 1;
}

}  // namespace

BlockMask BlockMask::rotated() const {
    BlockMask result{rows, columns, std::vector<std::uint8_t>(blocks.size())};
    for (std::uint32_t y = 0; y < rows; ++y)
        for (std::uint32_t x = 0; x < columns; ++x)
            result.blocks[std::size_t{x} * rows + (rows - 1 - y)] = blocks[std::size_t{y} * columns + x];
    return result;
}

OccupancyGrid::OccupancyGrid(std::uint32_t columns, std::uint32_t rows)
    : columns_(columns), rows_(rows), free_(rows, Row((columns + 63) / 64, ~std::uint64_t{0})) {
    if (columns % 64 > 0)
        for (Row& row : free_) row.back() = (std::uint64_t{1} << (columns % 64)) - 1;
    longest_free_run_.assign(rows, columns);
}

void OccupancyGrid::refine() {
    OccupancyGrid fine(2 * columns_, 2 * rows_);
    for (std::uint32_t y = 0; y < fine.rows_; ++y) {
        Row& to = fine.free_[y];
        for (std::size_t i = 0; i < to.size(); ++i)
            to[i] = doubled_bits(free_[y / 2][i / 2] >> (i % 2 ? 32 : 0));
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
    std::ranges::stable_sort(result, std::ranges::greater{}, &Run::length);
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
    for (const Run& run : runs)
        if (longest_free_run_[y + run.row] < run.length) return false;
    candidates.assign(free_[0].size(), ~std::uint64_t{0});
    std::size_t begin = 0, end = candidates.size();  // of the words with candidates
    for (const Run& run : runs) {
        // The words of the row on which the candidates depend, and zeros for what is beyond its end.
        const Row& row = free_[y + run.row];
        const std::size_t first = begin + run.begin / 64, count = end - begin + 1;
        const std::size_t size = count + run.length / 64 + 1;
        scratch.assign(size + 1, 0);
        if (first < row.size())
            std::copy_n(row.data() + first, std::min(row.size() - first, size), scratch.data());
        // Bit x of `scratch`: the `known` blocks from x on are free.
        for (std::uint32_t known = 1; known < run.length;) {
            const std::uint32_t more = std::min(known, run.length - known);
            // What the last words lack has no influence on the first `count` words.
            and_with_shifted(scratch.data(), size - more / 64, more);
            known += more;
        }
        for (std::size_t i = begin; i < end; ++i)
            candidates[i] &= shifted_word(scratch.data(), i - begin, run.begin % 64);
        while (begin < end && candidates[begin] == 0) ++begin;
        while (begin < end && candidates[end - 1] == 0) --end;
        if (begin == end) return false;
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
        for (std::uint32_t i = 0; i < candidates.size(); ++i)
            if (candidates[i])
                return BlockPosition{64 * i + static_cast<std::uint32_t>(std::countr_zero(candidates[i])), y};
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

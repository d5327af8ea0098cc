#include "bake/atlas/occupancy_grid.hpp"

#include <optional>
#include <vector>

#include "support/catch.hpp"
#include "support/meshes.hpp"

using faqem::detail::BlockMask;
using faqem::detail::OccupancyGrid;
using faqem::test::Random;

namespace {

// The same as OccupancyGrid, block by block.
struct SlowGrid {
    std::uint32_t columns, rows;
    std::vector<std::uint8_t> occupied = std::vector<std::uint8_t>(std::size_t{columns} * rows, 0);

    bool is_free(const BlockMask& mask, std::uint32_t x, std::uint32_t y) const {
        for (std::uint32_t j = 0; j < mask.rows; ++j)
            for (std::uint32_t i = 0; i < mask.columns; ++i)
                if (mask(i, j) && occupied[std::size_t{y + j} * columns + x + i]) return false;
        return true;
    }
    std::optional<OccupancyGrid::BlockPosition> find_free(const BlockMask& mask, std::uint32_t from,
                                                          std::uint32_t step) const {
        for (std::uint32_t y = from; y + mask.rows <= rows; y += step)
            for (std::uint32_t x = 0; x + mask.columns <= columns; ++x)
                if (is_free(mask, x, y)) return OccupancyGrid::BlockPosition{x, y};
        return std::nullopt;
    }
    void occupy(const BlockMask& mask, const OccupancyGrid::BlockPosition& at) {
        for (std::uint32_t j = 0; j < mask.rows; ++j)
            for (std::uint32_t i = 0; i < mask.columns; ++i)
                if (mask(i, j)) occupied[std::size_t{at.y + j} * columns + at.x + i] = 1;
    }
    void refine() {
        SlowGrid fine{2 * columns, 2 * rows};
        for (std::uint32_t y = 0; y < fine.rows; ++y)
            for (std::uint32_t x = 0; x < fine.columns; ++x)
                fine.occupied[std::size_t{y} * fine.columns + x] =
                    occupied[std::size_t{y / 2} * columns + x / 2];
        *this = fine;
    }
};

// Of random size. The first and the last row and column are not empty.
BlockMask random_mask(Random& random, std::uint32_t max_columns, double filled) {
    BlockMask mask{1 + random.below(max_columns), 1 + random.below(5), {}};
    for (std::size_t i = 0; i < std::size_t{mask.columns} * mask.rows; ++i)
        mask.blocks.push_back(random.unit() < filled);
    mask.blocks.back() = mask.blocks[0] = mask.blocks[mask.columns - 1] = 1;
    return mask;
}

}  // namespace

TEST_CASE("occupancy grids find the same positions as a search block by block") {
    Random random(3);
    std::size_t found = 0, missing = 0;
    for (const std::uint32_t columns : {1u, 31u, 63u, 64u, 65u, 128u, 200u, 256u}) {
        OccupancyGrid grid(columns, 24);
        SlowGrid slow{columns, 24};
        for (std::uint32_t level = 0; level < 2; ++level) {
            for (int i = 0; i < 60; ++i) {
                const BlockMask mask = random_mask(random, 1 + columns / (i % 2 ? 2 : 6), i % 3 ? 0.9 : 0.5);
                const std::uint32_t from = i % 4 ? 0 : random.below(slow.rows), step = 1 + random.below(3);
                const auto position = grid.find_free(mask, from, slow.rows, step);
                const auto wanted = slow.find_free(mask, from, step);
                REQUIRE(position.has_value() == wanted.has_value());
                ++(position ? found : missing);
                if (!position) continue;
                CHECK((position->x == wanted->x && position->y == wanted->y));
                grid.occupy(mask, *position);
                slow.occupy(mask, *position);
            }
            grid.refine();
            slow.refine();
        }
    }
    CHECK((found > 100 && missing > 100));
}

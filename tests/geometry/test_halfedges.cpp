#include "faqem/detail/geometry/halfedges.hpp"

#include <catch2/catch.hpp>

#include "support/meshes.hpp"

using namespace faqem;
using detail::Side;

TEST_CASE("sides: those on one edge lie together, and know where they begin and which way they go") {
    //  3---2
    //  | / |
    //  0---1
    const std::vector<Triangle> triangles = test::quad().triangles;
    std::vector<std::pair<std::size_t, std::uint64_t>> edges;
    const std::vector<Side> sides = detail::sorted_sides(triangles);
    REQUIRE(sides.size() == 6);
    detail::for_each_edge(sides, [&](std::span<const Side> on) {
        edges.emplace_back(on.size(), on[0].edge());
        for (const Side& side : on) {
            const Triangle& t = triangles[side.face];
            const Index from = t[side.corner], to = t[(side.corner + 1) % 3];
            CHECK(from == (side.goes_up ? side.low : side.high));
            CHECK(to == (side.goes_up ? side.high : side.low));
        }
    });
    const auto edge = [](std::uint64_t low, std::uint64_t high) { return low << 32 | high; };
    CHECK(edges == std::vector<std::pair<std::size_t, std::uint64_t>>{
                       {1, edge(0, 1)}, {2, edge(0, 2)}, {1, edge(0, 3)}, {1, edge(1, 2)}, {1, edge(2, 3)}});
}

TEST_CASE("sides: faces on an edge come by number, missing triangles and equal ends are left out") {
    const std::vector<Triangle> triangles = {{4, 5, 6}, {no_index, no_index, no_index}, {5, 4, 7}, {8, 8, 9}};
    const std::vector<Side> sides = detail::sorted_sides(triangles);
    REQUIRE(sides.size() == 8);
    CHECK(sides[0].face == 0);
    CHECK(sides[1].face == 2);
    CHECK(sides[0].edge() == sides[1].edge());
    CHECK(sides[0].goes_up != sides[1].goes_up);
    CHECK(detail::sorted_sides({}).empty());
}

TEST_CASE("sides: two on an edge carry a surface on, and of more those that are two of one surface") {
    using Pairs = std::vector<std::pair<std::size_t, std::size_t>>;
    const auto pairs = [](const std::vector<std::uint64_t>& surfaces) {
        Pairs result;
        detail::for_each_pair(
            surfaces.size(), [&](std::size_t i) { return surfaces[i]; },
            [&](std::size_t i, std::size_t j) { result.emplace_back(i, j); });
        return result;
    };
    CHECK(pairs({}).empty());
    CHECK(pairs({4}).empty());
    CHECK(pairs({4, 7}) == Pairs{{0, 1}});
    CHECK(pairs({4, 4, 4}).empty());
    CHECK(pairs({7, 4, 7}) == Pairs{{0, 2}});
    CHECK(pairs({7, 4, 7, 4}) == Pairs{{1, 3}, {0, 2}});
}

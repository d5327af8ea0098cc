#include "faqem/detail/geometry/halfedges.hpp"

#include "support/catch.hpp"
#include "support/meshes.hpp"

using namespace faqem;
using detail::Halfedge;

TEST_CASE("half-edges: those on one edge are contiguous, with their first corner and direction") {
    //  3---2
    //  | / |
    //  0---1
    const std::vector<Triangle> triangles = test::quad().triangles;
    std::vector<std::pair<std::size_t, std::uint64_t>> edges;
    const std::vector<Halfedge> halfedges = detail::sorted_halfedges(triangles);
    REQUIRE(halfedges.size() == 6);
    detail::for_each_edge(halfedges, [&](std::span<const Halfedge> on) {
        edges.emplace_back(on.size(), on[0].edge());
        for (const Halfedge& halfedge : on) {
            const Triangle& t = triangles[halfedge.face];
            const Index from = t[halfedge.corner], to = t[(halfedge.corner + 1) % 3];
            CHECK(from == (halfedge.is_ascending ? halfedge.low : halfedge.high));
            CHECK(to == (halfedge.is_ascending ? halfedge.high : halfedge.low));
        }
    });
    const auto edge = [](std::uint64_t low, std::uint64_t high) { return low << 32 | high; };
    CHECK(edges == std::vector<std::pair<std::size_t, std::uint64_t>>{
                       {1, edge(0, 1)}, {2, edge(0, 2)}, {1, edge(0, 3)}, {1, edge(1, 2)}, {1, edge(2, 3)}});
}

TEST_CASE("half-edges: sorted by face within an edge, without removed triangles and degenerate edges") {
    const std::vector<Triangle> triangles = {{4, 5, 6}, {no_index, no_index, no_index}, {5, 4, 7}, {8, 8, 9}};
    const std::vector<Halfedge> halfedges = detail::sorted_halfedges(triangles);
    REQUIRE(halfedges.size() == 8);
    CHECK(halfedges[0].face == 0);
    CHECK(halfedges[1].face == 2);
    CHECK(halfedges[0].edge() == halfedges[1].edge());
    CHECK(halfedges[0].is_ascending != halfedges[1].is_ascending);
    CHECK(detail::sorted_halfedges({}).empty());
}

TEST_CASE("half-edges: on a manifold edge both are connected, otherwise pairs of the same surface") {
    using Pairs = std::vector<std::pair<std::size_t, std::size_t>>;
    const auto pairs = [](const std::vector<std::uint64_t>& surfaces) {
        Pairs result;
        detail::for_each_connected_pair(
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

#include <cmath>
#include <map>

#include "bake/atlas/triangle_pairs.hpp"
#include "support/catch.hpp"
#include "support/meshes.hpp"

using namespace faqem;
using namespace faqem::detail;

namespace {

using Points = std::vector<std::array<double, 2>>;
using Corners = std::vector<std::array<Index, 3>>;

std::vector<PairTriangle> flat_mesh(const Points& points, const Corners& triangles) {
    std::vector<PairTriangle> result(triangles.size());
    std::map<std::pair<Index, Index>, AdjacentTriangle> half_edges;
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        for (std::uint8_t c = 0; c < 3; ++c) {
            const Index a = triangles[t][(c + 1) % 3], b = triangles[t][(c + 2) % 3];
            result[t].edges[c] = std::hypot(points[a][0] - points[b][0], points[a][1] - points[b][1]);
            half_edges[{a, b}] = {static_cast<Index>(t), c};
        }
    }
    for (const auto& [edge, opposite] : half_edges) {
        const auto other = half_edges.find({edge.second, edge.first});
        if (other != half_edges.end()) result[opposite.triangle].adjacent[opposite.corner] = other->second;
    }
    return result;
}

// n x n squares of side 10, each split by its diagonal.
std::vector<PairTriangle> split_squares(Index n) {
    const TriangleMesh grid = test::grid(n);
    Points points;
    for (const Vec3& p : grid.positions) points.push_back({10 * p[0], 10 * p[1]});
    return flat_mesh(points, grid.triangles);
}

void check_mutual(const std::vector<PairTriangle>& triangles, const std::vector<std::uint8_t>& corner) {
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        if (corner[t] == 3) continue;
        const AdjacentTriangle& other = triangles[t].adjacent[corner[t]];
        REQUIRE(other.triangle < triangles.size());
        REQUIRE(corner[other.triangle] == other.corner);
        REQUIRE(triangles[other.triangle].adjacent[other.corner].triangle == t);
    }
}

}  // namespace

TEST_CASE("the two triangles of every square are paired") {
    const auto triangles = split_squares(6);
    const auto corner = pair_triangles(triangles);
    check_mutual(triangles, corner);
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        CHECK(triangles[t].adjacent[corner[t]].triangle == (t ^ 1));
    }
}

TEST_CASE("slivers are paired only if they fill a rectangle") {
    // Across the long edge the rectangle is 100 by 1. Across the short edge, and in a kite, nearly all of the
    // rectangle is waste.
    const auto side_by_side = flat_mesh({{0, 0}, {100, 0}, {100, 1}, {0, 1}}, {{0, 1, 2}, {0, 2, 3}});
    for (std::uint8_t c : pair_triangles(side_by_side)) CHECK(c < 3);
    const auto end_to_end = flat_mesh({{0, 0}, {100, -1}, {100, 1}, {200, 0}}, {{0, 1, 2}, {1, 3, 2}});
    REQUIRE(end_to_end[0].adjacent[0].triangle == 1);
    for (std::uint8_t c : pair_triangles(end_to_end)) CHECK(c == 3);
    const auto kite = flat_mesh({{0, 0}, {100, -1}, {100, 0}, {100, 1}}, {{0, 1, 2}, {0, 2, 3}});
    for (std::uint8_t c : pair_triangles(kite)) CHECK(c == 3);
}

TEST_CASE("triangles without neighbours or area are not paired") {
    CHECK(pair_triangles({}).empty());
    const std::vector<PairTriangle> lone(3);
    for (std::uint8_t c : pair_triangles(lone)) CHECK(c == 3);
    std::vector<PairTriangle> points = split_squares(1);
    for (PairTriangle& t : points) t.edges = {0, 0, 0};
    for (std::uint8_t c : pair_triangles(points)) CHECK(c == 3);
}

#include "faqem/detail/fitting/edge_flip_search.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "faqem/detail/geometry/edge_flip.hpp"
#include "support/meshes.hpp"

using namespace faqem;
using detail::EdgeFlip;
using engine::Vector3;

namespace {

struct Setting {
    TriangleMesh original, light;
    std::vector<std::uint8_t> fixed;
    std::vector<Index> groups;
};

std::vector<EdgeFlip> find_edge_flips(const Setting& s, std::uint32_t threads = 1) {
    const std::vector<Vector3> from = test::vectors(s.original), at = test::vectors(s.light);
    const detail::MeshRef surface{from, s.original.triangles};
    const detail::ReferenceSurface original(surface);
    std::vector<detail::OrientedPoint> points;
    double area = 0;
    for (const auto& sample : detail::area_uniform_samples(surface, 5000))
        points.push_back({sample.position(from, s.original.triangles), original.normals[sample.face]});
    for (const Triangle& t : s.original.triangles) area += detail::area_vector(from, t).norm() / 2;
    detail::ReferenceToMeshTracker even(points, s.light.triangles),
        corners(detail::oriented_vertices(surface), s.light.triangles);
    even.move_to(at, 1);
    corners.move_to(at, 1);
    std::vector<std::uint8_t> fixed = s.fixed;
    fixed.resize(at.size(), 0);
    return detail::find_edge_flips({at, s.light.triangles, fixed, s.groups}, original, even, corners, area,
                                   threads);
}

// A roof over the square [-1, 1]^2 whose ridge goes from corner 0 to corner 2, and the same square with a
// valley from 1 to 3: the edge is the wrong one.
//
//  3---2        3---2
//  | / |        | \ |
//  0---1        0---1
Setting wrong_diagonal() {
    const std::vector<Vec3> corners = {{-1, -1, 0.3}, {1, -1, 0}, {1, 1, 0.3}, {-1, 1, 0}};
    return {test::make(corners, {{0, 1, 2}, {0, 2, 3}}), test::make(corners, {{0, 1, 3}, {1, 2, 3}}), {}, {}};
}

}  // namespace

TEST_CASE("better edges: a valley where the original has a ridge is flipped") {
    CHECK(find_edge_flips(wrong_diagonal()) == std::vector<EdgeFlip>{{0, 1}});
}

TEST_CASE("better edges: what fits stays") {
    Setting s = wrong_diagonal();
    s.light = s.original;
    CHECK(find_edge_flips(s).empty());
}

TEST_CASE("better edges: fixed edges and those between groups stay") {
    Setting s = wrong_diagonal();
    s.fixed = {0, 1, 0, 1};
    CHECK(find_edge_flips(s).empty());
    s.fixed = {1, 1, 1, 0};
    CHECK(find_edge_flips(s).size() == 1);
    s.groups = {4, 4};
    CHECK(find_edge_flips(s).size() == 1);
    s.groups = {4, 5};
    CHECK(find_edge_flips(s).empty());
}

TEST_CASE("better edges: no edge comes a second time") {
    // The ridge is there already, as the edge of a face that stands on it.
    Setting s = wrong_diagonal();
    s.light.positions.push_back({0, 0, 2});
    s.light.triangles.push_back({0, 2, 4});
    CHECK(find_edge_flips(s).empty());
}

TEST_CASE("better edges: no sliver comes of a flip") {
    // Corner 1 nearly lies between 0 and 2: one of the new faces would have hardly any area.
    Setting s = wrong_diagonal();
    for (TriangleMesh* mesh : {&s.original, &s.light}) mesh->positions[1] = {1e-4, -1e-4, 0};
    CHECK(find_edge_flips(s).empty());
}

TEST_CASE("better edges: flips do not touch each other, and the number of threads does not matter") {
    const Setting s = {
        test::shaken(test::icosphere(5), 0.02, 4), test::shaken(test::icosphere(2), 0.1, 5), {}, {}};
    const std::vector<EdgeFlip> flips = find_edge_flips(s);
    CHECK(flips.size() > 5);
    CHECK(flips == find_edge_flips(s, 3));
    std::vector<int> times(s.light.triangles.size(), 0);
    std::vector<Triangle> triangles = s.light.triangles;
    for (const EdgeFlip& flip : flips) {
        ++times[flip[0]], ++times[flip[1]];
        CHECK(detail::flip_edge(triangles[flip[0]], triangles[flip[1]]));
    }
    CHECK(*std::max_element(times.begin(), times.end()) == 1);
    // Still a closed surface: each half-edge has its opposite, once.
    std::vector<std::pair<Index, Index>> there, back;
    for (const Triangle& t : triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            there.emplace_back(t[k], t[(k + 1) % 3]);
            back.emplace_back(t[(k + 1) % 3], t[k]);
        }
    }
    std::sort(there.begin(), there.end());
    std::sort(back.begin(), back.end());
    CHECK(there == back);
    CHECK(std::adjacent_find(there.begin(), there.end()) == there.end());
}

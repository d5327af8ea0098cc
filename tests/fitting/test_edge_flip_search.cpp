#include "faqem/detail/fitting/edge_flip_search.hpp"

#include <algorithm>

#include "faqem/detail/geometry/edge_flip.hpp"
#include "support/catch.hpp"
#include "support/meshes.hpp"

using namespace faqem;
using detail::EdgeFlip;
using engine::Vector3;

namespace {

struct Setting {
    TriangleMesh original, simplified;
    std::vector<std::uint8_t> fixed;
    std::vector<Index> groups;
};

std::vector<EdgeFlip> find_edge_flips(const Setting& s, std::uint32_t threads = 1) {
    const std::vector<Vector3> from = test::vectors(s.original), at = test::vectors(s.simplified);
    const detail::MeshRef surface{from, s.original.triangles};
    const detail::ReferenceSurface original(surface);
    std::vector<detail::OrientedPoint> points;
    double area = 0;
    for (const auto& sample : detail::area_uniform_samples(surface, 5000))
        points.push_back({sample.position(from, s.original.triangles), original.normals[sample.face]});
    for (const Triangle& t : s.original.triangles) area += detail::area_vector(from, t).norm() / 2;
    detail::ReferenceToMeshTracker even(points, s.simplified.triangles),
        corners(detail::oriented_vertices(surface), s.simplified.triangles);
    even.update(at, 1);
    corners.update(at, 1);
    std::vector<std::uint8_t> fixed = s.fixed;
    fixed.resize(at.size(), 0);
    return detail::find_edge_flips({at, s.simplified.triangles, fixed, s.groups}, original, even, corners,
                                   area, threads);
}

// A surface over the square [-1, 1]^2 with a ridge from corner 0 to corner 2, and a mesh of the same corners
// with the other diagonal, which is a valley.
//
//  3---2        3---2
//  | / |        | \ |
//  0---1        0---1
Setting wrong_diagonal() {
    const std::vector<Vec3> corners = {{-1, -1, 0.3}, {1, -1, 0}, {1, 1, 0.3}, {-1, 1, 0}};
    return {test::make(corners, {{0, 1, 2}, {0, 2, 3}}), test::make(corners, {{0, 1, 3}, {1, 2, 3}}), {}, {}};
}

}  // namespace

TEST_CASE("edge flip search: a valley where the original has a ridge is flipped") {
    CHECK(find_edge_flips(wrong_diagonal()) == std::vector<EdgeFlip>{{0, 1}});
}

TEST_CASE("edge flip search: no flips if the mesh equals the original") {
    Setting s = wrong_diagonal();
    s.simplified = s.original;
    CHECK(find_edge_flips(s).empty());
}

TEST_CASE("edge flip search: fixed edges and group boundaries are not flipped") {
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

TEST_CASE("edge flip search: flips that would duplicate an edge are rejected") {
    // The new edge exists already, as an edge of an upright face.
    Setting s = wrong_diagonal();
    s.simplified.positions.push_back({0, 0, 2});
    s.simplified.triangles.push_back({0, 2, 4});
    CHECK(find_edge_flips(s).empty());
}

TEST_CASE("edge flip search: flips that would create a sliver are rejected") {
    // Corner 1 is almost on the segment from 0 to 2: one of the new faces would have almost no area.
    Setting s = wrong_diagonal();
    for (TriangleMesh* mesh : {&s.original, &s.simplified}) mesh->positions[1] = {1e-4, -1e-4, 0};
    CHECK(find_edge_flips(s).empty());
}

TEST_CASE("edge flip search: flips are independent, and do not depend on the number of threads") {
    const Setting s = {
        test::shaken(test::icosphere(5), 0.02, 4), test::shaken(test::icosphere(2), 0.1, 5), {}, {}};
    const std::vector<EdgeFlip> flips = find_edge_flips(s);
    CHECK(flips.size() > 5);
    CHECK(flips == find_edge_flips(s, 3));
    std::vector<int> times(s.simplified.triangles.size(), 0);
    std::vector<Triangle> triangles = s.simplified.triangles;
    for (const EdgeFlip& flip : flips) {
        ++times[flip[0]], ++times[flip[1]];
        CHECK(detail::flip_edge(triangles[flip[0]], triangles[flip[1]]));
    }
    CHECK(*std::max_element(times.begin(), times.end()) == 1);
    // The surface is still closed: each half-edge has exactly one opposite.
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

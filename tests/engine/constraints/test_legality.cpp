#include "faqem/engine/constraints/legality.hpp"

#include <limits>
#include <set>

#include "support/catch.hpp"
#include "support/meshes.hpp"

using namespace faqem;
using namespace faqem::engine;
using test::hinge;

namespace {

constexpr Rules link_only = {LinkCondition::on, -1, 0};
constexpr Rules flip_only = {LinkCondition::off, 0, 0};

std::optional<Refusal> refusal_of(const TriangleMesh& mesh, Index u, Index v, const Vector3& p,
                                  const Rules& rules) {
    const CollapseMesh collapse_mesh = test::collapse_mesh_of(mesh);
    const PairTable pairs(collapse_mesh, {});
    for (Index pair = 0; pair < pairs.size(); ++pair) {
        if (std::minmax(pairs.first(pair), pairs.second(pair)) == std::minmax(u, v))
            return Legality(collapse_mesh).check(collapse_mesh, pairs, u, v, pair, p, rules);
    }
    throw std::logic_error("no such edge");
}

std::optional<Refusal> link_refusal_of(const TriangleMesh& mesh, Index u, Index v) {
    const Vector3 middle = 0.5 * (to_eigen(mesh.positions[u]) + to_eigen(mesh.positions[v]));
    return refusal_of(mesh, u, v, middle, link_only);
}

TriangleMesh octahedron() {
    return test::make(
        {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
        {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}});
}

using Link = std::pair<std::set<Index>, std::set<std::pair<Index, Index>>>;

// Link of v, with boundaries closed by a vertex at infinity (Dey et al. 1999).
Link link_of(const std::vector<Triangle>& triangles, const test::Edges& edges, Index v) {
    Link link;
    for (const Triangle& t : triangles) {
        for (unsigned c = 0; c < 3; ++c) {
            if (t[c] != v) continue;
            const Index a = t[(c + 1) % 3], b = t[(c + 2) % 3];
            link.first.insert({a, b});
            link.second.insert(std::minmax(a, b));
        }
    }
    for (const auto& [edge, faces] : edges) {
        if (faces != 1 || (edge.first != v && edge.second != v)) continue;
        link.first.insert(no_index);
        link.second.insert({edge.first == v ? edge.second : edge.first, no_index});
    }
    return link;
}

bool locally_manifold(const test::Edges& edges, Index v) {
    int open = 0;
    for (const auto& [edge, faces] : edges) {
        if (edge.first != v && edge.second != v) continue;
        if (faces > 2) return false;
        open += faces == 1;
    }
    return open == 0 || open == 2;
}

// The link condition in its definition as a set equation.
bool keeps_topology(const std::vector<Triangle>& triangles, const test::Edges& edges, Index u, Index v) {
    const Link at_u = link_of(triangles, edges, u), at_v = link_of(triangles, edges, v);
    std::set<Index> opposite;
    for (const Triangle& t : triangles) {
        const std::set<Index> corners(t.begin(), t.end());
        if (!corners.count(u) || !corners.count(v)) continue;
        for (const Index w : t) {
            if (w != u && w != v) opposite.insert(w);
        }
    }
    if (edges.at(std::minmax(u, v)) == 1) opposite.insert(no_index);
    std::set<Index> common;
    for (const Index w : at_u.first) {
        if (at_v.first.count(w)) common.insert(w);
    }
    return common == opposite && std::none_of(at_u.second.begin(), at_u.second.end(),
                                              [&](const auto& edge) { return at_v.second.count(edge) > 0; });
}

// The condition for non-manifold vertices: no new duplicate face, and no merged edge with more faces than
// the larger count of both.
bool keeps_counts(const std::vector<Triangle>& triangles, const test::Edges& edges, Index u, Index v) {
    std::vector<Triangle> after;
    std::set<std::set<Index>> at_u;
    bool doubled = false;
    for (const Triangle& t : triangles) {
        if (std::count(t.begin(), t.end(), u) && !std::count(t.begin(), t.end(), v))
            at_u.insert({t[0], t[1], t[2]});
    }
    for (Triangle t : triangles) {
        const bool has_u = std::count(t.begin(), t.end(), u), has_v = std::count(t.begin(), t.end(), v);
        if (has_u && has_v) continue;
        std::replace(t.begin(), t.end(), v, u);
        doubled = doubled || (has_v && at_u.count({t[0], t[1], t[2]}));
        after.push_back(t);
    }
    const test::Edges merged = test::edges(after);
    return !doubled && std::all_of(edges.begin(), edges.end(), [&](const auto& entry) {
        const auto [a, b] = entry.first;
        if (a != u && b != u) return true;
        const Index n = a == u ? b : a;
        const auto other = edges.find(std::minmax(v, n));
        const auto now = merged.find(std::minmax(u, n));
        return n == v || other == edges.end() || now == merged.end() ||
               now->second <= std::max(entry.second, other->second);
    });
}

// Compares each pair of the mesh with the definitions. Counts the expected results by kind.
bool agrees_everywhere(const TriangleMesh& mesh, int (&count)[2][2]) {
    const CollapseMesh collapse_mesh = test::collapse_mesh_of(mesh);
    const PairTable pairs(collapse_mesh, {});
    const test::Edges edges = test::edges(mesh.triangles);
    Legality legality(collapse_mesh);
    for (Index pair = 0; pair < pairs.size(); ++pair) {
        const Index u = pairs.first(pair), v = pairs.second(pair);
        const bool manifold =
            edges.at(std::minmax(u, v)) <= 2 && locally_manifold(edges, u) && locally_manifold(edges, v);
        const bool expected = manifold ? keeps_topology(mesh.triangles, edges, u, v)
                                       : keeps_counts(mesh.triangles, edges, u, v);
        const Vector3 p = 0.4 * collapse_mesh.position(u) + 0.6 * collapse_mesh.position(v);
        ++count[manifold][expected];
        const auto refusal = legality.check(collapse_mesh, pairs, u, v, pair, p, link_only);
        if (refusal == Refusal::degenerate) continue;
        if ((refusal == Refusal::link) == expected) return false;
    }
    return true;
}

}  // namespace

TEST_CASE("legality: a face must not flip") {
    CHECK_FALSE(refusal_of(hinge(), 2, 3, {2, 1, 0}, flip_only));
    CHECK(refusal_of(hinge(), 2, 3, {2, -1, 0}, flip_only) == Refusal::flip);
    CHECK(refusal_of(hinge(), 3, 2, {2, -1, 0}, flip_only) == Refusal::flip);
    CHECK_FALSE(refusal_of(hinge(), 2, 3, {2, -1, 0}, {LinkCondition::off, -1, 0}));
}

TEST_CASE("legality: the limit of the normal deviation is a cosine and is inclusive") {
    const auto turned = [](double degrees) {
        return Vector3(1, std::cos(degrees * test::pi / 180), std::sin(degrees * test::pi / 180));
    };
    for (const double limit : {0.5, 0.0, -0.5}) {
        const double angle = std::acos(limit) * 180 / test::pi;
        const Rules rules = {LinkCondition::off, limit, 0};
        CHECK_FALSE(refusal_of(hinge(), 2, 3, turned(angle - 0.01), rules));
        CHECK(refusal_of(hinge(), 2, 3, turned(angle + 0.01), rules) == Refusal::flip);
    }
    // Exactly 90 degrees: the dot product is not < 0.
    CHECK_FALSE(refusal_of(hinge(), 2, 3, {1, 0, 1}, flip_only));
}

TEST_CASE("legality: a face must not lose its area, even if flips are allowed") {
    for (const double limit : {0.0, -0.5, -1.0}) {
        CHECK(refusal_of(hinge(), 2, 3, {2.5, 0, 0}, {LinkCondition::off, limit, 0}) == Refusal::degenerate);
        CHECK(refusal_of(hinge(), 2, 3, {2.5, 1e-12, 0}, {LinkCondition::off, limit, 0}) ==
              Refusal::degenerate);
        CHECK_FALSE(refusal_of(hinge(), 2, 3, {2.5, 1e-6, 0}, {LinkCondition::off, limit, 0}));
    }
}

TEST_CASE("legality: a face of zero area may flip and stay degenerate") {
    TriangleMesh mesh = hinge();
    mesh.positions[2] = {1, 0, 0};
    CHECK_FALSE(refusal_of(mesh, 2, 3, {1, 0, 0}, flip_only));
    CHECK_FALSE(refusal_of(mesh, 2, 3, {1, -1, 0}, flip_only));
    CHECK_FALSE(refusal_of(mesh, 2, 3, {1, 1, 0}, flip_only));
}

TEST_CASE("legality: a NaN position is refused") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK(refusal_of(hinge(), 2, 3, {nan, 0, 0}, flip_only) == Refusal::flip);
    CHECK(refusal_of(hinge(), 2, 3, {nan, 0, 0}, {LinkCondition::off, -1, 0}) == Refusal::degenerate);
}

TEST_CASE("legality: the link condition keeps closed surfaces closed") {
    for (Index u = 0; u < 4; ++u) {
        for (Index v = u + 1; v < 4; ++v) CHECK(link_refusal_of(test::tetrahedron(), u, v) == Refusal::link);
    }
    CHECK_FALSE(link_refusal_of(octahedron(), 0, 2));
    // Two pyramids at the triangle 0 1 2, which is not a face. An apex of valence three can be collapsed.
    const TriangleMesh bipyramid =
        test::make({{1, 0, 0}, {0, 1, 0}, {-1, -1, 0}, {0, 0, 1}, {0, 0, -1}},
                   {{0, 1, 3}, {1, 2, 3}, {2, 0, 3}, {1, 0, 4}, {2, 1, 4}, {0, 2, 4}});
    CHECK(link_refusal_of(bipyramid, 0, 1) == Refusal::link);
    CHECK_FALSE(link_refusal_of(bipyramid, 3, 0));
    CHECK_FALSE(link_refusal_of(bipyramid, 1, 4));
}

TEST_CASE("legality: a vertex of valence three inside a disc can be collapsed") {
    CHECK_FALSE(link_refusal_of(test::fan(3), 0, 1));
}

TEST_CASE("legality: the last triangle is not collapsed") {
    const TriangleMesh triangle = test::make({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
    CHECK(link_refusal_of(triangle, 0, 1) == Refusal::link);
    CHECK(link_refusal_of(triangle, 1, 2) == Refusal::link);
}

TEST_CASE("legality: a triangular hole is not closed") {
    TriangleMesh open = octahedron();
    open.triangles.erase(open.triangles.begin());
    CHECK(link_refusal_of(open, 0, 2) == Refusal::link);
    CHECK(link_refusal_of(open, 2, 4) == Refusal::link);
    CHECK_FALSE(link_refusal_of(open, 1, 2));
}

TEST_CASE("legality: an annulus is not pinched and its boundaries keep at least three edges") {
    const TriangleMesh six = test::cylinder(6, 1, 1), three = test::cylinder(3, 1, 1);
    CHECK(link_refusal_of(six, 0, 6) == Refusal::link);  // an inner edge between the boundaries
    CHECK(link_refusal_of(six, 0, 7) == Refusal::link);
    CHECK_FALSE(link_refusal_of(six, 0, 1));
    CHECK(link_refusal_of(three, 0, 1) == Refusal::link);
    CHECK(link_refusal_of(test::quad(), 0, 2) == Refusal::link);
    CHECK_FALSE(link_refusal_of(test::quad(), 0, 1));
}

TEST_CASE("legality: an inner vertex can be collapsed with a boundary vertex") {
    CHECK_FALSE(link_refusal_of(test::grid(2), 4, 5));
    CHECK_FALSE(link_refusal_of(test::grid(2), 4, 8));
}

TEST_CASE("legality: at non-manifold edges no edge gains faces and no face is duplicated") {
    // Each face of the book can be collapsed along the edge (0, 1) or its other edges ...
    CHECK_FALSE(link_refusal_of(test::book(), 0, 1));
    CHECK_FALSE(link_refusal_of(test::book(), 0, 2));
    // ... but two faces must not become coincident. An additional face connects the vertices 2 and 3 of two
    // of them.
    TriangleMesh book = test::book();
    book.triangles.push_back({1, 2, 3});
    CHECK(link_refusal_of(book, 2, 3) == Refusal::link);
}

TEST_CASE("legality: without the link condition the topology may change") {
    CHECK_FALSE(refusal_of(test::quad(), 0, 2, {0.5, 0.5, 0}, flip_only));
    CHECK_FALSE(refusal_of(test::tetrahedron(), 0, 1, {0.5, 0, 0}, {LinkCondition::off, -1, 0}));
}

TEST_CASE("legality: the link condition agrees with its definition on random meshes") {
    int count[2][2] = {};
    for (std::uint32_t seed = 0; seed < 40; ++seed) {
        INFO("seed " << seed);
        CHECK(agrees_everywhere(test::soup(seed, 6 + seed % 7, 3 + seed), count));
        // Spheres, a torus and a tube with faces missing: various holes and pinched vertices.
        for (TriangleMesh mesh :
             {test::icosphere(0), test::torus(4, 3), test::cylinder(3, 2, 1), octahedron()}) {
            test::Random random(seed);
            mesh = test::shaken(mesh, 0.05, seed);
            for (std::uint32_t holes = seed % 8; holes > 0; --holes)
                mesh.triangles.erase(mesh.triangles.begin() + random.below(mesh.triangles.size()));
            CHECK(agrees_everywhere(mesh, count));
        }
    }
    for (const auto& kind : count) CHECK((kind[0] > 100 && kind[1] > 100));
}

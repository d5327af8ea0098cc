#include "faqem/detail/mapping/successive_projection.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "support/catch.hpp"
#include "support/hand_history.hpp"
#include "support/mapped_points.hpp"

using namespace faqem;
using namespace faqem::test;

namespace {

double twice_area(const Vec3& a, const Vec3& b, const Vec3& c) {
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

// A flat grid whose inner vertices were collapsed into neighbours, in a random order that inverts no face.
CollapseHistory collapsed_grid(Index n) {
    std::vector<Vec3> positions = grid(n).positions;  // of versions
    const std::vector<Triangle> faces = grid(n).triangles;
    HandHistory hand(positions, faces);
    const auto inner = [&](Index v) {
        return positions[v][0] > 0 && positions[v][0] < n && positions[v][1] > 0 && positions[v][1] < n;
    };
    const auto inverts_no_face = [&](Index from, Index to) {
        for (Index f = 0; f < faces.size(); ++f) {
            Triangle t = hand.corners(f);
            std::replace(t.begin(), t.end(), from, to);
            if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;
            if (!(twice_area(positions[t[0]], positions[t[1]], positions[t[2]]) > 0)) return false;
        }
        return true;
    };
    std::uint32_t random = 1;
    for (int tries = 0; tries < 4000; ++tries) {
        random = random * 1664525u + 1013904223u;
        const Triangle t = hand.corners((random >> 8) % faces.size());
        const Index from = t[(random >> 4) % 3], to = t[((random >> 4) + 1) % 3];
        if (from == to || !inner(from) || !inverts_no_face(from, to)) continue;
        const Vec3 position = positions[to];
        hand.collapse(from, to, position);
        positions.push_back(position);
    }
    return hand.finish();
}

}  // namespace

TEST_CASE("successive projection: points are mapped to their material group") {
    std::vector<Vec3> positions;
    for (int j = 0; j < 4; ++j) {
        for (int i = 0; i < 4; ++i) positions.push_back({double(i), double(j), 0});
    }
    const auto faces = grid(3).triangles;
    std::vector<Index> groups;
    for (Index f = 0; f < faces.size(); ++f) groups.push_back(f % 6 < 2 ? 7 : no_index);  // left column
    HandHistory hand(positions, faces, groups);
    hand.collapse(5, 6, {1.9, 1, 0});  // moves the group boundary into the other group
    const CollapseHistory history = hand.finish();
    const SurfaceMap map(history);
    for (Index f = 0; f < history.remaining_faces.size(); ++f) {
        for (const Vec3& w : spread(4)) {
            CHECK(history.face_groups[map.map(f, w).face] == history.face_groups[history.remaining_faces[f]]);
        }
    }
}

// Seen from above. The face h = (P, B, Q) is folded over f, so that it is the only one with an upward normal.
//
//        E         The normals of g = (E, B, A) and f = (A, B, P) are downward. (P, Q) is collapsed into D,
//        then
//       / \        (D, E) into C at the position of E, so that the normal of f = (A, B, C) is upward.
//      / g \       Its points lie in g, whose normal is downward and which no earlier collapse has changed:
//     A-----B      the walk ends there, on a face of opposite orientation.
//      \ f / \.
//       \ /  Q     The result must be h.
//        P
TEST_CASE("successive projection: if the walk ends on an opposite face, the closest accepted face is used") {
    const Index a = 0, b = 1, p = 2, q = 3, e = 4;
    HandHistory hand({{0, 0, 0}, {1, 0, 0}, {0.5, -1, 0}, {0.4, -0.2, 0}, {0.5, 1, 0}},
                     {{a, b, p}, {e, b, a}, {p, b, q}});
    const Index d = hand.collapse(p, q, {0.5, -0.6, 0});
    hand.collapse(d, e, {0.5, 1, 0});
    const CollapseHistory history = hand.finish();
    REQUIRE(history.remaining_faces == std::vector<Index>{0, 1});
    const SurfaceMap map(history);
    const SurfacePoint hit = map.map(0, {0.4, 0.3, 0.3});
    CHECK(hit.face == 2);
    CHECK(hit.step == MapStep::closest);
    CHECK(map.map(1, {0.4, 0.3, 0.3}).face == 1);
}

TEST_CASE("successive projection: points of an inverted face are marked as inexact") {
    HandHistory hand({{0, 0, 0}, {1, 0, 0}, {0.5, 1, 0}, {0.5, -1, 0}}, {{0, 1, 2}, {0, 3, 1}});
    hand.collapse(2, 3, {0.5, -1, 0});
    const CollapseHistory history = hand.finish();
    const SurfacePoint hit = SurfaceMap(history).map(0, {0.4, 0.3, 0.3});
    CHECK(hit.step != MapStep::history);
    CHECK(hit.face < 2);
}

// Two coincident plates of the same orientation that share their vertices after welding.
TEST_CASE("successive projection: points are mapped to their plate if two plates share all vertices") {
    constexpr Index n = 4, layer = (n + 1) * (n + 1);
    const std::vector<Triangle> plate = grid(n).triangles;
    const Index count = static_cast<Index>(plate.size());
    std::vector<Triangle> welded = plate, unwelded = plate;
    welded.insert(welded.end(), plate.begin(), plate.end());
    for (const Triangle& t : plate) unwelded.push_back({t[0] + layer, t[1] + layer, t[2] + layer});
    HandHistory hand(grid(n).positions, welded);
    Index last = 6;
    for (const Index v : {7u, 8u, 13u, 12u, 11u, 16u, 17u, 18u}) last = hand.collapse(last, v, {2, 2, 0});
    const CollapseHistory history = hand.finish();
    const TriangleMesh small = small_mesh(history);
    REQUIRE(small.triangles.size() < welded.size());
    const SurfaceMap map(history, unwelded);
    for (Index f = 0; f < small.triangles.size(); ++f) {
        const bool first = history.remaining_faces[f] < count;
        for (const Vec3& w : spread(6)) {
            const SurfacePoint q = map.map(f, w);
            CHECK((q.face < count) == first);
            CHECK(q.step == MapStep::history);
            CHECK(distance(original_point(history, q), small_point(small, f, w)) < 1e-12);
        }
    }
}

// A row of vertices is collapsed into the first one. The two remaining faces are in the patches of all these
// collapses, which are more than a walk may visit.
TEST_CASE("successive projection: walks that are too long fall back to the surface patch's closest point") {
    constexpr Index n = 1500;
    std::vector<Vec3> positions = {{0, 1, 0}, {0, -1, 0}};
    for (Index i = 0; i <= n; ++i) positions.push_back({double(i) / n, 0, 0});
    std::vector<Triangle> faces;
    for (Index i = 2; i < n + 2; ++i) {
        faces.push_back({i, i + 1, 0});
        faces.push_back({i + 1, i, 1});
    }
    double bump = 0, waves = 20;
    SECTION("plane") {}
    SECTION("slightly curved surface") { bump = 0.01; }
    SECTION("strongly curved surface") { bump = 2, waves = 3; }
    for (Vec3& p : positions) p[2] = bump * std::sin(waves * p[0]);
    HandHistory hand(positions, faces);
    Index last = 2;
    for (Index i = 3; i < n + 2; ++i) last = hand.collapse(last, i, positions[2]);
    const CollapseHistory history = hand.finish();
    const TriangleMesh small = small_mesh(history);
    REQUIRE(small.triangles.size() == 2);
    const SurfaceMap map(history);
    std::size_t aborted = 0;
    for (Index f = 0; f < small.triangles.size(); ++f) {
        for (const Vec3& w : spread(12)) {
            const SurfacePoint q = map.map(f, w);
            aborted += q.step == MapStep::closest;
            const Vec3 p = small_point(small, f, w);
            if (p[1] != 0) CHECK(q.face % 2 == history.remaining_faces[f] % 2);
            CHECK(distance(original_point(history, q), p) <= 2 * bump + 1e-12);
        }
    }
    CHECK((aborted > 0) == (bump > 0.1));  // no walk is needed near the original
}

// Three faces on each edge, also before welding; those of the plane continue each other.
TEST_CASE("successive projection: points stay on a plane with a fin on every edge, and on their fin") {
    constexpr Index n = 6;
    std::vector<Vec3> positions = grid(n).positions;
    std::vector<Triangle> faces = grid(n).triangles;
    const Index plane_faces = static_cast<Index>(faces.size());
    for (Index f = 0; f < plane_faces; f += 2) {  // each inner edge belongs to exactly one of these faces
        for (std::size_t c = 0; c < 3; ++c) {
            const Index a = faces[f][c], b = faces[f][(c + 1) % 3];
            const Vec3 &p = positions[a], &q = positions[b];
            faces.push_back({a, b, static_cast<Index>(positions.size())});
            positions.push_back({(p[0] + q[0]) / 2, (p[1] + q[1]) / 2, 0.2});
        }
    }
    HandHistory hand(positions, faces);
    Index last = 8;
    for (const Index v : {9u, 10u, 17u, 16u, 15u, 22u, 23u, 24u}) last = hand.collapse(last, v, {2, 2, 0});
    const CollapseHistory history = hand.finish();
    const TriangleMesh small = small_mesh(history);
    REQUIRE(small.triangles.size() < faces.size());
    const SurfaceMap map(history);
    for (Index f = 0; f < small.triangles.size(); ++f) {
        const Index original = history.remaining_faces[f];
        SurfacePoint before = map.map(f, {0.98, 0.01, 0.01});
        for (int i = 0; i < 50; ++i) {
            const Vec3 w{0.98 - 0.0192 * i, 0.01, 0.01 + 0.0192 * i};
            before = map.map_near(f, w, before);
            for (const SurfacePoint& q : {before, map.map(f, w)}) {
                if (original >= plane_faces) {
                    CHECK(q.face == original);
                } else {
                    CHECK(q.face < plane_faces);
                    CHECK(q.step == MapStep::history);
                    CHECK(distance(original_point(history, q), small_point(small, f, w)) < 1e-12);
                }
            }
        }
    }
}

// In flat regions, most original faces within a simplified face are no preimage faces.
TEST_CASE("successive projection: map_near() is exact in flat regions") {
    const CollapseHistory history = collapsed_grid(12);
    const TriangleMesh small = small_mesh(history);
    REQUIRE(small.triangles.size() < 60);
    const SurfaceMap map(history);
    for (Index f = 0; f < small.triangles.size(); ++f) {
        SurfacePoint last = map.map(f, {0.98, 0.01, 0.01});
        for (int i = 1; i < 50; ++i) {
            const Vec3 w{0.98 - 0.0192 * i, 0.01, 0.01 + 0.0192 * i};
            last = map.map_near(f, w, last);
            CHECK(distance(original_point(history, last), small_point(small, f, w)) < 1e-12);
        }
    }
}

TEST_CASE("successive projection: the map does not depend on the number of threads that make it") {
    const CollapseHistory history = collapsed_grid(12);
    const detail::SuccessiveProjection one(history, {}, 1), several(history, {}, 3);
    for (Index f = 0; f < history.remaining_faces.size(); ++f) {
        for (const Vec3& w : {Vec3{1, 0, 0}, Vec3{0.2, 0.5, 0.3}, Vec3{0, 0.5, 0.5}}) {
            const SurfacePoint a = one.map(f, w), b = several.map(f, w);
            CHECK(a.face == b.face);
            CHECK(a.barycentric == b.barycentric);
            CHECK(a.step == b.step);
        }
    }
}

TEST_CASE("successive projection: making the map can be cancelled with any number of threads") {
    const CollapseHistory history = collapsed_grid(12);
    for (const std::uint32_t threads : {1u, 3u}) {
        const engine::RunContext context(threads, [](Phase, double) { return Continue::cancel; });
        CHECK_THROWS_AS(detail::SuccessiveProjection(history, {}, context), engine::Cancelled);
    }
}

#include "faqem/engine/mesh/collapse_mesh.hpp"

#include <set>

#include "support/catch.hpp"
#include "support/meshes.hpp"

using namespace faqem;
using namespace faqem::engine;
using test::removed_face;

namespace {

// Compares all queries of the mesh with a plain list of triangles.
bool agrees(const CollapseMesh& collapse_mesh, const std::vector<Triangle>& expected) {
    std::size_t living = 0;
    std::vector<std::set<std::pair<Index, unsigned>>> corners(collapse_mesh.vertex_slots());
    for (Index f = 0; f < expected.size(); ++f) {
        if (collapse_mesh.is_alive(f) != (expected[f] != removed_face)) return false;
        if (expected[f] == removed_face) continue;
        if (collapse_mesh.triangle(f) != expected[f]) return false;
        ++living;
        for (unsigned c = 0; c < 3; ++c) corners[expected[f][c]].insert({f, c});
    }
    if (collapse_mesh.face_count() != living || collapse_mesh.face_slots() != expected.size()) return false;
    for (Index v = 0; v < collapse_mesh.vertex_slots(); ++v) {
        std::set<std::pair<Index, unsigned>> seen;
        std::size_t visits = 0;
        collapse_mesh.for_each_face(v, [&](Index f, unsigned c) { seen.insert({f, c}), ++visits; });
        if (seen != corners[v] || visits != seen.size() || collapse_mesh.degree(v) != visits) return false;
    }
    return true;
}

void naive_collapse(std::vector<Triangle>& triangles, Index survivor, Index removed) {
    for (Triangle& t : triangles) {
        std::replace(t.begin(), t.end(), removed, survivor);
        if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) t = removed_face;
    }
}

}  // namespace

TEST_CASE("a collapse mesh lists the corners of each vertex without removed faces") {
    TriangleMesh mesh = test::tetrahedron();
    mesh.triangles.push_back(removed_face);
    const CollapseMesh collapse_mesh = test::collapse_mesh_of(mesh);
    CHECK(agrees(collapse_mesh, mesh.triangles));
    CHECK(collapse_mesh.face_count() == 4);
    CHECK(collapse_mesh.face_slots() == 5);
    CHECK_FALSE(collapse_mesh.is_alive(4));
    CHECK(collapse_mesh.degree(0) == 3);
    CHECK(collapse_mesh.position(3) == Vector3(0, 0, 1));
    CHECK(collapse_mesh.has_corner(3, 1));
    CHECK_FALSE(collapse_mesh.has_corner(3, 0));
    CHECK(collapse_mesh.area_vector(3) == Vector3(1, 1, 1));
}

TEST_CASE("all_of_faces stops when the visitor returns false") {
    const CollapseMesh collapse_mesh = test::collapse_mesh_of(test::fan(6));
    int visits = 0;
    CHECK_FALSE(collapse_mesh.all_of_faces(0, [&](Index, unsigned) { return ++visits < 3; }));
    CHECK(visits == 3);
    CHECK(collapse_mesh.all_of_faces(0, [](Index, unsigned) { return true; }));
}

TEST_CASE("the faces around a pair are visited once each, with the corner that is a vertex of the pair") {
    const CollapseMesh collapse_mesh = test::collapse_mesh_of(test::quad());
    using Visit = std::pair<Index, Index>;
    const auto around = [&](Index u, Index v) {
        std::set<Visit> seen;
        std::size_t visits = 0;
        collapse_mesh.for_each_face_around(u, v, [&](Index f, unsigned corner) {
            ++visits;
            seen.emplace(f, collapse_mesh.triangle(f)[corner]);
        });
        CHECK(visits == seen.size());
        return seen;
    };
    for (const Index u : {0u, 1u, 2u, 3u}) {
        for (const Index v : {0u, 1u, 2u, 3u}) {
            if (u == v) continue;
            std::set<Visit> expected;
            for (Index f = 0; f < collapse_mesh.face_slots(); ++f) {
                const bool at_u = collapse_mesh.has_corner(f, u);
                if (at_u || collapse_mesh.has_corner(f, v)) expected.emplace(f, at_u ? u : v);
            }
            CHECK(around(u, v) == expected);
        }
    }
}

TEST_CASE("a collapse moves the survivor, reattaches faces and removes the shared ones") {
    TriangleMesh mesh = test::quad();
    CollapseMesh collapse_mesh = test::collapse_mesh_of(mesh);
    CHECK(collapse_mesh.collapse(2, 1, {5, 6, 7}) == 1);
    CHECK(collapse_mesh.position(2) == Vector3(5, 6, 7));
    CHECK(collapse_mesh.degree(1) == 0);
    CHECK(agrees(collapse_mesh, {removed_face, {0, 2, 3}}));
}

TEST_CASE("after collapses and removals the mesh agrees with a plain list of triangles") {
    for (std::uint32_t seed = 0; seed < 30; ++seed) {
        const std::size_t vertices = 6 + seed;
        TriangleMesh mesh = test::soup(seed, vertices, 3 * vertices);
        CollapseMesh collapse_mesh = test::collapse_mesh_of(mesh);
        test::Random random(seed);
        std::set<Index> removed;
        bool good = agrees(collapse_mesh, mesh.triangles);
        while (removed.size() + 2 < vertices && good) {
            const Index u = random.below(vertices), v = random.below(vertices);
            if (random.unit() < 0.1) {
                const Index f = random.below(mesh.triangles.size());
                if (collapse_mesh.is_alive(f)) collapse_mesh.remove_face(f);
                mesh.triangles[f] = removed_face;
            } else if (u != v && !removed.count(u) && !removed.count(v)) {
                const std::size_t before = collapse_mesh.face_count();
                naive_collapse(mesh.triangles, u, v);
                const std::size_t vanished = collapse_mesh.collapse(u, v, Vector3::Zero());
                removed.insert(v);
                good = vanished == before - collapse_mesh.face_count();
            }
            good = good && agrees(collapse_mesh, mesh.triangles);
        }
        INFO("seed " << seed);
        CHECK(good);
    }
}

TEST_CASE("faces with three given vertices are counted regardless of their winding") {
    const CollapseMesh collapse_mesh = test::collapse_mesh_of(
        test::make({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {{0, 1, 2}, {2, 1, 0}, {1, 3, 2}}));
    CHECK(collapse_mesh.count_faces_with(0, 1, 2) == 2);
    CHECK(collapse_mesh.count_faces_with(2, 3, 1) == 1);
    CHECK(collapse_mesh.count_faces_with(0, 1, 3) == 0);
}

TEST_CASE("face normals and areas are correct after collapses and removals") {
    TriangleMesh mesh = test::shaken(test::torus(9, 7), 0.2, 3);
    CollapseMesh collapse_mesh = test::collapse_mesh_of(mesh);
    test::Random random(5);
    std::set<Index> removed;
    for (int step = 0; step < 40; ++step) {
        const Index u = random.below(63), v = random.below(63), f = random.below(126);
        if (step % 4 == 0 && collapse_mesh.is_alive(f)) collapse_mesh.remove_face(f);
        if (u == v || removed.count(u) || removed.count(v)) continue;
        collapse_mesh.collapse(u, v, 0.5 * (collapse_mesh.position(u) + collapse_mesh.position(v)));
        removed.insert(v);
    }
    for (Index face = 0; face < collapse_mesh.face_slots(); ++face) {
        if (!collapse_mesh.is_alive(face)) continue;
        const Vector3 area_vector = collapse_mesh.area_vector(face);
        CHECK(collapse_mesh.area(face) == Approx(0.5 * area_vector.norm()).margin(1e-15));
        CHECK((collapse_mesh.normal(face) * area_vector.norm() - area_vector).norm() < 1e-12);
    }
}

#include "faqem/engine/tracking/vertex_bindings.hpp"

#include <catch2/catch.hpp>

#include "support/original.hpp"

using namespace faqem;
using namespace faqem::engine;

namespace {

std::vector<Index> bound_to(const Bindings& bindings, Index f) {
    std::vector<Index> found;
    bindings.for_each_bound(f, [&](Index v) { found.push_back(v); });
    std::sort(found.begin(), found.end());
    return found;
}

}  // namespace

TEST_CASE("bindings: at first every vertex is bound to exactly one of its faces") {
    const test::OriginalOf original(test::icosphere(1));
    const Complex complex(original.positions, original.triangles);
    Bindings bindings(original.surface, original.lineage, complex);
    bindings.begin(complex);
    std::vector<int> times(complex.vertex_slots(), 0);
    for (Index f = 0; f < complex.face_slots(); ++f) {
        for (const Index v : bound_to(bindings, f)) {
            CHECK(complex.has_corner(f, v));
            CHECK(bindings.position(v) == complex.position(v));
            ++times[v];
        }
    }
    CHECK(times == std::vector<int>(times.size(), 1));
}

TEST_CASE("bindings: what is released is bound to nothing until it is bound anew") {
    const test::OriginalOf original(test::quad());
    const Complex complex(original.positions, original.triangles);
    Bindings bindings(original.surface, original.lineage, complex);
    bindings.begin(complex);
    std::vector<Index> all = bound_to(bindings, 0);
    for (const Index v : bound_to(bindings, 1)) all.push_back(v);
    CHECK(all.size() == 4);
    for (const Index f : {0u, 1u}) bindings.release(f);
    CHECK(bound_to(bindings, 0).empty());
    bindings.bind(2, 1);
    bindings.bind(0, 1);
    CHECK(bound_to(bindings, 1) == std::vector<Index>{0, 2});
}

TEST_CASE("bindings: a vertex without faces is bound to nothing") {
    const test::OriginalOf original(test::make({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {9, 9, 9}}, {{0, 1, 2}}));
    const Complex complex(original.positions, original.triangles);
    Bindings bindings(original.surface, original.lineage, complex);
    bindings.begin(complex);
    CHECK(bound_to(bindings, 0) == std::vector<Index>{0, 1, 2});
}

TEST_CASE("bindings: what went into another vertex is bound to the face nearest to where it was") {
    // Every second column of a grid goes into its left neighbour, which stays in place.
    const TriangleMesh mesh = test::grid(6);
    const test::OriginalOf original(mesh);
    Complex complex = test::complex_of(mesh);
    Bindings bindings(original.surface, original.lineage, complex);
    for (Index y = 0; y <= 6; ++y) {
        for (const Index x : {1u, 3u, 5u}) {
            const Index v = x + 7 * y;
            bindings.merge(v - 1, v);
            complex.collapse(v - 1, v, complex.position(v - 1));
        }
    }
    bindings.begin(complex);
    const auto distance = [&](Index f, const Vector3& p) {
        const Triangle& t = complex.triangle(f);
        return TriangleDistance(complex.position(t[0]), complex.position(t[1]), complex.position(t[2]))(p);
    };
    std::size_t found = 0;
    for (Index f = 0; f < complex.face_slots(); ++f) {
        if (!complex.alive(f)) {
            CHECK(bound_to(bindings, f).empty());
            continue;
        }
        for (const Index v : bound_to(bindings, f)) {
            ++found;
            for (Index other = 0; other < complex.face_slots(); ++other) {
                if (complex.alive(other))
                    CHECK(distance(f, bindings.position(v)) <= distance(other, bindings.position(v)));
            }
        }
    }
    CHECK(found == mesh.positions.size());
}

TEST_CASE("bindings: the lineage is followed over many steps") {
    const TriangleMesh mesh = test::fan(8);
    const test::OriginalOf original(mesh);
    Complex complex = test::complex_of(mesh);
    Bindings bindings(original.surface, original.lineage, complex);
    for (Index v = 2; v < 7; ++v) {
        bindings.merge(v, v - 1);
        complex.collapse(v, v - 1, complex.position(v));
    }
    bindings.begin(complex);
    std::size_t found = 0;
    for (Index f = 0; f < complex.face_slots(); ++f) {
        if (complex.alive(f)) found += bound_to(bindings, f).size();
    }
    CHECK(found == 9);
}

TEST_CASE("bindings: distances to the original stay those to the original") {
    const TriangleMesh mesh = test::fan(6);
    const test::OriginalOf original(mesh);
    Complex complex = test::complex_of(mesh);
    const Bindings bindings(original.surface, original.lineage, complex);
    complex.collapse(0, 1, {0, 0, 5});
    CHECK(bindings.squared_distance_around(0, {0.1, 0.1, 2}, 100) == Approx(4));
    CHECK(bindings.squared_distance_around(0, {0.1, 0.1, 2}, 1) == 1);
    CHECK(bindings.squared_distance_around(1, {2, 0, 0}, 100) == Approx(1));
}

TEST_CASE("bindings: of a complex that is what the original has become, and for some vertices only") {
    // A square of two triangles over what was a square of a hundred and twenty-eight.
    const test::OriginalOf original(test::grid(8));
    const Complex complex({{0, 0, 0}, {8, 0, 0}, {8, 8, 0}, {0, 8, 0}}, {{0, 1, 2}, {0, 2, 3}});
    Lineage lineage;
    lineage.add(3, 1);   // at (3, 0), below the diagonal
    lineage.add(30, 0);  // at (3, 3), on it
    lineage.add(66, 0);  // at (3, 7), above
    Bindings bindings(original.surface, lineage, complex);
    bindings.begin(complex);
    CHECK(bound_to(bindings, 0) == std::vector<Index>{0, 1});
    CHECK(bound_to(bindings, 1) == std::vector<Index>{2});
    CHECK(bindings.position(2) == Vector3(3, 7, 0));
    CHECK(bindings.squared_distance_around(2, {3, 7, 2}, 100) == Approx(4));
}

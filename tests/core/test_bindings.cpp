#include "faqem/engine/bindings.hpp"

#include <catch2/catch.hpp>

#include "core/meshes.hpp"

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
    const Complex complex = test::complex_of(test::icosphere(1));
    Bindings bindings;
    bindings.initialise(complex);
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
    const Complex complex = test::complex_of(test::quad());
    Bindings bindings;
    bindings.initialise(complex);
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
    const Complex complex({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {9, 9, 9}}, {{0, 1, 2}});
    Bindings bindings;
    bindings.initialise(complex);
    CHECK(bound_to(bindings, 0) == std::vector<Index>{0, 1, 2});
}

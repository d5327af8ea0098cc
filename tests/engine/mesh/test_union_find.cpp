#include "faqem/engine/mesh/union_find.hpp"

#include <catch2/catch.hpp>

using faqem::Index;
using faqem::engine::DisjointSets;

TEST_CASE("disjoint sets: each starts alone and is known by its smallest member") {
    DisjointSets sets(5);
    for (Index v = 0; v < 5; ++v) CHECK(sets.root(v) == v);
    sets.join(4, 2);
    CHECK(sets.root(4) == 2);
    sets.join(3, 4);
    CHECK(sets.root(3) == 2);
    sets.join(1, 3);
    CHECK(sets.root(4) == 1);
    CHECK(sets.root(0) == 0);
    sets.join(4, 4);
    CHECK(sets.root(4) == 1);
}

TEST_CASE("disjoint sets: the order of joining does not matter") {
    // Joining v with v + 3 leaves the remainders by 3.
    DisjointSets upwards(100), downwards(100);
    for (Index v = 0; v + 3 < 100; ++v) upwards.join(v, v + 3);
    for (Index v = 97; v-- > 0;) downwards.join(v + 3, v);
    for (Index v = 0; v < 100; ++v) {
        CHECK(upwards.root(v) == v % 3);
        CHECK(downwards.root(v) == v % 3);
    }
}

#include "faqem/engine/mesh/union_find.hpp"

#include "support/catch.hpp"

using faqem::Index;
using faqem::engine::UnionFind;

TEST_CASE("union-find: each set is represented by its smallest member") {
    UnionFind sets(5);
    for (Index v = 0; v < 5; ++v) CHECK(sets.find(v) == v);
    sets.unite(4, 2);
    CHECK(sets.find(4) == 2);
    sets.unite(3, 4);
    CHECK(sets.find(3) == 2);
    sets.unite(1, 3);
    CHECK(sets.find(4) == 1);
    CHECK(sets.find(0) == 0);
    sets.unite(4, 4);
    CHECK(sets.find(4) == 1);
}

TEST_CASE("union-find: the order of unions does not matter") {
    // Uniting v with v + 3 yields the residue classes modulo 3.
    UnionFind upwards(100), downwards(100);
    for (Index v = 0; v + 3 < 100; ++v) upwards.unite(v, v + 3);
    for (Index v = 97; v-- > 0;) downwards.unite(v + 3, v);
    for (Index v = 0; v < 100; ++v) {
        CHECK(upwards.find(v) == v % 3);
        CHECK(downwards.find(v) == v % 3);
    }
}

#include "faqem/detail/geometry/edge_flip.hpp"

#include <algorithm>

#include "support/catch.hpp"

using namespace faqem;
using detail::flip_edge;

//    2            2
//   / \          /|\       The edge 0-1 is flipped to 2-3.
//  0---1   ->   0 | 1
//   \ /          \|/
//    3            3

TEST_CASE("edge flip: the diagonal is replaced and the winding is kept") {
    Triangle s = {0, 1, 2}, t = {1, 0, 3};
    REQUIRE(flip_edge(s, t));
    CHECK(s == Triangle{0, 3, 2});
    CHECK(t == Triangle{1, 2, 3});
}

TEST_CASE("edge flip: the result does not depend on the first corner of the triangles") {
    for (int k = 0; k < 9; ++k) {
        Triangle s = {0, 1, 2}, t = {1, 0, 3};
        std::rotate(s.begin(), s.begin() + k % 3, s.end());
        std::rotate(t.begin(), t.begin() + k / 3, t.end());
        REQUIRE(flip_edge(s, t));
        CHECK(s == Triangle{0, 3, 2});
        CHECK(t == Triangle{1, 2, 3});
    }
}

TEST_CASE("edge flip: flipping twice restores the two triangles in exchanged order") {
    Triangle s = {0, 1, 2}, t = {1, 0, 3};
    flip_edge(s, t);
    REQUIRE(flip_edge(s, t));
    CHECK(s == Triangle{3, 1, 0});
    CHECK(t == Triangle{2, 0, 1});
}

TEST_CASE("edge flip: triangles without exactly one common edge of consistent orientation are unchanged") {
    const auto stays = [](Triangle s, Triangle t) {
        const Triangle old_s = s, old_t = t;
        return !flip_edge(s, t) && s == old_s && t == old_t;
    };
    CHECK(stays({0, 1, 2}, {3, 4, 5}));
    CHECK(stays({0, 1, 2}, {1, 3, 4}));
    CHECK(stays({0, 1, 2}, {0, 1, 3}));  // inconsistent orientation
    CHECK(stays({0, 1, 2}, {1, 0, 2}));  // back to back: three common edges
    CHECK(stays({0, 1, 2}, {0, 1, 2}));
    CHECK(stays({0, 0, 2}, {0, 0, 3}));
}

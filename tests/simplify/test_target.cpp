#include "faqem/detail/simplify/target.hpp"

#include <catch2/catch.hpp>

using namespace faqem;
using detail::target_face_count;

TEST_CASE("target: a share is rounded down, but loses no face to rounding") {
    CHECK(target_face_count(ratio(0.1), 30) == 3);
    CHECK(target_face_count(ratio(0.1), 39) == 3);
    CHECK(target_face_count(ratio(1), 1e9) == 1'000'000'000);
    CHECK(target_face_count(ratio(0.3), 1) == 0);
}

TEST_CASE("target: a count is what it is, whatever the mesh has, up to 1e18") {
    CHECK(target_face_count(faces(7), 3) == 7);
    CHECK(target_face_count({Target::Kind::faces, 1e300}, 3) == 1'000'000'000'000'000'000);
}

TEST_CASE("target: none is a tenth") { CHECK(target_face_count({}, 1000) == 100); }

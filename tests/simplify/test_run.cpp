#include "faqem/detail/simplify/run.hpp"

#include "support/catch.hpp"

using namespace faqem;
using detail::target_face_count;

TEST_CASE("target: a ratio is rounded down without losing a face to rounding errors") {
    CHECK(target_face_count(ratio(0.1), 30) == 3);
    CHECK(target_face_count(ratio(0.1), 39) == 3);
    CHECK(target_face_count(ratio(1), 1e9) == 1'000'000'000);
    CHECK(target_face_count(ratio(0.3), 1) == 0);
}

TEST_CASE("target: a face count does not depend on the mesh and is limited to 1e18") {
    CHECK(target_face_count(faces(7), 3) == 7);
    CHECK(target_face_count({Target::Kind::faces, 1e300}, 3) == 1'000'000'000'000'000'000);
}

TEST_CASE("target: an unset target requests a tenth of the faces") {
    CHECK(target_face_count({}, 1000) == 100);
}

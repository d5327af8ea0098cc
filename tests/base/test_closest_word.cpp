#include "faqem/detail/base/closest_word.hpp"

#include "support/catch.hpp"

using faqem::detail::closest_word;
using faqem::detail::edit_distance;

TEST_CASE("edit_distance is the optimal string alignment distance") {
    CHECK(edit_distance("", "") == 0);
    CHECK(edit_distance("", "abc") == 3);
    CHECK(edit_distance("kitten", "sitting") == 3);
    CHECK(edit_distance("sunday", "saturday") == 3);
    CHECK(edit_distance("ab", "ba") == 1);   // a swap of adjacent characters
    CHECK(edit_distance("ca", "abc") == 3);  // no substring is edited twice
    CHECK(edit_distance("abc", "abc") == 0);
}

TEST_CASE("closest_word returns the first of the closest words, or none if all are too far away") {
    const std::vector<std::string> known = {"--faces", "--force", "--texture-size", "--fov"};
    CHECK(closest_word("--face", known) == "--faces");
    CHECK(closest_word("--froce", known) == "--force");
    CHECK(closest_word("--texture", known) == "--texture-size");  // a prefix
    CHECK(closest_word("--fo", known) == "--force");              // prefix of two words: the first
    CHECK(closest_word("--zzzzz", known).empty());
    CHECK(closest_word("", known).empty());
    CHECK(closest_word(std::string(100000, '-'), known).empty());
}

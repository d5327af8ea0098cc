#include "faqem/detail/base/buckets.hpp"

#include <utility>

#include "support/catch.hpp"

using faqem::detail::Buckets;

TEST_CASE("buckets: items keep their insertion order, and buckets may be empty") {
    const std::vector<std::pair<std::size_t, char>> all = {{2, 'a'}, {0, 'b'}, {2, 'c'}, {3, 'd'}, {0, 'a'}};
    const Buckets<char> buckets(4, [&](auto&& put) {
        for (const auto& [bucket, letter] : all) put(bucket, letter);
    });
    const auto text = [&](std::size_t b) { return std::string(buckets[b].begin(), buckets[b].end()); };
    CHECK(text(0) == "ba");
    CHECK(text(1).empty());
    CHECK(text(2) == "ac");
    CHECK(text(3) == "d");
}

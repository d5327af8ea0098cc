#include <map>
#include <random>

#include "asset/scene/value_numbers.hpp"
#include "support/catch.hpp"

using namespace faqem;
using faqem::detail::UniqueValues;

TEST_CASE("distinct values are numbered in the order of their first occurrence") {
    for (const std::size_t reserved : {0, 100, 100000}) {
        CAPTURE(reserved);
        UniqueValues<Vec3> values;
        values.reserve(reserved);
        std::map<Vec3, Index> expected;
        std::mt19937 random(1);
        bool same = true;
        for (int i = 0; i < 20000; ++i) {
            const Vec3 value = {double(random() % 20), double(random() % 20) * 1e-300, double(random() % 20)};
            const auto [entry, is_new] = expected.emplace(value, static_cast<Index>(expected.size()));
            same &= values.insert(value) == entry->second;
        }
        CHECK(same);
        CHECK(values.values().size() == expected.size());
        for (const auto& [value, number] : expected) same &= values.values()[number] == value;
        CHECK(same);
    }
}

TEST_CASE("values are compared bitwise") {
    UniqueValues<Vec2f> values;
    CHECK(values.insert({0, 1}) == 0);
    CHECK(values.insert({-0.0f, 1}) == 1);
    CHECK(values.insert({0, 1}) == 0);
}

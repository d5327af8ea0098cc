#include "bake/page/page_baker.hpp"

#include <set>
#include <utility>

#include "support/catch.hpp"

using faqem::detail::SampleOrder;
using faqem::detail::SamplePlace;

TEST_CASE("sample order: every sample of a texel comes once, in its cell of the grid") {
    for (std::uint32_t samples = 1; samples <= 8; ++samples) {
        const SampleOrder order(samples);
        for (const std::uint32_t x : {4u, 5u}) {
            std::set<std::pair<std::uint32_t, std::uint32_t>> places;
            for (const SamplePlace& place : order.of(x, 2)) {
                places.emplace(place.column, place.row);
                CHECK(place.s * samples == Approx(place.column + 0.5));
                CHECK(place.t * samples == Approx(place.row + 0.5));
            }
            CHECK(places.size() == order.of(x, 2).size());
            CHECK(places.size() == samples * samples);
            CHECK((places.rbegin()->first == samples - 1 && places.rbegin()->second == samples - 1));
        }
    }
}

TEST_CASE("sample order: of 2 x 2 samples, neighbouring texels begin with different diagonals") {
    const SampleOrder order(2);
    REQUIRE(order.first_samples() == 2);
    const auto is_falling = [&](std::uint32_t x, std::uint32_t y) {
        const SamplePlace &a = order.of(x, y)[0], &b = order.of(x, y)[1];
        REQUIRE((a.column != b.column && a.row != b.row));
        return a.column == a.row;
    };
    CHECK(is_falling(6, 4));
    CHECK_FALSE(is_falling(7, 4));
    CHECK_FALSE(is_falling(6, 5));
    CHECK(is_falling(7, 5));
}

TEST_CASE("sample order: more samples begin with one in the middle and the corners") {
    for (std::uint32_t samples = 3; samples <= 8; ++samples) {
        const SampleOrder order(samples);
        REQUIRE(order.first_samples() == 5);
        const auto places = order.of(0, 0);
        CHECK(places[0].s == Approx(0.5).margin(0.5 / samples));
        CHECK(places[0].t == Approx(0.5).margin(0.5 / samples));
        for (std::size_t i = 1; i < 5; ++i) {
            CHECK((places[i].column == 0 || places[i].column == samples - 1));
            CHECK((places[i].row == 0 || places[i].row == samples - 1));
        }
    }
    CHECK(SampleOrder(1).first_samples() == 1);
}

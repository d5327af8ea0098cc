#include "asset/scene/affine.hpp"

#include <cmath>
#include <limits>

#include "support/catch.hpp"

using namespace faqem;
using faqem::detail::transformed_bound;

TEST_CASE("the bound of transformed points is the largest coordinate of the corners of their box") {
    const std::array<double, 16> m = {1, 0, 0, 0, -2, 3, 0, 0, 0, 0, 1, 0, 0.5, 4, -7, 1};
    CHECK(transformed_bound(m, 2) == 10);       // row y: 3 * 2 + 4
    CHECK(transformed_bound(m, 0.25) == 7.25);  // row z: 0.25 + |-7|
}

TEST_CASE("the bound of transformed points isn't finite if any row of the matrix isn't") {
    for (const double bad :
         {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()})
        for (std::size_t row = 0; row < 3; ++row)
            for (std::size_t column = 0; column < 4; ++column) {
                CAPTURE(bad, row, column);
                std::array<double, 16> m = faqem::detail::identity_transform;
                m[4 * column + row] = bad;
                CHECK(!std::isfinite(transformed_bound(m, 1)));
            }
}

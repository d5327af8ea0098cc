#include "faqem/detail/base/portable_math.hpp"

#include <limits>

#include "support/catch.hpp"

using faqem::detail::portable_acos, faqem::detail::portable_exp, faqem::detail::portable_length,
    faqem::detail::portable_log;

TEST_CASE("the portable functions agree with those of the C library") {
    for (int i = 1; i < 10000; ++i) {
        const double x = 1e-4 * i;
        CHECK(portable_log(1e5 * x) == Approx(std::log(1e5 * x)).epsilon(1e-14).margin(1e-15));
        CHECK(portable_exp(60 * x - 30) == Approx(std::exp(60 * x - 30)).epsilon(1e-14));
        CHECK(portable_acos(2 * x - 1) == Approx(std::acos(2 * x - 1)).epsilon(1e-14));
    }
}

TEST_CASE("the portable functions are exact where the value is a number of few digits, or pi") {
    CHECK((portable_log(1) == 0 && portable_exp(0) == 1 && portable_acos(1) == 0));
    CHECK((portable_length(0, -0.0, 0) == 0 && portable_length(2e-200, -1e-200, 2e-200) == 3e-200 &&
           portable_length(-2e200, 3e200, 6e200) == 7e200));
    CHECK(portable_acos(-1) == Approx(std::numbers::pi).epsilon(1e-15));
    CHECK(portable_log(5e-324) == Approx(-744.44007192138126));
    CHECK(portable_log(std::numeric_limits<double>::max()) == Approx(709.78271289338397));
}

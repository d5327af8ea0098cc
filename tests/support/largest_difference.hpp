#pragma once
// How much two lists of vectors differ.

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "support/catch.hpp"

namespace faqem::testing {

/// The largest difference between components of two lists of vectors.
template <class A, class B>
double largest_difference(const A& a, const B& b) {
    REQUIRE(a.size() == b.size());
    double result = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        for (std::size_t k = 0; k < a[i].size(); ++k)
            result = std::max(result, std::abs(double{a[i][k]} - double{b[i][k]}));
    return result;
}

}  // namespace faqem::testing

#pragma once
/// \file
/// Functions whose versions in the C and C++ libraries round differently on each system. These use operations that IEEE 754 rounds
/// exactly, so that results are the same bytes everywhere. Relative errors are below 2e-14.

#include <algorithm>
#include <cmath>
#include <numbers>

#include "faqem/export.hpp"

FAQEM_DETAIL_BEGIN

/// Natural logarithm.
/// \param x  positive and finite
inline double portable_log(double x) {
    int exponent;
    double mantissa = std::frexp(x, &exponent);
    if (mantissa < 0.7) mantissa *= 2, --exponent;
    // ln((1 + s) / (1 - s)) = 2 (s + s^3 / 3 + s^5 / 5 + ...), |s| < 0.18
    const double s = (mantissa - 1) / (mantissa + 1);
    double sum = 0;
    for (int k = 23; k > 0; k -= 2) sum = sum * (s * s) + 1.0 / k;
    return exponent * std::numbers::ln2 + 2 * s * sum;
}

/// Exponential function.
/// \param x  between -110 and 110
inline double portable_exp(double x) {
    const double power = std::round(x / std::numbers::ln2), rest = x - power * std::numbers::ln2;
    double sum = 1;  // Taylor's series, |rest| < 0.35
    for (int k = 14; k > 0; --k) sum = 1 + rest / k * sum;
    return std::ldexp(sum, static_cast<int>(power));
}

/// Euclidean length, without overflow or underflow of the squares.
inline double portable_length(double x, double y, double z) {
    const double largest = std::max({std::abs(x), std::abs(y), std::abs(z)});
    if (largest == 0) return 0;
    x /= largest, y /= largest, z /= largest;
    return largest * std::sqrt(x * x + y * y + z * z);
}

/// Arc cosine, radians.
/// \param x  between -1 and 1
inline double portable_acos(double x) {
    // Half-angle formulas: the tangents of a quarter, an eighth and a sixteenth of the angle.
    double t = std::sqrt((1 - x) / 2) / (1 + std::sqrt((1 + x) / 2));
    for (int i = 0; i < 2; ++i) t /= 1 + std::sqrt(1 + t * t);
    double sum = 0;
    for (int k = 21; k > 0; k -= 2) sum = 1.0 / k - sum * (t * t);
    return 16 * t * sum;
}

FAQEM_DETAIL_END

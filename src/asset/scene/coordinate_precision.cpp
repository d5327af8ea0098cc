#include "asset/scene/coordinate_precision.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <string>
#include <string_view>

namespace faqem::detail {
namespace {

constexpr double units_in_last_place = 10;
constexpr double units_in_last_decimal = 2;
constexpr int least_decimal_digits = 6;  // numbers of fewer digits are exact, not rounded
constexpr int most_decimal_digits = 15;  // more are needed for doubles only
constexpr std::size_t sampled_vertices = 16384;

using NumberText = std::array<char, 32>;

template <class Number>
std::string_view shortest_text(Number x, NumberText& text) {
    const auto end =
        std::to_chars(text.data(), text.data() + text.size(), x, std::chars_format::scientific).ptr;
    return {text.data(), static_cast<std::size_t>(end - text.data())};
}

// 10^exponent, correctly rounded, which std::pow need not be.
double power_of_ten(int exponent) {
    const std::string text = "1e" + std::to_string(exponent);
    double result = 0;
    std::from_chars(text.data(), text.data() + text.size(), result);
    return result;
}

bool fits_float(double x) { return std::abs(x) <= std::numeric_limits<float>::max(); }

bool is_exact_float(double x) { return fits_float(x) && static_cast<double>(static_cast<float>(x)) == x; }

}  // namespace

CoordinatePrecision::Decimals CoordinatePrecision::decimals(double x) {
    NumberText text;
    const std::string_view number = shortest_text(std::abs(x), text);
    const std::size_t e = number.find('e');
    int exponent = 0;
    const char* first = number.data() + e + 1;
    std::from_chars(first + (*first == '+' ? 1 : 0), number.data() + number.size(), exponent);
    const int digits = static_cast<int>(e) - (e > 1 ? 1 : 0);  // without the point
    return {digits, exponent - (digits - 1)};
}

double CoordinatePrecision::decimal_unit(double magnitude) const {
    if (!(magnitude > 0)) return power_of_ten(printed_->last_place);
    const Decimals own = decimals(magnitude);
    const int first_place = own.last_place + own.digits - 1;
    return power_of_ten(std::max(printed_->last_place, first_place + 1 - printed_->digits));
}

bool CoordinatePrecision::is_printed_float(double x) const {
    if (!fits_float(x)) return false;
    const auto nearest = static_cast<float>(x);
    const double difference = std::abs(x - static_cast<double>(nearest));
    if (!(difference > 0.50001 * decimal_unit(std::abs(x)))) return true;
    NumberText as_double, as_float;
    return shortest_text(x, as_double) == shortest_text(nearest, as_float);
}

CoordinatePrecision::CoordinatePrecision(const std::vector<Vec3>& positions) {
    const auto all_of = [&](std::size_t stride, auto&& holds) {
        for (std::size_t v = 0; v < positions.size(); v += stride)
            for (const double x : positions[v])
                if (!holds(x)) return false;
        return true;
    };
    if (all_of(1, is_exact_float)) return;
    const std::size_t stride = (positions.size() - 1) / sampled_vertices + 1;
    Decimals most{0, std::numeric_limits<int>::max()};
    all_of(stride, [&](double x) {
        if (x == 0) return true;
        const Decimals own = decimals(x);
        most = {std::max(most.digits, own.digits), std::min(most.last_place, own.last_place)};
        return true;
    });
    if (most.digits < least_decimal_digits) return;
    printed_ = most;
    is_float_ = all_of(stride, [&](double x) { return is_printed_float(x); });
    if (most.digits > most_decimal_digits) printed_.reset();
}

double CoordinatePrecision::tolerance(double magnitude) const {
    const double unit = is_float_ ? static_cast<double>(std::numeric_limits<float>::epsilon())
                                  : std::numeric_limits<double>::epsilon();
    const double rounding = units_in_last_place * unit * magnitude;
    return printed_ ? std::max(rounding, units_in_last_decimal * decimal_unit(magnitude)) : rounding;
}

}  // namespace faqem::detail

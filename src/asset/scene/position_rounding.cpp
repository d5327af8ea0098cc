#include "asset/scene/position_rounding.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string_view>

#include "asset/scene/affine.hpp"
#include "asset/scene/coordinate_precision.hpp"
#include "asset/scene/flatten.hpp"

namespace faqem::detail {
namespace {

using Type = StoredPrecision::Type;

constexpr std::uint32_t enough_digits = 6;
constexpr std::uint32_t exact_digits = 15;  // of decimals that doubles tell apart

double to_float(double x) {
    return std::abs(x) <= std::numeric_limits<float>::max() ? double{static_cast<float>(x)} : x;
}

// The closest decimal number of at most so many significant digits and decimals.
double to_decimal(double x, std::uint32_t digits, std::uint32_t decimals) {
    std::array<char, 512> text;
    char* const end = text.data() + text.size();
    std::to_chars_result written{};
    const bool is_long = !(std::abs(x) < 1e17);
    std::uint32_t own = 0;
    if (!is_long) {
        written = std::to_chars(text.data(), end, x, std::chars_format::fixed, static_cast<int>(decimals));
        for (const char c : std::string_view(text.data(), written.ptr))
            own += c >= '0' && c <= '9' && (own > 0 || c != '0');
    }
    if (is_long || own > digits)
        written =
            std::to_chars(text.data(), end, x, std::chars_format::scientific, static_cast<int>(digits) - 1);
    double result = x;
    std::from_chars(text.data(), written.ptr, result);
    return result + 0.0;  // no -0
}

// Whether a triangle has no area, as far as doubles tell.
bool is_flat(const std::vector<Vec3>& positions, const Triangle& t) {
    constexpr double least = 1e-10;  // of the area of the square over the longest edge
    std::array<Vec3, 2> edges;
    double longest = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        double squares = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const double along = positions[t[(i + 1) % 3]][k] - positions[t[i]][k];
            if (i < 2) edges[i][k] = along;
            squares += along * along;
        }
        longest = std::max(longest, squares);
    }
    const auto& [a, b] = edges;
    const double area =
        std::hypot(a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]);
    return !(area > least * longest);
}

// \return false, without changing anything, if a face would lose its area
template <class Round>
bool round_all(const std::vector<Triangle>& triangles, const Round& round, std::vector<Vec3>& positions) {
    std::vector<Vec3> rounded = positions;
    for (Vec3& p : rounded)
        for (double& x : p) x = round(x);
    for (const Triangle& t : triangles)
        if (is_flat(rounded, t) && !is_flat(positions, t)) return false;
    positions = std::move(rounded);
    return true;
}

// Whether files without a scene have the positions of the parts.
bool is_in_place(const Asset& asset) {
    const std::vector<Instance> all = instances(asset);
    return !scene_center(asset) && std::all_of(all.begin(), all.end(), [](const Instance& instance) {
        return instance.transform == identity_transform;
    });
}

}  // namespace

bool suits_floats(const std::vector<Vec3>& positions, const StoredPrecision& stored) {
    if (positions.empty()) return true;
    Vec3 low = positions[0], high = low;
    for (const Vec3& p : positions) {
        for (std::size_t k = 0; k < 3; ++k) {
            low[k] = std::min(low[k], p[k]);
            high[k] = std::max(high[k], p[k]);
        }
    }
    double size = 0, largest = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        size = std::max(size, high[k] - low[k]);
        largest = std::max({largest, -low[k], high[k]});
    }
    if (!(largest * double{std::numeric_limits<float>::epsilon()} <= 1e-6 * size)) return false;
    return stored.type != Type::decimal || CoordinatePrecision(positions).is_float();
}

StoredPrecision result_precision(const Asset& source, ModelFormat format) {
    if (format == ModelFormat::glb || format == ModelFormat::gltf || !is_in_place(source)) return {};
    if (format == ModelFormat::stl) return {Type::float32};
    const StoredPrecision& stored = source.precision;
    if (stored.type == Type::float64) return {};
    if (stored.type != Type::decimal || format == ModelFormat::obj) return stored;
    const bool is_float = std::all_of(source.parts.begin(), source.parts.end(),
                                      [&](const Part& part) { return suits_floats(part.positions, stored); });
    return {is_float ? Type::float32 : Type::unknown};
}

void round_positions(const StoredPrecision& precision, const std::vector<Triangle>& triangles,
                     std::vector<Vec3>& positions) {
    if (precision.type == Type::float32) round_all(triangles, to_float, positions);
    if (precision.type != Type::decimal) return;
    for (std::uint32_t more = precision.digits < enough_digits ? 1 : 0; more <= 1; ++more) {
        const std::uint32_t digits = precision.digits + more, decimals = precision.decimals + more;
        if (digits > exact_digits) return;
        if (round_all(
                triangles, [&](double x) { return to_decimal(x, digits, decimals); }, positions))
            return;
    }
}

bool loses_digits_as_floats(const StoredPrecision& stored, const std::vector<Vec3>& positions) {
    if (stored.type == Type::float64) return true;
    const bool is_exact = is_float_representable(positions);
    if (stored.type == Type::unknown || (stored.type == Type::float32 && is_exact)) return !is_exact;
    return !suits_floats(positions, stored);
}

Part flatten_for_file(const Asset& asset) {
    Part flat = flatten(asset);
    const bool is_float = asset.precision.type == Type::float32;
    if (is_float && suits_floats(flat.positions, asset.precision))
        round_positions(asset.precision, flat.triangles, flat.positions);
    return flat;
}

}  // namespace faqem::detail

#include "asset/scene/position_rounding.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <string>
#include <string_view>
#include <utility>

#include "asset/scene/affine.hpp"
#include "asset/scene/flatten.hpp"

namespace faqem::detail {
namespace {

using Type = StoredPrecision::Type;

constexpr std::uint32_t enough_digits = 6;
constexpr std::uint32_t exact_digits = 15;  // of decimals that doubles tell apart
constexpr double units_of_rounding = 10;    // in the last place of a float or double
constexpr double decimals_of_rounding = 2;  // units in the last decimal place
constexpr std::size_t sampled_vertices = 16384;

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
        for (const char c : std::string_view(text.data(), written.ptr - text.data()))
            own += c >= '0' && c <= '9' && (own > 0 || c != '0');
    }
    if (is_long || own > digits)
        written =
            std::to_chars(text.data(), end, x, std::chars_format::scientific, static_cast<int>(digits) - 1);
    double result = x;
    std::from_chars(text.data(), written.ptr, result);
    return result + 0.0;  // no -0
}

// A unit in the last place of a decimal number of at most so many significant digits and decimals.
double decimal_unit(double x, std::uint32_t digits, std::uint32_t decimals) {
    const double first_place = x == 0 ? -400 : std::floor(std::log10(std::abs(x)));
    const double last_place =
        std::max(-static_cast<double>(decimals), first_place + 1 - static_cast<double>(digits));
    return std::pow(10, last_place);
}

// Whether a float has the digits of the number.
bool is_printed_float(double x) {
    if (!(std::abs(x) <= std::numeric_limits<float>::max())) return false;
    std::array<char, 32> text;
    constexpr std::chars_format format = std::chars_format::scientific;
    char* const end = std::to_chars(text.data(), text.data() + text.size(), std::abs(x), format).ptr;
    const std::string number(text.data(), end);
    const int decimals = std::max(0, static_cast<int>(number.find('e')) - 2);
    const double closest = to_float(std::abs(x));
    char* const stop = std::to_chars(text.data(), text.data() + text.size(), closest, format, decimals).ptr;
    return std::string_view(text.data(), stop - text.data()) == number;
}

// Whether the coordinates are floats, as numbers or as text. If there are many, text is told from some of them.
bool are_floats(const std::vector<Vec3>& positions) {
    if (is_float_representable(positions)) return true;
    const std::size_t stride = (positions.size() - 1) / sampled_vertices + 1;
    for (std::size_t v = 0; v < positions.size(); v += stride)
        for (const double x : positions[v])
            if (!is_printed_float(x)) return false;
    return true;
}

// Whether floats resolve positions: their steps at the largest coordinate are at most a millionth of the bounding box,
// and, if the positions were text, they are what programs print for floats. Complexity: O(n)
bool suits_floats(const std::vector<Vec3>& positions, const StoredPrecision& stored) {
    if (positions.empty()) return true;
    PointBounds bounds;
    for (const Vec3& p : positions) bounds.add(p);
    const double largest = largest_component(std::array{bounds.low, bounds.high});
    const double size = largest_component(std::array<Vec3, 1>{minus(bounds.high, bounds.low)});
    if (!(largest * double{std::numeric_limits<float>::epsilon()} <= 1e-6 * size)) return false;
    return stored.type != Type::decimal || are_floats(positions);
}

// Rounds a number, and moves it by so many steps of the rounding.
using Rounding = std::function<double(double x, int steps)>;

double float_rounding(double x, int steps) {
    const double rounded = to_float(x);
    if (steps == 0) return rounded;
    const double infinity = std::numeric_limits<double>::infinity();
    return std::nextafter(static_cast<float>(rounded), static_cast<float>(steps * infinity));
}

Rounding decimal_rounding(std::uint32_t digits, std::uint32_t decimals) {
    return [=](double x, int steps) {
        const double rounded = to_decimal(x, digits, decimals);
        if (steps == 0) return rounded;
        return to_decimal(rounded + steps * decimal_unit(rounded, digits, decimals), digits, decimals);
    };
}

// Rounds positions so that no face loses its area: where it would, a corner moves by a step.
class AreaKeeper {
public:
    AreaKeeper(const std::vector<Triangle>& triangles, const std::vector<Vec3>& positions, Rounding rounding)
        : triangles_(triangles), before_(positions), rounded_(positions), rounding_(std::move(rounding)) {}

    // Returns the rounded positions, or those before if there is no way to keep all areas.
    std::vector<Vec3> operator()() {
        for (Vec3& p : rounded_)
            for (double& x : p) x = rounding_(x, 0);
        int repairs = 0;
        for (const Triangle& t : triangles_)
            if (!keeps_area(t) && (++repairs > most_repairs || !repair(t))) return before_;
        return std::move(rounded_);
    }

private:
    // Each takes a pass over all faces. If there are more, the steps are too coarse for the mesh.
    static constexpr int most_repairs = 100;
    static constexpr double least_area = 1e-10;  // twice that of a face, per square of its longest edge

    // Twice the area, as a vector; 0 if doubles do not tell it from 0.
    static Vec3 area(const std::vector<Vec3>& positions, const Triangle& t) {
        const Vec3 &a = positions[t[0]], &b = positions[t[1]], &c = positions[t[2]];
        const Vec3 ab = minus(b, a), bc = minus(c, b), ca = minus(a, c), result = cross(ab, minus(c, a));
        const double longest = std::max({dot(ab, ab), dot(bc, bc), dot(ca, ca)});
        return std::sqrt(dot(result, result)) > least_area * longest ? result : Vec3{0, 0, 0};
    }

    bool keeps_area(const Triangle& t) const {
        return area(rounded_, t) != Vec3{0, 0, 0} || area(before_, t) == Vec3{0, 0, 0};
    }

    bool repair(const Triangle& t) {
        for (const Index v : t) {
            for (double& x : rounded_[v]) {
                const double own = x;
                for (const int steps : {1, -1}) {
                    x = rounding_(own, steps);
                    if (dot(area(rounded_, t), area(before_, t)) > 0 && keeps_areas_at(v)) return true;
                }
                x = own;
            }
        }
        return false;
    }

    bool keeps_areas_at(Index v) const {
        return std::ranges::all_of(triangles_, [&](const Triangle& t) {
            return std::ranges::find(t, v) == t.end() || keeps_area(t);
        });
    }

    const std::vector<Triangle>& triangles_;
    const std::vector<Vec3>& before_;
    std::vector<Vec3> rounded_;
    const Rounding rounding_;
};

// Whether files without a scene have the positions of the parts.
bool is_in_place(const Asset& asset) {
    return !scene_center(asset) && std::ranges::all_of(instances(asset), [](const Instance& instance) {
        return instance.transform == identity_transform;
    });
}

// Bits of texture coordinates that meshopt compression rounds in any case.
constexpr std::uint32_t most_meshopt_uv_bits = 15;

// Bits of the compressed texture coordinates of a part; 0: exact.
std::uint32_t rounded_uv_bits(const Asset& asset, const Part& part) {
    if (asset.compression == Compression::draco) return asset.uv_bits;
    if (asset.compression != Compression::meshopt || part.file_order != FileOrder::for_gpu) return 0;
    return asset.uv_bits > 0 ? asset.uv_bits : most_meshopt_uv_bits;
}

template <class Number>
Number rounded_to(Number value, double step) {
    return static_cast<Number>(std::round(double{value} / step) * step);
}

}  // namespace

CoordinateRounding::CoordinateRounding(const std::vector<Vec3>& positions, const StoredPrecision& stored)
    : relative_(units_of_rounding * (are_floats(positions) ? double{std::numeric_limits<float>::epsilon()}
                                                           : std::numeric_limits<double>::epsilon())) {
    const bool is_rounded_text =
        stored.type == Type::decimal && stored.digits >= enough_digits && stored.digits <= exact_digits;
    if (is_rounded_text) text_ = stored;
}

double CoordinateRounding::tolerance(double magnitude) const {
    const double rounding = relative_ * magnitude;
    if (!text_) return rounding;
    return std::max(rounding, decimals_of_rounding * decimal_unit(magnitude, text_->digits, text_->decimals));
}

StoredPrecision result_precision(const Asset& source, ModelFormat format) {
    if (format == ModelFormat::glb || format == ModelFormat::gltf || !is_in_place(source)) return {};
    if (format == ModelFormat::stl) return {Type::float32};
    const StoredPrecision& stored = source.precision;
    if (stored.type == Type::float64) return {};
    if (stored.type != Type::decimal || format == ModelFormat::obj) return stored;
    const bool is_float = std::ranges::all_of(
        source.parts, [&](const Part& part) { return suits_floats(part.positions, stored); });
    return {is_float ? Type::float32 : Type::unknown};
}

void round_positions(const StoredPrecision& precision, const std::vector<Triangle>& triangles,
                     std::vector<Vec3>& positions) {
    if (precision.type == Type::float32) positions = AreaKeeper(triangles, positions, float_rounding)();
    if (precision.type != Type::decimal) return;
    const std::uint32_t more = precision.digits < enough_digits ? 1 : 0;
    const std::uint32_t digits = precision.digits + more, decimals = precision.decimals + more;
    if (digits <= exact_digits)
        positions = AreaKeeper(triangles, positions, decimal_rounding(digits, decimals))();
}

bool loses_digits_as_floats(const StoredPrecision& stored, const std::vector<Vec3>& positions) {
    if (stored.type == Type::float64) return true;
    const bool is_exact = is_float_representable(positions);
    if (stored.type == Type::unknown || (stored.type == Type::float32 && is_exact)) return !is_exact;
    return !suits_floats(positions, stored);
}

Part flatten_for_file(const Asset& asset) {
    Part flat = flatten(asset);
    if (asset.precision.type == Type::float32 && suits_floats(flat.positions, asset.precision))
        round_positions(asset.precision, flat.triangles, flat.positions);
    return flat;
}

bool round_vertices(Asset& asset) {
    bool is_rounded = false;
    for (Part& part : asset.parts) {
        if (part.position_spacing > 0) {
            is_rounded = true;
            for (Vec3& position : part.positions)
                for (double& x : position) x = rounded_to(x, part.position_spacing);
        }
        const std::uint32_t bits = rounded_uv_bits(asset, part);
        if (bits == 0) continue;
        const double step = std::ldexp(1.0, -static_cast<int>(bits));
        for (auto& uvs : part.uvs) {
            is_rounded = is_rounded || !uvs.empty();
            for (Vec2f& uv : uvs)
                for (float& x : uv) x = rounded_to(x, step);
        }
    }
    return is_rounded;
}

}  // namespace faqem::detail

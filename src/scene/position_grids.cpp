#include "scene/position_grids.hpp"

#include <algorithm>
#include <cmath>

#include "scene/scene_size.hpp"

namespace faqem::detail {
namespace {

// A grid of the source is used if the rounding is at most this share of the error that is allowed.
constexpr double max_share_of_error = 0.25;

double positive_or(double value, double otherwise) {
    return value > 0 && std::isfinite(value) ? value : otherwise;
}

bool uses_new_grid(const Asset& source, const Options& options) {
    return options.quantize.kind == Quantize::on ||
           (options.quantize.kind == Quantize::source &&
            result_compression(source, options) == Compression::draco);
}

// The power of two that is at least the given positive number.
double power_of_two_above(double x) {
    int exponent;
    const double fraction = std::frexp(x, &exponent);
    return std::ldexp(1.0, fraction == 0.5 ? exponent - 1 : exponent);
}

// The largest distance by which a vertex of a part moves, units of the part.
double largest_move(const Part& part) {
    double largest = 0;
    for (const Triangle& triangle : part.triangles) {
        for (const Index v : triangle) {
            double squares = 0;
            for (const double x : part.positions[v]) {
                const double move = x - std::round(x / part.position_spacing) * part.position_spacing;
                squares += move * move;
            }
            largest = std::max(largest, squares);
        }
    }
    return std::sqrt(largest);
}

}  // namespace

double PositionGrids::max_distance() const { return std::sqrt(3.0) / 2 * spacing; }

Compression result_compression(const Asset& source, const Options& options) {
    return options.compress == Compression::source ? source.compression : options.compress;
}

PositionGrids position_grids(const Asset& source, const Options& options) {
    PositionGrids grids;
    const bool is_new = uses_new_grid(source, options);
    const bool has_grids =
        options.quantize.kind == Quantize::source &&
        std::ranges::any_of(source.parts, [](const Part& part) { return part.position_spacing > 0; });
    if (!is_new && !has_grids) return grids;
    const SceneSize size = scene_size(source);
    const std::uint32_t bits = options.quantize.position_bits.value_or(usual_position_bits);
    const double steps = std::ldexp(1.0, static_cast<int>(bits));
    const double spacing = power_of_two_above(positive_or(size.diagonal, 1) / steps);
    for (std::size_t p = 0; p < source.parts.size(); ++p) {
        const double own = source.parts[p].position_spacing, scale = positive_or(size.scales[p].largest, 1);
        grids.spacings.push_back(
            is_new && !(options.quantize.kind == Quantize::source && own > 0) ? spacing / scale : own);
        grids.scales.push_back(scale);
        grids.spacing = std::max(grids.spacing, grids.spacings.back() * scale);
    }
    if (options.quantize.kind == Quantize::source && options.max_error &&
        !(grids.max_distance() <= max_share_of_error * size(*options.max_error))) {
        grids = {};
        grids.is_left_out = true;
    }
    return grids;
}

void set_quantization(const Asset& source, const Options& options, Asset& result, Report& report) {
    result.compression = result_compression(source, options);
    const PositionGrids grids = position_grids(source, options);
    if (grids.is_left_out)
        report.warnings.push_back(
            "the grids of positions are coarse for max_error: the positions are floats");
    const bool is_new = uses_new_grid(source, options);
    if (options.quantize.kind != Quantize::off) {
        result.normal_bits = is_new || source.normal_bits > 0 ? options.quantize.normal_bits : 0;
        result.uv_bits = is_new || source.uv_bits > 0 ? options.quantize.uv_bits : 0;
    }
    if (grids.spacings.empty()) return;
    PositionRounding rounding{grids.spacing, 0};
    for (std::size_t p = 0; p < result.parts.size(); ++p) {
        Part& part = result.parts[p];
        part.position_spacing = grids.spacings[p];
        if (part.position_spacing > 0)
            rounding.max_error = std::max(rounding.max_error, largest_move(part) * grids.scales[p]);
    }
    report.position_rounding = rounding;
}

}  // namespace faqem::detail

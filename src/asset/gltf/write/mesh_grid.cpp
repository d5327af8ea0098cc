#include "asset/gltf/write/mesh_grid.hpp"

#include <algorithm>
#include <cmath>

#include "asset/scene/affine.hpp"

namespace faqem::detail {
namespace {

/// Integers that a position may be stored as.
struct StepRange {
    NumberType type;
    double low, high;
    double unit;  // spacing of normalised integers
};

constexpr std::array<StepRange, 4> step_ranges = {{{NumberType::i16, -32767, 32767, 1.0 / 32767},
                                                   {NumberType::u16, 0, 65535, 1.0 / 65535},
                                                   {NumberType::i8, -127, 127, 1.0 / 127},
                                                   {NumberType::u8, 0, 255, 1.0 / 255}}};

bool is_within(const PointBounds& bounds, const StepRange& range) {
    return *std::ranges::min_element(bounds.low) >= range.low &&
           *std::ranges::max_element(bounds.high) <= range.high;
}

/// Bounds of all positions in steps.
PointBounds bounds_in_steps(const std::vector<const Part*>& parts, const Vec3& origin, double spacing) {
    PointBounds bounds;
    for (const Part* part : parts) {
        for (const Triangle& triangle : part->triangles) {
            for (const Index v : triangle) {
                Vec3 step;
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    const auto stored = static_cast<float>(part->positions[v][axis] - origin[axis]);
                    step[axis] = std::round(double{stored} / spacing);
                }
                bounds.add(step);
            }
        }
    }
    return bounds;
}

}  // namespace

Vec3 MeshGrid::offset() const {
    Vec3 result;
    for (std::size_t axis = 0; axis < 3; ++axis) result[axis] = static_cast<double>(origin[axis]) * spacing;
    return result;
}

std::int32_t MeshGrid::step(float position, std::size_t axis) const {
    return static_cast<std::int32_t>(std::round(double{position} / spacing) -
                                     static_cast<double>(origin[axis]));
}

double MeshGrid::steps(float displacement) const { return std::round(double{displacement} / spacing); }

MeshGrid choose_grid(const std::vector<const Part*>& parts, const Vec3& origin, std::string& unfit) {
    constexpr double max_origin = 0x1p52, max_extent = 65535;
    MeshGrid grid;
    const auto has_faces = [](const Part* part) { return !part->triangles.empty(); };
    const auto first = std::ranges::find_if(parts, has_faces);
    if (first == parts.end() || !((*first)->position_spacing > 0)) return grid;
    const double spacing = (*first)->position_spacing;
    if (std::ranges::any_of(
            parts, [&](const Part* part) { return has_faces(part) && part->position_spacing != spacing; })) {
        unfit = "its parts have different grids";
        return grid;
    }
    const PointBounds bounds = bounds_in_steps(parts, origin, spacing);
    for (const StepRange& range : step_ranges)
        if (spacing == range.unit && is_within(bounds, range)) return {spacing, {}, range.type, true};
    for (const StepRange& range : {step_ranges[0], step_ranges[1]})
        if (is_within(bounds, range)) return {spacing, {}, range.type, false};
    const Vec3 extent = minus(bounds.high, bounds.low);
    if (!(*std::ranges::max_element(extent) <= max_extent) ||
        !std::ranges::all_of(bounds.low, [&](double x) { return std::abs(x) <= max_origin; })) {
        unfit = "it extends over more than 65536 steps of the grid";
        return grid;
    }
    grid = {spacing, {}, NumberType::u16, false};
    for (std::size_t axis = 0; axis < 3; ++axis)
        grid.origin[axis] = static_cast<std::int64_t>(bounds.low[axis]);
    return grid;
}

}  // namespace faqem::detail

#include "scene/moving_vertices.hpp"

#include <algorithm>
#include <cmath>

#include "asset/scene/affine.hpp"
#include "asset/scene/source_traits.hpp"
#include "faqem/engine/mesh/weld.hpp"

namespace faqem::detail {
namespace {

// A vertex is compared with the last ones at its position that differ from each other: many of them are rare.
constexpr std::size_t max_compared = 64;

// The largest difference between the weights that two vertices have of any joint.
double weight_difference(const Part& part, Index a, Index b) {
    const auto weight_of = [&](Index v, std::uint16_t joint) {
        double sum = 0;
        for (std::size_t k = 0; k < 4; ++k)
            if (part.joints[v][k] == joint) sum += part.weights[v][k];
        return sum;
    };
    double most = 0;
    for (const Index v : {a, b})
        for (const std::uint16_t joint : part.joints[v])
            most = std::max(most, std::abs(weight_of(a, joint) - weight_of(b, joint)));
    return most;
}

bool move_together(const Part& part, const MotionRounding& rounding, Index a, Index b) {
    if (!part.joints.empty() && !part.weights.empty() && !(weight_difference(part, a, b) <= rounding.weight))
        return false;
    for (std::size_t t = 0; t < part.morph_targets.size(); ++t) {
        const std::vector<Vec3f>& shifts = part.morph_targets[t].positions;
        if (shifts.empty()) continue;
        for (std::size_t k = 0; k < 3; ++k)
            if (!(std::abs(double{shifts[a][k]} - shifts[b][k]) <= rounding.shift[t])) return false;
    }
    return true;
}

}  // namespace

MotionRounding motion_rounding(const Asset& asset, const Part& part) {
    MotionRounding rounding;
    // Displacements are differences of positions, and as inexact as these.
    const double of_positions = 2.5e-7 * largest_component(part.positions);
    const MotionSteps steps = motion_steps(asset, part);
    rounding.weight = std::max(rounding.weight, 1.01 * steps.weight);
    for (std::size_t t = 0; t < part.morph_targets.size(); ++t)
        rounding.shift.push_back(std::max(
            1e-6 * largest_component(part.morph_targets[t].positions) + of_positions, 1.01 * steps.shift[t]));
    return rounding;
}

std::vector<Triangle> welded_by_motion(const Part& part, const MotionRounding& rounding, double distance) {
    const bool is_skinned = !part.joints.empty() && !part.weights.empty();
    if (!is_skinned && part.morph_targets.empty()) return {};
    // Vertices that no face uses must not affect the others, as in a weld by position.
    std::vector<Index> used;
    std::vector<Vec3> positions;
    std::vector<std::uint8_t> is_used(part.positions.size(), 0);
    for (const Triangle& t : part.triangles)
        for (const Index v : t) is_used[v] = 1;
    for (Index v = 0; v < is_used.size(); ++v)
        if (is_used[v]) used.push_back(v), positions.push_back(part.positions[v]);
    const std::vector<Index> near = engine::weld_within(positions, distance);
    std::vector<std::vector<Index>> others(
        used.size());  // by first vertex at a position: those that differ from it
    std::vector<Index> welded(part.positions.size(), no_index);
    bool any = false;
    for (std::size_t i = 0; i < used.size(); ++i) {
        const Index v = used[i], first = used[near[i]];
        welded[v] = first;
        if (v == first || move_together(part, rounding, first, v)) continue;
        std::vector<Index>& apart = others[near[i]];
        const auto begin = apart.size() > max_compared
                               ? apart.end() - static_cast<std::ptrdiff_t>(max_compared)
                               : apart.begin();
        const auto found =
            std::find_if(begin, apart.end(), [&](Index w) { return move_together(part, rounding, w, v); });
        welded[v] = found == apart.end() ? v : *found;
        if (found == apart.end()) apart.push_back(v);
        any = true;
    }
    if (!any) return {};
    std::vector<Triangle> triangles = part.triangles;
    for (Triangle& t : triangles)
        for (Index& v : t) v = welded[v];
    return triangles;
}

}  // namespace faqem::detail

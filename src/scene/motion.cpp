#include "scene/motion.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "asset/scene/affine.hpp"
#include "asset/scene/source_traits.hpp"
#include "faqem/detail/simplify/preprocess.hpp"

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

bool is_complete(const CostCurve& curve) {
    return curve.stop != StopReason::cancelled && curve.stop != StopReason::reached_time_limit;
}

Options without_history(Options options) {
    options.history = Recording::off;
    return options;
}

// A part in the pose of a morph target with weight 1.
struct Pose {
    std::vector<Vec3> positions;
    MeshView mesh;

    Pose(const Part& part, const MeshView& rest, const MorphTarget& target)
        : positions(part.positions), mesh(rest) {
        for (std::size_t v = 0; v < positions.size(); ++v) add_scaled(positions[v], 1, target.positions[v]);
        mesh.positions = positions;
    }
    Pose(const Pose&) = delete;
};

// The targets in which a part is not flat down to `faces` faces, with their curves.
std::vector<std::pair<std::size_t, CostCurve>> shaping_targets(const Part& part, const MeshView& mesh,
                                                               const Options& options,
                                                               const engine::RunContext& context,
                                                               std::uint64_t faces) {
    std::vector<std::pair<std::size_t, CostCurve>> found;
    for (std::size_t t = 0; t < part.morph_targets.size(); ++t) {
        if (part.morph_targets[t].positions.empty()) continue;
        CostCurve curve = cost_curve(Pose(part, mesh, part.morph_targets[t]).mesh, options, context);
        if (!is_complete(curve)) return {};
        if (!is_flat_down_to(curve, faces)) found.emplace_back(t, std::move(curve));
    }
    return found;
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
    std::vector<Index> welded = weld_referenced(part.positions, part.triangles, distance);
    // By first vertex at a position: those that differ from it.
    std::vector<std::vector<Index>> others(welded.size());
    bool any = false;
    for (Index v = 0; v < welded.size(); ++v) {
        const Index first = welded[v];
        if (v == first || move_together(part, rounding, first, v)) continue;
        std::vector<Index>& apart = others[first];
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

bool has_displacements(const Part& part) {
    return std::ranges::any_of(part.morph_targets, [](const MorphTarget& target) {
        return largest_component(target.positions) > 0;
    });
}

CostCurve curve_in_motion(CostCurve rest, const Part& part, const MeshView& mesh, const Options& options,
                          const engine::RunContext& context, std::uint64_t faces) {
    if (!is_complete(rest) || !is_flat_down_to(rest, faces)) return rest;
    auto shaping = shaping_targets(part, mesh, without_history(options), context.quiet(), faces);
    return shaping.empty() ? std::move(rest) : std::move(shaping.front().second);
}

std::vector<Vec3> bent_positions(const Part& part, const MeshView& mesh, const Options& options,
                                 const engine::RunContext& context, std::uint64_t faces) {
    if (faces >= part.triangles.size()) return {};
    const Options own = without_history(options);
    const engine::RunContext quiet = context.quiet();
    const CostCurve rest = cost_curve(mesh, own, quiet);
    if (!is_complete(rest) || !is_flat_down_to(rest, faces)) return {};
    const auto shaping = shaping_targets(part, mesh, own, quiet, faces);
    if (shaping.empty()) return {};
    std::vector<Vec3> shifts(part.positions.size(), Vec3{0, 0, 0});
    double weight = 1;
    for (const auto& [t, curve] : shaping) {
        for (std::size_t v = 0; v < shifts.size(); ++v)
            add_scaled(shifts[v], weight, part.morph_targets[t].positions[v]);
        weight *= 0.9;  // so that targets which are opposite to each other do not cancel out
    }
    const double largest = largest_component(shifts);
    const double unit = bend * rest.diagonal / largest;
    if (!(largest > 0) || !std::isfinite(unit)) return {};
    std::vector<Vec3> positions = part.positions;
    for (std::size_t v = 0; v < positions.size(); ++v) add_scaled(positions[v], unit, shifts[v]);
    return positions;
}

}  // namespace faqem::detail

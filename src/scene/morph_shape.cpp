#include "scene/morph_shape.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "asset/scene/affine.hpp"

namespace faqem::detail {
namespace {

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
        for (std::size_t v = 0; v < positions.size(); ++v)
            for (std::size_t k = 0; k < 3; ++k) positions[v][k] += target.positions[v][k];
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
            for (std::size_t k = 0; k < 3; ++k)
                shifts[v][k] += weight * part.morph_targets[t].positions[v][k];
        weight *= 0.9;  // so that targets which are opposite to each other do not cancel out
    }
    const double largest = largest_component(shifts);
    const double unit = bend * rest.diagonal / largest;
    if (!(largest > 0) || !std::isfinite(unit)) return {};
    std::vector<Vec3> positions = part.positions;
    for (std::size_t v = 0; v < positions.size(); ++v)
        for (std::size_t k = 0; k < 3; ++k) positions[v][k] += unit * shifts[v][k];
    return positions;
}

}  // namespace faqem::detail

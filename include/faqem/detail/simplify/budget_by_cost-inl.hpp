#pragma once

#include "faqem/detail/simplify/budget_by_cost.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "faqem/detail/simplify/run.hpp"

FAQEM_DETAIL_BEGIN

namespace budget {

// A step of the curve of a mesh.
struct Reduction {
    double cost;  // comparable between meshes
    std::uint32_t mesh;
    std::uint64_t faces;  // number of faces of the mesh after the reduction
};

// Factors that make the costs of the curves comparable. Costs grow with the fourth power of the size of a mesh.
// Relative to the largest mesh they cannot overflow.
inline std::vector<double> cost_units(std::span<const CostCurve> curves, std::span<const double> weights) {
    std::vector<double> units;
    for (std::size_t m = 0; m < curves.size(); ++m)
        units.push_back(curves[m].diagonal * std::sqrt(std::sqrt(weights[m])));
    const double largest = units.empty() ? 0 : *std::max_element(units.begin(), units.end());
    for (double& unit : units) {
        const double relative = largest > 0 ? unit / largest : 0;
        unit = relative * relative * relative * relative;
    }
    return units;
}

// Whether all collapses up to this step are flat. The faces at a vertex have an area of at most about 6 / faces, since
// the diagonal is 1.
inline bool is_flat(const CostCurve::Step& step) {
    return step.cost * static_cast<double>(step.faces) < 6 * flat_distance * flat_distance;
}

// Takes the cheapest reductions of all meshes until `sum` is at most `face_budget`.
inline void take_cheapest(std::vector<Reduction> reductions, std::uint64_t face_budget,
                          std::vector<std::uint64_t>& share, std::uint64_t& sum) {
    std::stable_sort(reductions.begin(), reductions.end(),
                     [](const Reduction& a, const Reduction& b) { return a.cost < b.cost; });
    for (const Reduction& reduction : reductions) {
        if (sum <= face_budget) break;
        std::uint64_t& faces = share[reduction.mesh];
        // The last reduction may remove more faces than necessary: its mesh gets the remaining budget.
        const std::uint64_t removed = std::min(faces - reduction.faces, sum - face_budget);
        faces -= removed;
        sum -= removed;
    }
}

}  // namespace budget

FAQEM_INLINE bool is_flat_down_to(const CostCurve& curve, std::uint64_t faces) {
    bool is_flat = curve.min_faces <= faces;
    for (const CostCurve::Step& step : curve.steps) {
        if (step.faces <= faces) break;
        is_flat = is_flat && budget::is_flat(step);
    }
    return is_flat;
}

FAQEM_INLINE std::vector<std::uint64_t> distribute_face_budget(std::span<const CostCurve> curves,
                                                               std::span<const double> weights,
                                                               std::uint64_t face_budget,
                                                               std::span<const std::uint64_t> floors) {
    const std::vector<double> units = budget::cost_units(curves, weights);
    std::vector<budget::Reduction> reductions, below_floor;
    std::vector<std::uint64_t> share;
    std::uint64_t sum = 0;
    for (std::size_t m = 0; m < curves.size(); ++m) {
        const auto& [steps, min_faces, diagonal, stop] = curves[m];
        share.push_back(steps.empty() ? min_faces : steps.front().faces);
        sum += share.back();
        // The steps of a mesh are taken in their order: no flat one follows one that is not.
        bool is_deferred = false;
        for (std::size_t i = 0; i < steps.size(); ++i) {
            const std::uint64_t after = std::max(i + 1 < steps.size() ? steps[i + 1].faces : min_faces,
                                                 std::min(min_target_faces, share.back()));
            is_deferred = is_deferred || (!floors.empty() && after < floors[m] && !budget::is_flat(steps[i]));
            (is_deferred ? below_floor : reductions)
                .push_back({steps[i].cost * units[m], static_cast<std::uint32_t>(m), after});
        }
    }
    budget::take_cheapest(std::move(reductions), face_budget, share, sum);
    budget::take_cheapest(std::move(below_floor), face_budget, share, sum);
    return share;
}

FAQEM_DETAIL_END

#pragma once

#include "faqem/detail/simplify/budget_by_cost.hpp"
#include "faqem/export.hpp"

#include <algorithm>
#include <cmath>

#include "faqem/detail/simplify/run.hpp"

FAQEM_NAMESPACE_BEGIN
namespace detail {

FAQEM_INLINE std::vector<std::uint64_t> distribute_face_budget(std::span<const CostCurve> curves,
                                                               std::span<const double> weights,
                                                               std::uint64_t face_budget) {
    // Costs grow with the fourth power of the size of a mesh. Relative to the largest mesh they cannot
    // overflow.
    std::vector<double> size;
    for (std::size_t m = 0; m < curves.size(); ++m)
        size.push_back(curves[m].diagonal * std::sqrt(std::sqrt(weights[m])));
    const double largest = size.empty() ? 0 : *std::max_element(size.begin(), size.end());

    struct Reduction {
        double cost;
        std::uint32_t mesh;
        std::uint64_t faces;  // number of faces of the mesh after the reduction
    };
    std::vector<Reduction> reductions;
    std::vector<std::uint64_t> share;
    std::uint64_t sum = 0;
    for (std::size_t m = 0; m < curves.size(); ++m) {
        const auto& [steps, min_faces, diagonal, stop] = curves[m];
        const double relative = largest > 0 ? size[m] / largest : 0;
        const double unit = relative * relative * relative * relative;
        share.push_back(steps.empty() ? min_faces : steps.front().faces);
        sum += share.back();
        for (std::size_t i = 0; i < steps.size(); ++i) {
            const std::uint64_t after = i + 1 < steps.size() ? steps[i + 1].faces : min_faces;
            reductions.push_back({steps[i].cost * unit, static_cast<std::uint32_t>(m),
                                  std::max(after, std::min(min_target_faces, share.back()))});
        }
    }
    std::stable_sort(reductions.begin(), reductions.end(),
                     [](const Reduction& a, const Reduction& b) { return a.cost < b.cost; });
    for (const Reduction& reduction : reductions) {
        if (sum <= face_budget) break;
        std::uint64_t& faces = share[reduction.mesh];
        sum -= faces - reduction.faces;
        faces = reduction.faces;
        // The last reduction may remove more faces than necessary: its mesh gets the remaining budget.
        if (sum < face_budget) {
            faces += face_budget - sum;
            sum = face_budget;
        }
    }
    return share;
}

}  // namespace detail
FAQEM_NAMESPACE_END

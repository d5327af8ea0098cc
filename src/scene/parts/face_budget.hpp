#pragma once
/// \file
/// Distribution of the face budget of an asset over its parts.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "asset/scene/affine.hpp"
#include "asset/scene/messages.hpp"
#include "faqem/asset.hpp"
#include "faqem/bake.hpp"
#include "faqem/detail/measure/removed_components.hpp"
#include "faqem/detail/simplify/run.hpp"
#include "scene/weights/visibility.hpp"

namespace faqem::detail {

inline std::size_t faces_of(const Asset& asset, std::size_t part) {
    return asset.parts[part].triangles.size();
}

/// Minimum face count that keeps all components of a part: 4 faces for each component, or all it has. O(faces)
inline std::uint64_t min_faces_for_components(const Part& part) {
    const FaceComponents components = face_components(part.positions, part.triangles);
    std::vector<std::uint8_t> counted(components.count, 0);
    std::uint64_t sum = 0;
    for (const Index component : components.component) {
        std::uint8_t& count = counted[component];
        if (count == 4) continue;
        ++count;
        ++sum;
    }
    return sum;
}

/// Minimum face count by part. If the sum is more than `target_faces`, the minimums are by part instead of by
/// component.
inline std::vector<std::uint64_t> min_budgets(const Asset& asset, std::uint64_t target_faces) {
    std::vector<std::uint64_t> least;
    std::uint64_t sum = 0;
    for (const Part& part : asset.parts) sum += least.emplace_back(min_faces_for_components(part));
    for (std::size_t p = 0; p < least.size() && sum > target_faces; ++p)
        least[p] = std::min<std::uint64_t>(min_target_faces, faces_of(asset, p));
    return least;
}

/// Distributes `target_faces` over the parts in proportion to their face counts (largest remainder method).
/// A part gets at least 4 faces (or all it has) for each of its connected components, at the expense of the
/// other parts. If `target_faces` is too small for that, the minimum is 4 faces per part (or all it has).
/// \return face count by part; the sum exceeds `target_faces` only if the sum of 4 faces per part does
/// Complexity: O(faces).
inline std::vector<std::uint64_t> budget_by_faces(const Asset& asset, std::uint64_t target_faces) {
    // Parts whose proportional share would be below their minimum get the minimum; the other parts share the
    // rest.
    const std::size_t parts = asset.parts.size();
    std::vector<std::uint64_t> share = min_budgets(asset, target_faces);
    double rest = 0, left = static_cast<double>(target_faces);
    std::vector<std::size_t> order;
    for (std::size_t p = 0; p < parts; ++p) {
        rest += static_cast<double>(faces_of(asset, p));
        if (faces_of(asset, p) > 0) order.push_back(p);
    }
    const auto min_ratio = [&](std::size_t p) {
        return static_cast<double>(share[p]) / static_cast<double>(faces_of(asset, p));
    };
    std::ranges::stable_sort(order,
                             [&](std::size_t a, std::size_t b) { return min_ratio(a) > min_ratio(b); });
    auto first = order.begin();
    for (; first != order.end() && min_ratio(*first) * rest > left; ++first) {
        rest -= static_cast<double>(faces_of(asset, *first));
        left -= static_cast<double>(share[*first]);
    }
    order.erase(order.begin(), first);
    std::ranges::sort(order);
    const double ratio = order.empty() ? 0 : left / rest;
    std::vector<double> remainder(parts, 0);
    for (const std::size_t p : order) {
        const double exact = ratio * static_cast<double>(faces_of(asset, p));
        share[p] = std::max(share[p], static_cast<std::uint64_t>(exact));
        remainder[p] = exact - static_cast<double>(share[p]);
        left -= static_cast<double>(share[p]);
    }
    std::ranges::stable_sort(order,
                             [&](std::size_t a, std::size_t b) { return remainder[a] > remainder[b]; });
    for (std::size_t i = 0; i < order.size() && left >= 1; ++i, --left) ++share[order[i]];
    for (const std::size_t p : order) share[p] = std::min<std::uint64_t>(share[p], faces_of(asset, p));
    return share;
}

/// The number of faces below which budget_by_cost() reduces only flat parts: a share of the faces that a part would
/// have in proportion to the face counts.
inline constexpr double min_share = 0.65;

/// The faces that each part would have in proportion to the face counts, times the share of its vertices that are not
/// hidden.
/// \param visibility  VertexVisibility::weights, or empty
/// Complexity: O(vertices)
inline std::vector<double> proportional_shares(const Asset& asset, std::uint64_t target_faces,
                                               std::span<const std::vector<float>> visibility) {
    double faces = 0;
    for (std::size_t p = 0; p < asset.parts.size(); ++p) faces += static_cast<double>(faces_of(asset, p));
    std::vector<double> shares;
    for (std::size_t p = 0; p < asset.parts.size(); ++p) {
        double share = faces > 0 ? static_cast<double>(faces_of(asset, p)) / faces : 0;
        if (!visibility.empty() && !visibility[p].empty()) {
            const auto hidden =
                std::ranges::count_if(visibility[p], [](float seen) { return !(seen > min_visibility); });
            share *= 1 - static_cast<double>(hidden) / static_cast<double>(visibility[p].size());
        }
        shares.push_back(share * static_cast<double>(target_faces));
    }
    return shares;
}

/// Warns of the parts that have less than a tenth of their proportional share, and names up to five of them.
/// \param shares      of proportional_shares()
/// \param simplified  the warning is added to its report
/// Complexity: O(parts)
inline void warn_of_small_shares(const Asset& source, std::span<const double> shares,
                                 SimplifiedParts& simplified) {
    constexpr std::size_t most_named = 5;
    std::size_t count = 0;
    std::string names;
    for (std::size_t p = 0; p < shares.size(); ++p) {
        const std::size_t left = simplified.parts[p].mesh.triangles.size();
        if (!(static_cast<double>(left) < shares[p] / 10)) continue;
        if (++count > most_named) continue;
        names += (count == 1 ? "" : ", ") + part_title(source, p) + " (" + std::to_string(left) + " of " +
                 std::to_string(faces_of(source, p)) + ")";
    }
    if (count == 0) return;
    if (count > most_named) names += " and " + std::to_string(count - most_named) + " more";
    simplified.report.warnings.push_back(
        pluralized(count, "part") +
        (count == 1 ? " has less than a tenth of its proportional share of the faces: "
                    : " have less than a tenth of their proportional share of the faces: ") +
        names);
}

/// Weights by part that convert costs (squared distance times area) from a part's units to those of the
/// scene: the fourth power of an instance's scale, summed over the instances of the part. 1 for parts that
/// have no size in the scene, or none that is finite.
/// \param parts      number of parts
/// \param instances  all instances of the scene, as seen_instances() lists them
inline std::vector<double> cost_weights(std::size_t parts, std::span<const Instance> instances) {
    std::vector<double> weights(parts, 0);
    for (const Instance& instance : instances)
        weights[instance.part] += std::pow(squared_scale(instance.transform), 2);
    for (double& weight : weights)
        if (!(weight > 0) || !std::isfinite(weight)) weight = 1;
    return weights;
}

}  // namespace faqem::detail

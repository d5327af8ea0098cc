#pragma once

#include "faqem/detail/measure/removed_components.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "faqem/detail/base/vector.hpp"
#include "faqem/engine/mesh/union_find.hpp"
#include "faqem/engine/mesh/weld.hpp"

FAQEM_DETAIL_BEGIN

/// Measures of a component.
struct ComponentMeasures {
    std::uint64_t faces = 0;
    double area = 0;
    Eigen::AlignedBox3d box;
};

/// Measures components. Areas are relative to the square of the longest side of the model.
inline std::vector<ComponentMeasures> component_sizes(std::span<const PlacedFace> faces, std::size_t count) {
    std::vector<ComponentMeasures> sizes(count);
    // Positions are divided by 4, so that differences are finite.
    Eigen::AlignedBox3d all;
    for (const PlacedFace& face : faces)
        for (const Vec3& p : face.corners) sizes[face.component].box.extend(0.25 * to_eigen(p));
    for (const ComponentMeasures& size : sizes) all.extend(size.box);
    const double scale = 1 / std::max(all.sizes().maxCoeff(), std::numeric_limits<double>::min());
    for (const PlacedFace& face : faces) {
        const auto corner = [&](std::size_t i) {
            return Vector3(scale * (0.25 * to_eigen(face.corners[i]) - all.min()));
        };
        ++sizes[face.component].faces;
        sizes[face.component].area += 0.5 * engine::area_vector(corner(0), corner(1), corner(2)).norm();
    }
    return sizes;
}

FAQEM_INLINE FaceComponents face_components(const PositionView& positions, TriangleView triangles) {
    const std::vector<Index> representative = engine::weld_exact(positions);
    engine::UnionFind joined(positions.size());
    for (std::size_t f = 0; f < triangles.size(); ++f) {
        const Triangle t = triangles[f];
        for (const Index v : {t[1], t[2]}) joined.unite(representative[t[0]], representative[v]);
    }
    FaceComponents found;
    std::vector<Index> number(positions.size(), no_index);
    for (std::size_t f = 0; f < triangles.size(); ++f) {
        Index& own = number[joined.find(representative[triangles[f][0]])];
        if (own == no_index) own = found.count++;
        found.component.push_back(own);
    }
    return found;
}

FAQEM_INLINE FoundComponents removed_components(std::span<const PlacedFace> source,
                                                std::span<const PlacedFace> result, std::size_t count) {
    constexpr double seen_loss = 0.2;  // of the longest side of the box
    const std::vector<ComponentMeasures> sizes = component_sizes(source, count),
                                         left = component_sizes(result, count);
    double all = 0;
    for (const ComponentMeasures& size : sizes) all += size.area;
    FoundComponents found;
    for (Index c = 0; c < count; ++c) {
        const ComponentMeasures& size = sizes[c];
        const bool is_removed = left[c].faces == 0;
        const Vector3 sides = size.box.sizes();
        if (!is_removed && !((sides - left[c].box.sizes()).maxCoeff() > seen_loss * sides.maxCoeff()))
            continue;
        if (size.area > RemovedComponent::min_share * all) {
            const auto at = [](const Vector3& p) { return to_array(4 * p); };
            (is_removed ? found.removed : found.shrunk)
                .push_back({c, {"", size.faces, size.area / all, at(size.box.min()), at(size.box.max())}});
        } else if (is_removed) {
            ++found.small;
            found.small_share += all > 0 ? size.area / all : 0;
        }
    }
    for (auto* list : {&found.removed, &found.shrunk})
        std::stable_sort(list->begin(), list->end(), [](const auto& a, const auto& b) {
            return a.removed.area_share > b.removed.area_share;
        });
    return found;
}

FAQEM_INLINE bool may_lack_components(const Report& report, const TriangleMesh& mesh) {
    if (report.components_collapsed + report.components_deleted + report.components_pruned > 0) return true;
    constexpr int enough_faces = 32;  // to have the extents of any shape
    const FaceComponents components = face_components(mesh.positions, mesh.triangles);
    std::vector<int> faces(components.count, 0);
    for (const Index component : components.component) ++faces[component];
    return std::any_of(faces.begin(), faces.end(), [](int count) { return count < enough_faces; });
}

FAQEM_INLINE void report_removed_components(const MeshView& mesh, SimplifyResult& result) {
    Report& report = result.report;
    if (report.stop == StopReason::cancelled || !may_lack_components(report, result.mesh)) return;
    const FaceComponents components = face_components(mesh.positions, mesh.triangles);
    std::vector<Index> of_result;
    for (const Index f : result.face_origin) of_result.push_back(components.component[f]);
    std::vector<PlacedFace> before, after;
    append_placed_faces(before, mesh.triangles, components.component,
                        [&](Index v) { return mesh.positions[v]; });
    append_placed_faces(after, result.mesh.triangles, of_result,
                        [&](Index v) { return result.mesh.positions[v]; });
    const FoundComponents found = removed_components(before, after, components.count);
    for (const FoundComponent& one : found.removed) report.removed_components.push_back(one.removed);
    for (const FoundComponent& one : found.shrunk) report.shrunk_components.push_back(one.removed);
    warn_of_removed_components(report, found);
}

/// Rounded to a tenth of a percent, below 10%.
inline std::string percent_of_area(double share) {
    const long tenths = std::lround(1000 * share);
    std::string percent = std::to_string(tenths / 10);
    if (tenths < 100) percent.append(".").append(std::to_string(tenths % 10));
    return percent + "% of the area; a higher target keeps more";
}

FAQEM_INLINE void warn_of_removed_components(Report& report, const FoundComponents& found) {
    constexpr double seen_share = 0.02;
    if (found.small_share > seen_share)
        report.warnings.push_back(std::to_string(found.small) + " small components were removed, together " +
                                  percent_of_area(found.small_share));
    const auto warn = [&](const std::vector<RemovedComponent>& list, const std::string& one,
                          const std::string& several) {
        if (list.empty()) return;
        const RemovedComponent& largest = list.front();
        report.warnings.push_back(
            (list.size() == 1
                 ? "a visible component " + one + ": "
                 : std::to_string(list.size()) + " visible components " + several + ", the largest with ") +
            std::to_string(largest.faces) + (largest.faces == 1 ? " face" : " faces") +
            (largest.part.empty() ? "" : " in " + largest.part) + ", " + percent_of_area(largest.area_share));
    };
    warn(report.removed_components, "was removed", "were removed");
    warn(report.shrunk_components, "lost more than a fifth of its length",
         "lost more than a fifth of their length");
}

FAQEM_DETAIL_END

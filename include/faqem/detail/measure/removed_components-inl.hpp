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

FAQEM_NAMESPACE_BEGIN
namespace detail {

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

FAQEM_INLINE FoundComponents removed_components(std::span<const PlacedFace> faces,
                                                std::span<const std::uint8_t> is_left) {
    FoundComponents found;
    if (faces.empty() || std::find(is_left.begin(), is_left.end(), 0) == is_left.end()) return found;
    const std::vector<ComponentMeasures> sizes = component_sizes(faces, is_left.size());
    double all = 0;
    for (const ComponentMeasures& size : sizes) all += size.area;
    for (Index c = 0; c < is_left.size(); ++c) {
        const ComponentMeasures& size = sizes[c];
        if (is_left[c]) continue;
        if (!(size.area > RemovedComponent::min_share * all)) {
            ++found.small;
            found.small_share += all > 0 ? size.area / all : 0;
            continue;
        }
        found.visible.push_back(
            {c,
             {"", size.faces, size.area / all, to_array(4 * size.box.min()), to_array(4 * size.box.max())}});
    }
    std::stable_sort(found.visible.begin(), found.visible.end(), [](const auto& a, const auto& b) {
        return a.removed.area_share > b.removed.area_share;
    });
    return found;
}

FAQEM_INLINE void report_removed_components(const MeshView& mesh, SimplifyResult& result) {
    Report& report = result.report;
    if (report.stop == StopReason::cancelled) return;
    if (report.components_collapsed + report.components_deleted + report.components_pruned == 0) return;
    const FaceComponents components = face_components(mesh.positions, mesh.triangles);
    std::vector<std::uint8_t> is_left(components.count, 0);
    for (const Index f : result.face_origin) is_left[components.component[f]] = 1;
    std::vector<PlacedFace> faces;
    for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
        const Triangle t = mesh.triangles[f];
        faces.push_back(
            {components.component[f], {mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]}});
    }
    const FoundComponents found = removed_components(faces, is_left);
    for (const FoundComponent& one : found.visible) report.removed_components.push_back(one.removed);
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
    if (report.removed_components.empty()) return;
    const RemovedComponent& largest = report.removed_components.front();
    const std::size_t count = report.removed_components.size();
    report.warnings.push_back(
        (count == 1 ? std::string("a visible component was removed: ")
                    : std::to_string(count) + " visible components were removed, the largest with ") +
        std::to_string(largest.faces) + (largest.faces == 1 ? " face" : " faces") +
        (largest.part.empty() ? "" : " in " + largest.part) + ", " + percent_of_area(largest.area_share));
}

}  // namespace detail
FAQEM_NAMESPACE_END

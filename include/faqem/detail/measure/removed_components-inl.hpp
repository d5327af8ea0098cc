#pragma once

#include "faqem/detail/measure/removed_components.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>
#include <utility>

#include "faqem/engine/mesh/union_find.hpp"
#include "faqem/engine/mesh/vector.hpp"
#include "faqem/engine/mesh/weld.hpp"

FAQEM_NAMESPACE_BEGIN
namespace detail {

/// Measures of a component.
struct ComponentMeasures {
    std::uint64_t faces = 0;
    double area = 0;
    engine::Vector3 cells =
        engine::Vector3::Zero();  ///< of ViewGrids: number of cells with a point of the component
    Eigen::AlignedBox3d box;
};

/// Square grids over the unit cube, one for each view along an axis.
struct ViewGrids {
    int side;                                ///< number of cells
    std::array<std::vector<Index>, 3> last;  ///< by cell: the last component with a point in it
};

/// Adds points of a face, at most one cell apart, to the grids. Components are added one after the other.
/// \param all  counts the cells with a point of any component
inline void add_face(ViewGrids& grids, const PlacedFace& face, ComponentMeasures& own,
                     ComponentMeasures& all) {
    const engine::Vector3 a = grids.side * engine::to_eigen(face.corners[0]);
    const engine::Vector3 u = grids.side * engine::to_eigen(face.corners[1]) - a;
    const engine::Vector3 v = grids.side * engine::to_eigen(face.corners[2]) - a;
    const int n =
        1 + static_cast<int>(u.cwiseAbs().cwiseMax(v.cwiseAbs()).cwiseMax((u - v).cwiseAbs()).maxCoeff());
    for (int i = 0; i <= n; ++i) {
        for (int j = 0; i + j <= n; ++j) {
            const Eigen::Array3i cell =
                (a + (i * u + j * v) / n).array().cast<int>().max(0).min(grids.side - 1);
            for (int k = 0; k < 3; ++k) {
                const int index = cell[(k + 1) % 3] * grids.side + cell[(k + 2) % 3];
                Index& last = grids.last[static_cast<std::size_t>(k)][static_cast<std::size_t>(index)];
                if (last == no_index) ++all.cells[k];
                if (std::exchange(last, face.component) != face.component) ++own.cells[k];
            }
        }
    }
}

/// Measures components. Areas are relative to the square of the longest side of the model.
/// \param all  receives the sums
inline std::vector<ComponentMeasures> component_sizes(std::vector<PlacedFace> faces, std::size_t count,
                                                      ComponentMeasures& all) {
    std::sort(faces.begin(), faces.end());
    std::vector<ComponentMeasures> sizes(count);
    // Positions are divided by 4, so that differences are finite.
    for (const PlacedFace& face : faces)
        for (const Vec3& p : face.corners) sizes[face.component].box.extend(0.25 * engine::to_eigen(p));
    for (const ComponentMeasures& size : sizes) all.box.extend(size.box);
    const double scale = 1 / std::max(all.box.sizes().maxCoeff(), std::numeric_limits<double>::min());
    double squares = 0;
    for (PlacedFace& face : faces) {
        for (Vec3& p : face.corners)
            p = engine::to_array(scale * (0.25 * engine::to_eigen(p) - all.box.min()));
        const engine::Vector3 a = engine::to_eigen(face.corners[0]);
        const engine::Vector3 u = engine::to_eigen(face.corners[1]) - a,
                              v = engine::to_eigen(face.corners[2]) - a;
        ++sizes[face.component].faces;
        sizes[face.component].area += 0.5 * u.cross(v).norm();
        squares += std::max(u.squaredNorm(), v.squaredNorm());
    }
    for (const ComponentMeasures& size : sizes) all.area += size.area;
    // If many faces are large, cells are larger, so that large faces need at most 10^8 points.
    ViewGrids grids{static_cast<int>(std::min(256.0, 1 + std::sqrt(2e8 / squares))), {}};
    grids.last.fill(std::vector<Index>(static_cast<std::size_t>(grids.side * grids.side), no_index));
    for (const PlacedFace& face : faces) add_face(grids, face, sizes[face.component], all);
    return sizes;
}

FAQEM_INLINE FaceComponents face_components(const PositionView& positions, TriangleView triangles) {
    std::vector<Vec3> copy(positions.size());
    for (std::size_t v = 0; v < copy.size(); ++v) copy[v] = positions[v];
    const std::vector<Index> representative = engine::weld_exact(copy);
    engine::UnionFind joined(copy.size());
    for (std::size_t f = 0; f < triangles.size(); ++f) {
        const Triangle t = triangles[f];
        joined.unite(representative[t[0]], representative[t[1]]);
        joined.unite(representative[t[0]], representative[t[2]]);
    }
    FaceComponents found;
    std::vector<Index> number(copy.size(), no_index);
    for (std::size_t f = 0; f < triangles.size(); ++f) {
        Index& own = number[joined.find(representative[triangles[f][0]])];
        if (own == no_index) own = found.count++;
        found.component.push_back(own);
    }
    return found;
}

FAQEM_INLINE std::vector<FoundComponent> removed_components(std::vector<PlacedFace> faces,
                                                            std::span<const std::uint8_t> is_left) {
    std::vector<FoundComponent> removed;
    if (faces.empty() || std::find(is_left.begin(), is_left.end(), 0) == is_left.end()) return removed;
    ComponentMeasures all;
    const std::vector<ComponentMeasures> sizes = component_sizes(std::move(faces), is_left.size(), all);
    for (Index c = 0; c < is_left.size(); ++c) {
        const ComponentMeasures& size = sizes[c];
        if (is_left[c] || size.faces == 0) continue;
        double silhouette = 0;
        for (int axis = 0; axis < 3; ++axis) {
            // The silhouette of a flat model seen from the side is a line, in which parts hide each other.
            if (all.cells[axis] < 0.05 * all.cells.maxCoeff()) continue;
            silhouette = std::max(silhouette, size.cells[axis] / all.cells[axis]);
        }
        const double area = all.area > 0 ? size.area / all.area : 0;
        if (std::max(area, silhouette) > RemovedComponent::min_share)
            removed.push_back({c,
                               {"", size.faces, area, silhouette, engine::to_array(4 * size.box.min()),
                                engine::to_array(4 * size.box.max())}});
    }
    std::stable_sort(removed.begin(), removed.end(), [](const FoundComponent& a, const FoundComponent& b) {
        return std::max(a.removed.area_share, a.removed.silhouette_share) >
               std::max(b.removed.area_share, b.removed.silhouette_share);
    });
    return removed;
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
    for (FoundComponent& found : removed_components(std::move(faces), is_left))
        report.removed_components.push_back(std::move(found.removed));
    warn_of_removed_components(report);
}

FAQEM_INLINE void warn_of_removed_components(Report& report) {
    if (report.removed_components.empty()) return;
    const auto percent = [](double share) {
        char text[32];
        std::snprintf(text, sizeof text, "%d%%", static_cast<int>(std::lround(100 * std::min(share, 1.0))));
        return std::string(text);
    };
    const RemovedComponent& largest = report.removed_components.front();
    const std::size_t count = report.removed_components.size();
    report.warnings.push_back(
        (count == 1 ? std::string("a visible component was removed: ")
                    : std::to_string(count) + " visible components were removed, the largest with ") +
        std::to_string(largest.faces) + (largest.faces == 1 ? " face" : " faces") +
        (largest.part.empty() ? "" : " in " + largest.part) + ", " + percent(largest.area_share) +
        " of the area and " + percent(largest.silhouette_share) +
        " of the silhouette; a higher target keeps more");
}

}  // namespace detail
FAQEM_NAMESPACE_END

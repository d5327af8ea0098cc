#pragma once

#include "faqem/detail/measure/removed_components.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>

#include "faqem/engine/mesh/union_find.hpp"
#include "faqem/engine/mesh/vector.hpp"
#include "faqem/engine/mesh/weld.hpp"

FAQEM_NAMESPACE_BEGIN
namespace detail {

/// A picture with one bit per pixel.
class PixelMask {
public:
    static constexpr int size = 256;

    /// Sets the pixels that a triangle touches, or a few more.
    /// \param corners  in pixels, within [0, size]
    void add(const std::array<Eigen::Vector2d, 3>& corners) {
        double low = size, high = 0;
        for (const Eigen::Vector2d& p : corners) low = std::min(low, p.y()), high = std::max(high, p.y());
        for (int row = pixel(low); row <= pixel(high); ++row) {
            double left = size, right = 0;
            const auto extend = [&](double x) { left = std::min(left, x), right = std::max(right, x); };
            for (std::size_t k = 0; k < 3; ++k) {
                const Eigen::Vector2d &p = corners[k], &q = corners[(k + 1) % 3];
                if (pixel(p.y()) == row) extend(p.x());
                for (const double y : {row, row + 1}) {
                    if ((p.y() < y) == (q.y() < y)) continue;
                    extend(p.x() + (y - p.y()) / (q.y() - p.y()) * (q.x() - p.x()));
                }
            }
            if (left <= right) set(row, pixel(left), pixel(right));
        }
    }

    /// Number of pixels that are set.
    std::uint64_t count() const {
        std::uint64_t sum = 0;
        for (const std::uint64_t word : words_) sum += static_cast<std::uint64_t>(std::popcount(word));
        return sum;
    }

private:
    static constexpr int words_per_row = size / 64;

    static int pixel(double x) { return std::clamp(static_cast<int>(x), 0, size - 1); }

    void set(int row, int first, int last) {
        for (int word = first / 64; word <= last / 64; ++word) {
            const int begin = std::max(first - 64 * word, 0), end = std::min(last - 64 * word, 63);
            const std::uint64_t bits = ~std::uint64_t{0} >> (63 - (end - begin)) << begin;
            words_[static_cast<std::size_t>(row * words_per_row + word)] |= bits;
        }
    }

    std::array<std::uint64_t, std::size_t{size}* words_per_row> words_ = {};
};

/// What the shares of components are computed from.
struct ComponentSizes {
    std::vector<double> area;
    std::vector<std::uint64_t> faces;
    std::vector<Eigen::AlignedBox3d> box;
    double total_area = 0;
    Eigen::AlignedBox3d total_box;
};

/// Calls visit(component, corners) for each face. Positions are divided by 4, so that differences are finite.
template <class Visit>
void for_each_placed_face(std::span<const PlacedFaces> model, engine::CancellationCheck check_cancelled,
                          Visit&& visit) {
    for (const PlacedFaces& placed : model) {
        for (std::size_t f = 0; f < placed.triangles.size(); ++f) {
            check_cancelled();
            std::array<engine::Vector3, 3> corners;
            const Triangle t = placed.triangles[f];
            for (std::size_t k = 0; k < 3; ++k) corners[k] = 0.25 * engine::to_eigen(placed.positions[t[k]]);
            visit(placed.component[f], corners);
        }
    }
}

inline ComponentSizes component_sizes(std::span<const PlacedFaces> model, std::size_t count,
                                      engine::CancellationCheck check_cancelled) {
    ComponentSizes sizes{std::vector<double>(count, 0),
                         std::vector<std::uint64_t>(count, 0),
                         std::vector<Eigen::AlignedBox3d>(count),
                         0,
                         {}};
    for_each_placed_face(model, check_cancelled, [&](Index c, const auto& corners) {
        for (const engine::Vector3& p : corners) sizes.box[c].extend(p);
    });
    for (const Eigen::AlignedBox3d& box : sizes.box) {
        if (!box.isEmpty()) sizes.total_box.extend(box);
    }
    // Relative to the longest side, so that areas neither overflow nor underflow.
    const double side = sizes.total_box.isEmpty() ? 0 : sizes.total_box.sizes().maxCoeff();
    const double scale = 1 / std::max(side, std::numeric_limits<double>::min());
    for_each_placed_face(model, check_cancelled, [&](Index c, const auto& corners) {
        const auto& [p, q, r] = corners;
        const double area = 0.5 * (scale * (q - p)).cross(scale * (r - p)).norm();
        sizes.area[c] += area;
        sizes.total_area += area;
        ++sizes.faces[c];
    });
    return sizes;
}

/// Shares of the components in the silhouette of one view.
struct SilhouetteView {
    double pixels = 0;                 ///< of the silhouette
    std::vector<double> of_component;  ///< pixels of each component that is not left; 0 for the others
};

/// Draws the silhouette along a coordinate axis.
inline SilhouetteView draw_silhouette(std::span<const PlacedFaces> model, const ComponentSizes& sizes,
                                      std::span<const std::uint8_t> is_left, int axis,
                                      engine::CancellationCheck check_cancelled) {
    const int x = (axis + 1) % 3, y = (axis + 2) % 3;
    const engine::Vector3 low = sizes.total_box.min();
    const double scale = PixelMask::size / sizes.total_box.sizes().maxCoeff();
    const auto project = [&](const std::array<engine::Vector3, 3>& corners) {
        std::array<Eigen::Vector2d, 3> pixels;
        for (std::size_t k = 0; k < 3; ++k)
            pixels[k] = scale * Eigen::Vector2d(corners[k][x] - low[x], corners[k][y] - low[y]);
        return pixels;
    };
    PixelMask all;
    for_each_placed_face(model, check_cancelled,
                         [&](Index, const auto& corners) { all.add(project(corners)); });
    SilhouetteView view{static_cast<double>(all.count()), std::vector<double>(is_left.size(), 0)};
    // The pixels of a box bound those of its component, so that few components need a picture of their own.
    std::vector<PixelMask> masks;
    std::vector<Index> mask_of(is_left.size(), no_index);
    for (Index c = 0; c < is_left.size(); ++c) {
        if (is_left[c] || sizes.box[c].isEmpty()) continue;
        const engine::Vector3 extent = scale * sizes.box[c].sizes();
        if (!((extent[x] + 2) * (extent[y] + 2) > RemovedComponent::min_share * view.pixels)) continue;
        mask_of[c] = static_cast<Index>(masks.size());
        masks.emplace_back();
    }
    for_each_placed_face(model, check_cancelled, [&](Index c, const auto& corners) {
        if (mask_of[c] != no_index) masks[mask_of[c]].add(project(corners));
    });
    for (Index c = 0; c < is_left.size(); ++c) {
        if (mask_of[c] != no_index) view.of_component[c] = static_cast<double>(masks[mask_of[c]].count());
    }
    return view;
}

/// Largest share of each component in the silhouettes along the axes; 0 for components that are left.
inline std::vector<double> silhouette_shares(std::span<const PlacedFaces> model, const ComponentSizes& sizes,
                                             std::span<const std::uint8_t> is_left,
                                             engine::CancellationCheck check_cancelled) {
    std::vector<double> shares(is_left.size(), 0);
    if (!(sizes.total_box.sizes().maxCoeff() > 0)) return shares;
    std::vector<SilhouetteView> views;
    double most = 0;
    for (int axis = 0; axis < 3; ++axis) {
        views.push_back(draw_silhouette(model, sizes, is_left, axis, check_cancelled));
        most = std::max(most, views.back().pixels);
    }
    for (const SilhouetteView& view : views) {
        // The silhouette of a flat model seen from the side is a line, in which parts hide each other.
        if (!(view.pixels >= 0.05 * most)) continue;
        for (std::size_t c = 0; c < shares.size(); ++c)
            shares[c] = std::max(shares[c], view.of_component[c] / view.pixels);
    }
    return shares;
}

FAQEM_INLINE FaceComponents face_components(const PositionView& positions, TriangleView triangles,
                                            engine::CancellationCheck check_cancelled) {
    std::vector<Vec3> copy(positions.size());
    for (std::size_t v = 0; v < copy.size(); ++v) copy[v] = positions[v];
    const std::vector<Index> representative = engine::weld_exact(copy, check_cancelled);
    engine::UnionFind joined(copy.size());
    for (std::size_t f = 0; f < triangles.size(); ++f) {
        check_cancelled();
        const Triangle t = triangles[f];
        joined.unite(representative[t[0]], representative[t[1]]);
        joined.unite(representative[t[0]], representative[t[2]]);
    }
    FaceComponents found;
    std::vector<Index> number(copy.size(), no_index);
    for (std::size_t f = 0; f < triangles.size(); ++f) {
        check_cancelled();
        Index& own = number[joined.find(representative[triangles[f][0]])];
        if (own == no_index) own = found.count++;
        found.component.push_back(own);
    }
    return found;
}

FAQEM_INLINE std::vector<FoundComponent> removed_components(std::span<const PlacedFaces> model,
                                                            std::span<const std::uint8_t> is_left,
                                                            engine::CancellationCheck check_cancelled) {
    std::vector<FoundComponent> removed;
    if (std::all_of(is_left.begin(), is_left.end(), [](std::uint8_t left) { return left != 0; }))
        return removed;
    const ComponentSizes sizes = component_sizes(model, is_left.size(), check_cancelled);
    const std::vector<double> silhouettes = silhouette_shares(model, sizes, is_left, check_cancelled);
    for (Index c = 0; c < is_left.size(); ++c) {
        if (is_left[c]) continue;
        const double area = sizes.total_area > 0 ? sizes.area[c] / sizes.total_area : 0;
        if (!(std::max(area, silhouettes[c]) > RemovedComponent::min_share)) continue;
        removed.push_back(
            {c,
             {"", sizes.faces[c], area, silhouettes[c], engine::to_array(4 * sizes.box[c].min()),
              engine::to_array(4 * sizes.box[c].max())}});
    }
    const auto share = [](const FoundComponent& found) {
        return std::max(found.removed.area_share, found.removed.silhouette_share);
    };
    std::stable_sort(removed.begin(), removed.end(),
                     [&](const FoundComponent& a, const FoundComponent& b) { return share(a) > share(b); });
    return removed;
}

FAQEM_INLINE void report_removed_components(const MeshView& mesh, SimplifyResult& result) {
    Report& report = result.report;
    if (report.stop == StopReason::cancelled) return;
    if (report.components_collapsed + report.components_deleted + report.components_pruned == 0) return;
    const FaceComponents components = face_components(mesh.positions, mesh.triangles);
    std::vector<std::uint8_t> is_left(components.count, 0);
    for (const Index f : result.face_origin) is_left[components.component[f]] = 1;
    PlacedFaces all{{}, mesh.triangles, components.component};
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) all.positions.push_back(mesh.positions[v]);
    for (FoundComponent& found : removed_components({&all, 1}, is_left))
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

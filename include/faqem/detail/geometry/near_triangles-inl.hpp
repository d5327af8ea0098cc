#pragma once

#include "faqem/detail/geometry/near_triangles.hpp"
#include "faqem/export.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

FAQEM_NAMESPACE_BEGIN
namespace detail {

using engine::Vector3;

/// Thinner triangles, by the sine of the smallest angle, have no bound: their normals are too inaccurate.
inline constexpr double least_angle_of_bound = 1e-4;
/// Triangles farther away from the ball, in radii, have no bound: rounding of their normals is magnified.
inline constexpr double farthest_of_bound = 1e4;

FAQEM_INLINE void NearTriangles::Affine::set(int lane, const Vector3& gradient, double value_at_zero) {
    x[lane] = static_cast<float>(gradient.x());
    y[lane] = static_cast<float>(gradient.y());
    z[lane] = static_cast<float>(gradient.z());
    constant[lane] = static_cast<float>(value_at_zero);
}

FAQEM_INLINE void NearTriangles::describe(const Entry& entry, Group& group, int lane) const {
    const std::array<Vector3, 3> at = {(entry.a - centre_) * scale_, (entry.b - centre_) * scale_,
                                       (entry.c - centre_) * scale_};
    const Vector3 ab = at[1] - at[0], ac = at[2] - at[0], bc = at[2] - at[1];
    const double longest = std::max({ab.squaredNorm(), ac.squaredNorm(), bc.squaredNorm()});
    const Vector3 area = ab.cross(ac);
    const double twice_area = area.norm();
    const double farthest = std::max({at[0].squaredNorm(), at[1].squaredNorm(), at[2].squaredNorm()});
    // Without values, the signed distances stay 0 and the triangle is always evaluated.
    if (!(twice_area > least_angle_of_bound * longest && farthest < farthest_of_bound * farthest_of_bound))
        return;
    const Vector3 normal = area / twice_area;
    group.plane.set(lane, normal, -normal.dot(at[0]));
    for (std::size_t i = 0; i < 3; ++i) {
        const Vector3 inwards = normal.cross(at[(i + 1) % 3] - at[i]).normalized();
        group.edges[i].set(lane, inwards, -inwards.dot(at[i]));
    }
}

FAQEM_INLINE void NearTriangles::reset(const Vector3& centre, double reach, std::vector<Entry> entries) {
    clear();
    const double scale = 1 / reach;
    if (entries.size() > max_size || !std::isnormal(reach) || !(reach > 0) || !std::isnormal(scale)) return;
    // The bounds have rounding errors of less than 2e-6 for the coordinates in single precision. Closest points in
    // double precision are rounded to about 1e-16 of their coordinates.
    const double coordinate = centre.cwiseAbs().maxCoeff() * scale;
    tolerance_ = 4e-6 + 1e-14 * coordinate;
    if (!(tolerance_ < 1)) return;
    centre_ = centre;
    reach_ = reach;
    scale_ = scale;
    entries_ = std::move(entries);
    const std::size_t groups = (entries_.size() + width - 1) / width;
    groups_.assign(groups, {});
    for (std::size_t i = 0; i < entries_.size(); ++i)
        describe(entries_[i], groups_[i / width], static_cast<int>(i % width));
    // Lanes without a triangle are far away from every point.
    constexpr double far = 1e15;
    for (std::size_t i = entries_.size(); i < groups * width; ++i)
        groups_.back().plane.set(static_cast<int>(i % width), Vector3::Zero(), far);
}

FAQEM_INLINE std::optional<NearTriangles::Hit> NearTriangles::closest(const Vector3& p) const {
    if (entries_.empty()) return std::nullopt;
    const Vector3 offset = p - centre_;
    const double away = offset.norm();
    if (!(away < reach_)) return std::nullopt;
    const float x = static_cast<float>(offset.x() * scale_), y = static_cast<float>(offset.y() * scale_),
                z = static_cast<float>(offset.z() * scale_);
    std::array<Lanes, max_size / width> bounds;  // lower bounds of the squared distances
    Lanes least = Lanes::Constant(std::numeric_limits<float>::infinity());
    for (std::size_t g = 0; g < groups_.size(); ++g) {
        const auto& [plane, edges] = groups_[g];
        const Lanes height = plane.at(x, y, z);
        const Lanes inside =
            edges[0].at(x, y, z).min(edges[1].at(x, y, z)).min(edges[2].at(x, y, z)).min(0.0f);
        bounds[g] = height * height + inside * inside;
        least = least.min(bounds[g]);
    }
    const float smallest = least.minCoeff();
    Hit best;
    float limit = smallest;
    // First the triangles with the smallest bound, then the others that may be as close as these.
    for (const bool is_first : {true, false}) {
        for (std::size_t g = 0; g < groups_.size(); ++g) {
            if (!(bounds[g].minCoeff() <= limit)) continue;
            for (int lane = 0; lane < width; ++lane) {
                const float bound = bounds[g][lane];
                if (!(bound <= limit) || (bound <= smallest) != is_first) continue;
                const std::size_t i = g * width + static_cast<std::size_t>(lane);
                if (i >= entries_.size()) break;
                const Entry& entry = entries_[i];
                const ClosestPoint at = closest_point_on_triangle(p, entry.a, entry.b, entry.c);
                if (at.distance_squared < best.at.distance_squared ||
                    (at.distance_squared == best.at.distance_squared &&
                     (!best.entry || entry.face < best.entry->face)))
                    best = {&entry, at};
            }
        }
        if (!is_first) break;
        const double farthest = std::sqrt(best.at.distance_squared) * scale_ + tolerance_;
        limit = static_cast<float>(farthest * farthest * (1 + 1e-6));
    }
    const double farthest_needed = (away + std::sqrt(best.at.distance_squared)) * scale_ + tolerance_;
    if (!best.entry || !(farthest_needed < 1)) return std::nullopt;
    return best;
}

FAQEM_INLINE bool NearTriangles::contains(Index face) const {
    return std::any_of(entries_.begin(), entries_.end(), [&](const Entry& e) { return e.face == face; });
}

}  // namespace detail
FAQEM_NAMESPACE_END

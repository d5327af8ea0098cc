#pragma once

#include "faqem/detail/geometry/near_triangles.hpp"

#include <cmath>
#include <limits>
#include <utility>

FAQEM_DETAIL_BEGIN

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
    const std::array<Vector3, 3> at = {(entry.a - origin_) * scale_, (entry.b - origin_) * scale_,
                                       (entry.c - origin_) * scale_};
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
    origin_ = centre_ = centre;
    reach_ = reach;
    scale_ = scale;
    entries_ = std::move(entries);
    groups_.assign((entries_.size() + width - 1) / width, {});
    for (std::size_t i = 0; i < entries_.size(); ++i)
        describe(entries_[i], groups_[i / width], static_cast<int>(i % width));
    fill_last_group();
}

// Lanes without a triangle are far away from every point.
FAQEM_INLINE void NearTriangles::fill_last_group() {
    constexpr double far = 1e15;
    for (std::size_t i = entries_.size(); i < groups_.size() * width; ++i)
        groups_.back().plane.set(static_cast<int>(i % width), Vector3::Zero(), far);
}

// Computes lower bounds of the squared distances, in units of the list.
FAQEM_INLINE NearTriangles::Smallest NearTriangles::find_bounds(const Vector3& p, Bounds& bounds) const {
    const Vector3 offset = (p - origin_) * scale_;
    const auto x = static_cast<float>(offset.x()), y = static_cast<float>(offset.y()),
               z = static_cast<float>(offset.z());
    Lanes first = Lanes::Constant(std::numeric_limits<float>::infinity()), second = first;
    for (std::size_t g = 0; g < groups_.size(); ++g) {
        const auto& [plane, edges] = groups_[g];
        const Lanes height = plane.at(x, y, z);
        const Lanes inside =
            edges[0].at(x, y, z).min(edges[1].at(x, y, z)).min(edges[2].at(x, y, z)).min(0.0f);
        bounds[g] = height * height + inside * inside;
        second = second.min(first.max(bounds[g]));
        first = first.min(bounds[g]);
    }
    Smallest result{first[0], second.minCoeff()};
    for (int lane = 1; lane < width; ++lane) {
        result.second = std::min(result.second, std::max(result.first, first[lane]));
        result.first = std::min(result.first, first[lane]);
    }
    return result;
}

// The bound of triangles within a distance of a point, rounded up.
FAQEM_INLINE float NearTriangles::bound_of(double distance) const {
    const double farthest = distance * scale_ + tolerance_;
    return static_cast<float>(farthest * farthest * (1 + 1e-6));
}

// A distance that triangles with a bound have at least, rounded down.
FAQEM_INLINE double NearTriangles::distance_of(float bound) const {
    return std::max(0.0, (std::sqrt(double{bound}) * (1 - 1e-6) - tolerance_) / scale_);
}

// Calls visit(i) for the entries with a bound from `from` (exclusive) to `to`.
template <class Visit>
void NearTriangles::for_each_within(const Bounds& bounds, float from, float to, Visit&& visit) const {
    for (std::size_t g = 0; g < groups_.size(); ++g) {
        if (!(bounds[g].minCoeff() <= to)) continue;
        const std::size_t lanes = std::min<std::size_t>(width, entries_.size() - g * width);
        for (std::size_t lane = 0; lane < lanes; ++lane) {
            const float bound = bounds[g][static_cast<int>(lane)];
            if (bound <= to && !(bound <= from)) visit(g * width + lane);
        }
    }
}

FAQEM_INLINE std::optional<NearTriangles::Hit> NearTriangles::closest(const Vector3& p,
                                                                      Recent& recent) const {
    const double from_centre = (p - centre_).norm();
    if (entries_.empty() || !is_complete(from_centre, 0)) return std::nullopt;
    Hit best;
    const Entry* known = nullptr;  // evaluated already
    const auto evaluate = [&](const Entry& entry) {
        if (&entry == known) return;
        const ClosestPoint at = closest_point_on_triangle(p, entry.a, entry.b, entry.c);
        if (at.distance_squared < best.at.distance_squared ||
            (at.distance_squared == best.at.distance_squared && best.entry && entry.face < best.entry->face))
            best = {&entry, at};
    };
    const auto found = [&]() -> std::optional<Hit> {
        if (!best.entry || !is_complete(from_centre, std::sqrt(best.at.distance_squared)))
            return std::nullopt;
        return best;
    };
    if (recent.entry < entries_.size()) {
        // The other triangles are at least recent.others minus the distance of the queries away. Without roots:
        // (a + b)^2 <= 2 (a^2 + b^2).
        const double moved_squared = (p - recent.at).squaredNorm(), limit = recent.others * recent.others;
        if (2 * moved_squared < limit) {
            evaluate(entries_[recent.entry]);
            if (2 * (moved_squared + best.at.distance_squared) < limit) return found();
            known = &entries_[recent.entry];
        }
    }
    Bounds bounds;
    const Smallest smallest = find_bounds(p, bounds);
    // First the triangles with the smallest bound, then the others that may be as close as these.
    for_each_within(bounds, -1, smallest.first, [&](std::size_t i) { evaluate(entries_[i]); });
    for_each_within(bounds, smallest.first, bound_of(std::sqrt(best.at.distance_squared)),
                    [&](std::size_t i) { evaluate(entries_[i]); });
    recent = {};
    if (!best.entry) return std::nullopt;
    const auto i = static_cast<std::size_t>(best.entry - entries_.data());
    const bool has_smallest = bounds[i / width][static_cast<int>(i % width)] == smallest.first;
    recent = {i, p, distance_of(has_smallest ? smallest.second : smallest.first), std::nullopt};
    return found();
}

FAQEM_INLINE NearTriangles::Plane NearTriangles::plane_of(const Entry& entry) {
    const Vector3 ab = entry.b - entry.a, ac = entry.c - entry.a;
    const double longest = std::max({ab.squaredNorm(), ac.squaredNorm(), (ac - ab).squaredNorm()});
    const Vector3 area = ab.cross(ac);
    const double twice_area = area.norm();
    Plane result{entry.a, Vector3::Zero(), {Vector3::Zero(), Vector3::Zero()}};
    if (!(twice_area > least_angle_of_bound * longest) || !std::isnormal(1 / twice_area)) return result;
    result.normal = area / twice_area;
    result.axes = {ac.cross(result.normal) / twice_area, result.normal.cross(ab) / twice_area};
    return result;
}

FAQEM_INLINE std::optional<Vec3> NearTriangles::projection(const Vector3& p, Recent& recent) const {
    if (!(recent.entry < entries_.size())) return std::nullopt;
    if (!recent.plane) recent.plane = plane_of(entries_[recent.entry]);
    const Vector3 from_origin = p - recent.plane->origin;
    const double v = from_origin.dot(recent.plane->axes[0]), w = from_origin.dot(recent.plane->axes[1]);
    if (!(v > 0 && w > 0 && v + w < 1)) return std::nullopt;
    const double height = std::abs(from_origin.dot(recent.plane->normal));
    // The other triangles are at least recent.others minus the distance of the queries away.
    if (!((p - recent.at).norm() + height < recent.others)) return std::nullopt;
    if (!is_complete((p - centre_).norm(), height)) return std::nullopt;
    return Vec3{1 - v - w, v, w};
}

FAQEM_INLINE void NearTriangles::narrow(const Vector3& centre, double radius, NearTriangles& to) const {
    to.clear();
    const std::optional<Hit> hit = closest(centre);
    if (!hit) return;
    const double from_centre = (centre - centre_).norm(), distance = std::sqrt(hit->at.distance_squared);
    const double most = reach_ - from_centre - 2 * tolerance_ / scale_;
    const double reach = std::min(usual_reach(distance, radius), most);
    if (!(reach > distance + radius / 2) || !is_complete(from_centre, reach)) return;
    to.origin_ = origin_;
    to.centre_ = centre;
    to.reach_ = reach;
    to.scale_ = scale_;
    to.tolerance_ = tolerance_;
    Bounds bounds;
    find_bounds(centre, bounds);
    for_each_within(bounds, -1, bound_of(reach), [&](std::size_t i) {
        const std::size_t at = to.entries_.size();
        if (at % width == 0) to.groups_.emplace_back();
        to.groups_.back().copy_lane(static_cast<int>(at % width), groups_[i / width],
                                    static_cast<int>(i % width));
        to.entries_.push_back(entries_[i]);
    });
    to.fill_last_group();
}

FAQEM_INLINE bool NearTriangles::contains(Index face) const {
    return std::any_of(entries_.begin(), entries_.end(), [&](const Entry& e) { return e.face == face; });
}

FAQEM_DETAIL_END

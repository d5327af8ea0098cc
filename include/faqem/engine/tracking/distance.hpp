#pragma once
/// \file
/// Squared distances from many points to a triangle or segment, or to the nearest of several.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "faqem/engine/mesh/vector.hpp"
#include "faqem/engine/util/vectorised.hpp"
#include "faqem/export.hpp"

FAQEM_ENGINE_BEGIN

/// Points whose distances are computed at once, in a form that compilers vectorise.
/// \tparam Real  double, or float with positions relative to a point nearby
template <class Real>
struct PointBatch {
    using Point = std::conditional_t<std::is_same_v<Real, double>, Vector3, std::array<float, 3>>;
    using Number = std::conditional_t<std::is_same_v<Real, double>, std::uint64_t, std::uint32_t>;
    static constexpr std::size_t size = 8;
    Real x[size], y[size], z[size];
};

/// A list of points in batches. The last batch repeats its last point.
template <class Real>
class BasicPointBatches {
public:
    using Batch = PointBatch<Real>;
    using Point = typename Batch::Point;

    void clear() { batches_.clear(), count_ = 0; }

    /// Appends a point. Amortised O(1)
    void add(const Point& p) {
        const std::size_t at = count_++ % Batch::size;
        if (at == 0) batches_.emplace_back();
        Batch& last = batches_.back();
        for (std::size_t i = at; i < Batch::size; ++i) last.x[i] = p[0], last.y[i] = p[1], last.z[i] = p[2];
    }

    std::size_t size() const { return count_; }
    std::span<const Batch> batches() const { return batches_; }

    /// Squared distance from p to the nearest point, and its index: the first of several at the same distance; infinity
    /// and no_index if there are no points. O(points)
    std::pair<Real, Index> nearest(const Point& p) const {
        std::pair<Real, Index> best(std::numeric_limits<Real>::infinity(), no_index);
        vectorised([&] {
            Index begin = 0;
            for (const Batch& batch : batches_) {
                Real d[Batch::size];
                for (std::size_t i = 0; i < Batch::size; ++i) {
                    const Real dx = batch.x[i] - p[0], dy = batch.y[i] - p[1], dz = batch.z[i] - p[2];
                    d[i] = dx * dx + dy * dy + dz * dz;
                }
                for (const Real one : d) {
                    if (one < best.first) best = {one, begin};
                    ++begin;
                }
            }
        });
        return best;
    }

private:
    std::vector<Batch> batches_;
    std::size_t count_ = 0;
};
using PointBatches = BasicPointBatches<double>;

/// Squared distance to a triangle, with precomputed terms. The triangle may be a sliver, a segment or a
/// point.
template <class Real>
class BasicTriangleDistance {
public:
    using Batch = PointBatch<Real>;
    using Point = typename Batch::Point;

    BasicTriangleDistance(const Point& a, const Point& b, const Point& c) {
        for (int k = 0; k < 3; ++k)
            a_[k] = a[k], ab_[k] = b[k] - a[k], ac_[k] = c[k] - a[k], bc_[k] = c[k] - b[k];
        ab2_ = dot(ab_, ab_), ac2_ = dot(ac_, ac_), ab_ac_ = dot(ab_, ac_);
        const Real det = ab2_ * ac2_ - ab_ac_ * ab_ac_;
        if (det > min_sine_squared * ab2_ * ac2_) inv_det_ = 1 / det;
        inv_ab2_ = inverse(ab2_), inv_ac2_ = inverse(ac2_), inv_bc2_ = inverse(dot(bc_, bc_));
    }

    /// Squared distance from p to the triangle. O(1)
    Real operator()(const Point& p) const {
        Real result;
        evaluate<1>(&p[0], &p[1], &p[2], &result);
        return result;
    }

    /// Squared distances from the points of a batch to the triangle. O(1)
    void operator()(const Batch& p, Real (&result)[Batch::size]) const {
        evaluate<Batch::size>(p.x, p.y, p.z, result);
    }

    /// Whether the point of the triangle closest to p may be on the side opposite the first corner; true if the sides are
    /// (nearly) parallel. O(1)
    bool is_at_opposite_side(const Point& p) const {
        const Real a[3] = {p[0] - a_[0], p[1] - a_[1], p[2] - a_[2]};
        const Real along_ab = dot(ab_, a), along_ac = dot(ac_, a);
        const Real v = (ac2_ * along_ab - ab_ac_ * along_ac) * inv_det_;
        const Real w = (ab2_ * along_ac - ab_ac_ * along_ab) * inv_det_;
        return !(v + w < 1) || (w < 0 && along_ab >= ab2_) || (v < 0 && along_ac >= ac2_);
    }

private:
    /// If the squared sine of the angle at a is at most this, only the sides are used.
    static constexpr Real min_sine_squared = 64 * std::numeric_limits<Real>::epsilon();
    /// Larger than the rounding errors of v and w for triangles above that limit.
    static constexpr Real barycentric_tolerance = Real(0.05);

    static Real inverse(Real x) { return x > 0 ? 1 / x : 0; }
    static Real dot(const Real (&a)[3], const Real (&b)[3]) {
        return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    }
    // Squared distance from q to the point t * side.
    static Real to_side(const Real (&q)[3], const Real (&side)[3], Real t) {
        const Real d[3] = {q[0] - t * side[0], q[1] - t * side[1], q[2] - t * side[2]};
        return dot(d, d);
    }

    // Squared distances from n points. Compilers vectorise each of the loops, which have no control flow.
    template <std::size_t n>
    void evaluate(const Real* x, const Real* y, const Real* z, Real* result) const {
        Real v[n], w[n], on_ab[n], on_ac[n], on_bc[n], to_plane[n], to_ab[n], to_ac[n], to_bc[n];
        for (std::size_t i = 0; i < n; ++i) {
            const Real a[3] = {x[i] - a_[0], y[i] - a_[1], z[i] - a_[2]};
            const Real b[3] = {a[0] - ab_[0], a[1] - ab_[1], a[2] - ab_[2]};
            const Real along_ab = dot(ab_, a), along_ac = dot(ac_, a);
            v[i] = (ac2_ * along_ab - ab_ac_ * along_ac) * inv_det_;
            w[i] = (ab2_ * along_ac - ab_ac_ * along_ab) * inv_det_;
            on_ab[i] = along_ab * inv_ab2_, on_ac[i] = along_ac * inv_ac2_, on_bc[i] = dot(bc_, b) * inv_bc2_;
        }
        for (Real* t : {on_ab, on_ac, on_bc}) {
            for (std::size_t i = 0; i < n; ++i) t[i] = t[i] < 0 ? 0 : t[i];
            for (std::size_t i = 0; i < n; ++i) t[i] = t[i] > 1 ? 1 : t[i];
        }
        for (std::size_t i = 0; i < n; ++i) {
            const Real a[3] = {x[i] - a_[0], y[i] - a_[1], z[i] - a_[2]};
            const Real b[3] = {a[0] - ab_[0], a[1] - ab_[1], a[2] - ab_[2]};
            const Real d[3] = {a[0] - v[i] * ab_[0] - w[i] * ac_[0], a[1] - v[i] * ab_[1] - w[i] * ac_[1],
                               a[2] - v[i] * ab_[2] - w[i] * ac_[2]};
            to_plane[i] = dot(d, d);
            to_ab[i] = to_side(a, ab_, on_ab[i]);
            to_ac[i] = to_side(a, ac_, on_ac[i]);
            to_bc[i] = to_side(b, bc_, on_bc[i]);
        }
        // Outside, the closest point is on a side beyond which the point lies. Sides for which this is uncertain due to
        // rounding are tested as well.
        constexpr Real infinity = std::numeric_limits<Real>::infinity();
        for (std::size_t i = 0; i < n; ++i) {
            const Real sum = v[i] + w[i];
            const Real ab = w[i] >= barycentric_tolerance ? infinity : to_ab[i];
            const Real ac = v[i] >= barycentric_tolerance ? infinity : to_ac[i];
            const Real bc = sum <= 1 - barycentric_tolerance ? infinity : to_bc[i];
            Real outside = ac < ab ? ac : ab;
            outside = bc < outside ? bc : outside;
            Real nearest = sum <= 1 ? to_plane[i] : outside;
            nearest = w[i] >= 0 ? nearest : outside;
            result[i] = v[i] >= 0 ? nearest : outside;
        }
    }

    Real a_[3], ab_[3], ac_[3], bc_[3];
    Real ab2_ = 0, ac2_ = 0, ab_ac_ = 0;
    Real inv_ab2_ = 0, inv_ac2_ = 0, inv_bc2_ = 0;           // reciprocals; 0 if undefined
    Real inv_det_ = std::numeric_limits<Real>::quiet_NaN();  // if it stays, no condition on v and w holds
};
using TriangleDistance = BasicTriangleDistance<double>;

/// Largest of `at_least` and the squared distances of points from their respective nearest triangle (one-sided
/// Hausdorff distance). Points in succession often have the same nearest triangle, so the last one is tested first; a
/// batch is done as soon as all its points are within the current maximum. O(points times triangles) at worst
/// \param triangles  at least one
template <class Real>
Real farthest_squared(const BasicPointBatches<Real>& points,
                      const std::vector<BasicTriangleDistance<Real>>& triangles, Real at_least) {
    Real worst = at_least;
    vectorised([&] {
        std::size_t first = 0;
        using Batch = PointBatch<Real>;
        for (const Batch& batch : points.batches()) {
            Real nearest[Batch::size], d[Batch::size];
            std::fill(std::begin(nearest), std::end(nearest), std::numeric_limits<Real>::infinity());
            Real farthest = std::numeric_limits<Real>::infinity();
            for (std::size_t j = 0; j < triangles.size() && farthest > worst; ++j) {
                const std::size_t k = first + j < triangles.size() ? first + j : first + j - triangles.size();
                triangles[k](batch, d);
                for (std::size_t i = 0; i < Batch::size; ++i)
                    nearest[i] = d[i] < nearest[i] ? d[i] : nearest[i];
                farthest = *std::max_element(std::begin(nearest), std::end(nearest));
                if (farthest <= worst) first = k;
            }
            worst = std::max(worst, farthest);
        }
    });
    return worst;
}

/// Calls visit(i, k) for each point i: triangle k is the nearest one, the first of several at the same distance.
/// O(points times triangles)
/// \param triangles  at least one
template <class Real, class Visit>
void for_each_nearest(const BasicPointBatches<Real>& points,
                      const std::vector<BasicTriangleDistance<Real>>& triangles, Visit&& visit) {
    vectorised([&] {
        std::size_t begin = 0;
        using Batch = PointBatch<Real>;
        for (const Batch& batch : points.batches()) {
            Real nearest[Batch::size], d[Batch::size];
            typename Batch::Number at[Batch::size] = {};
            std::fill(std::begin(nearest), std::end(nearest), std::numeric_limits<Real>::infinity());
            for (std::size_t k = 0; k < triangles.size(); ++k) {
                triangles[k](batch, d);
                for (std::size_t i = 0; i < Batch::size; ++i) {
                    at[i] = d[i] < nearest[i] ? static_cast<typename Batch::Number>(k) : at[i];
                    nearest[i] = d[i] < nearest[i] ? d[i] : nearest[i];
                }
            }
            for (std::size_t i = 0; i < Batch::size && begin < points.size(); ++i) visit(begin++, at[i]);
        }
    });
}

/// Squared distance to a segment, with precomputed terms. A segment of length 0 is a point.
class SegmentDistance {
public:
    SegmentDistance(const Vector3& a, const Vector3& b) : a_(a), ab_(b - a) {
        const double square = ab_.squaredNorm();
        if (square > 0) inv_square_ = 1 / square;
    }

    /// Squared distance from p to the segment. O(1)
    double operator()(const Vector3& p) const {
        const Vector3 from_a = p - a_;
        return (from_a - std::clamp(ab_.dot(from_a) * inv_square_, 0.0, 1.0) * ab_).squaredNorm();
    }

private:
    Vector3 a_, ab_;
    double inv_square_ = 0;
};

/// Index of the segment nearest to a point. O(segments)
/// \return the first one of several at the same distance; 0 if there are no segments
inline std::size_t nearest_index(const std::vector<SegmentDistance>& segments, const Vector3& p) {
    std::size_t at = 0;
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < segments.size(); ++k) {
        const double d = segments[k](p);
        if (d < nearest) nearest = d, at = k;
    }
    return at;
}

/// Largest squared distance of a set of points from their respective nearest segment; see farthest_squared().
class FarthestPoint {
public:
    /// \param segments  at least one; borrowed, must outlive this object
    explicit FarthestPoint(const std::vector<SegmentDistance>& segments) : segments_(segments) {}

    /// Adds a point. O(segments) at worst, typically one distance
    void add(const Vector3& p) {
        double nearest = std::numeric_limits<double>::infinity();
        for (std::size_t j = 0; j < segments_.size() && nearest > worst_; ++j) {
            const std::size_t k = first_ + j < segments_.size() ? first_ + j : first_ + j - segments_.size();
            const double d = segments_[k](p);
            if (d < nearest) nearest = d;
            if (d <= worst_) first_ = k;
        }
        if (nearest > worst_) worst_ = nearest;
    }

    /// The largest squared distance of the points added so far; 0 without points.
    double squared_distance() const { return worst_; }

private:
    const std::vector<SegmentDistance>& segments_;
    double worst_ = 0;
    std::size_t first_ = 0;
};

FAQEM_ENGINE_END

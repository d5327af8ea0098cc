#pragma once
/// \file
/// Squared distances from many points to a triangle or segment, or to the nearest of several.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "faqem/engine/mesh/vector.hpp"
#include "faqem/engine/util/vectorised.hpp"
#include "faqem/export.hpp"

FAQEM_NAMESPACE_BEGIN
namespace engine {

/// Points whose distances are computed at once, in a form that compilers vectorise.
struct PointBatch {
    static constexpr std::size_t size = 8;
    double x[size], y[size], z[size];
};

/// A list of points in batches. The last batch repeats its last point.
class PointBatches {
public:
    void clear() { batches_.clear(), count_ = 0; }

    /// Appends a point. Amortised O(1)
    void add(const Vector3& p) {
        const std::size_t at = count_++ % PointBatch::size;
        if (at == 0) batches_.emplace_back();
        PointBatch& last = batches_.back();
        for (std::size_t i = at; i < PointBatch::size; ++i)
            last.x[i] = p[0], last.y[i] = p[1], last.z[i] = p[2];
    }

    std::size_t size() const { return count_; }
    std::span<const PointBatch> batches() const { return batches_; }

    /// Squared distance from p to the nearest point, and its index: the first of several at the same distance; infinity
    /// and no_index if there are no points. O(points)
    std::pair<double, Index> nearest(const Vector3& p) const {
        std::pair<double, Index> best(std::numeric_limits<double>::infinity(), no_index);
        vectorised([&] {
            Index begin = 0;
            for (const PointBatch& batch : batches_) {
                double d[PointBatch::size];
                for (std::size_t i = 0; i < PointBatch::size; ++i) {
                    const double dx = batch.x[i] - p[0], dy = batch.y[i] - p[1], dz = batch.z[i] - p[2];
                    d[i] = dx * dx + dy * dy + dz * dz;
                }
                for (const double one : d) {
                    if (one < best.first) best = {one, begin};
                    ++begin;
                }
            }
        });
        return best;
    }

private:
    std::vector<PointBatch> batches_;
    std::size_t count_ = 0;
};

/// Squared distance to a triangle, with precomputed terms. The triangle may be a sliver, a segment or a
/// point.
class TriangleDistance {
public:
    TriangleDistance(const Vector3& a, const Vector3& b, const Vector3& c) {
        for (int k = 0; k < 3; ++k)
            a_[k] = a[k], ab_[k] = b[k] - a[k], ac_[k] = c[k] - a[k], bc_[k] = c[k] - b[k];
        ab2_ = dot(ab_, ab_), ac2_ = dot(ac_, ac_), ab_ac_ = dot(ab_, ac_);
        const double det = ab2_ * ac2_ - ab_ac_ * ab_ac_;
        if (det > min_sine_squared * ab2_ * ac2_) inv_det_ = 1 / det;
        inv_ab2_ = inverse(ab2_), inv_ac2_ = inverse(ac2_), inv_bc2_ = inverse(dot(bc_, bc_));
    }

    /// Squared distance from p to the triangle. O(1)
    double operator()(const Vector3& p) const {
        double result;
        evaluate<1>(&p[0], &p[1], &p[2], &result);
        return result;
    }

    /// Squared distances from the points of a batch to the triangle. O(1)
    void operator()(const PointBatch& p, double (&result)[PointBatch::size]) const {
        evaluate<PointBatch::size>(p.x, p.y, p.z, result);
    }

    /// Whether the point of the triangle closest to p may be on the side opposite the first corner; true if the sides are
    /// (nearly) parallel. O(1)
    bool is_at_opposite_side(const Vector3& p) const {
        const double a[3] = {p[0] - a_[0], p[1] - a_[1], p[2] - a_[2]};
        const double along_ab = dot(ab_, a), along_ac = dot(ac_, a);
        const double v = (ac2_ * along_ab - ab_ac_ * along_ac) * inv_det_;
        const double w = (ab2_ * along_ac - ab_ac_ * along_ab) * inv_det_;
        return !(v + w < 1) || (w < 0 && along_ab >= ab2_) || (v < 0 && along_ac >= ac2_);
    }

private:
    /// If the squared sine of the angle at a is at most this, only the sides are used.
    static constexpr double min_sine_squared = 1e-14;
    /// Larger than the rounding errors of v and w for triangles above that limit.
    static constexpr double barycentric_tolerance = 0.05;

    static double inverse(double x) { return x > 0 ? 1 / x : 0; }
    static double dot(const double (&a)[3], const double (&b)[3]) {
        return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    }
    // Squared distance from q to the point t * side.
    static double to_side(const double (&q)[3], const double (&side)[3], double t) {
        const double d[3] = {q[0] - t * side[0], q[1] - t * side[1], q[2] - t * side[2]};
        return dot(d, d);
    }

    // Squared distances from n points. Compilers vectorise each of the loops, which have no control flow.
    template <std::size_t n>
    void evaluate(const double* x, const double* y, const double* z, double* result) const {
        double v[n], w[n], on_ab[n], on_ac[n], on_bc[n], to_plane[n], to_ab[n], to_ac[n], to_bc[n];
        for (std::size_t i = 0; i < n; ++i) {
            const double a[3] = {x[i] - a_[0], y[i] - a_[1], z[i] - a_[2]};
            const double b[3] = {a[0] - ab_[0], a[1] - ab_[1], a[2] - ab_[2]};
            const double along_ab = dot(ab_, a), along_ac = dot(ac_, a);
            v[i] = (ac2_ * along_ab - ab_ac_ * along_ac) * inv_det_;
            w[i] = (ab2_ * along_ac - ab_ac_ * along_ab) * inv_det_;
            on_ab[i] = along_ab * inv_ab2_, on_ac[i] = along_ac * inv_ac2_, on_bc[i] = dot(bc_, b) * inv_bc2_;
        }
        for (double* t : {on_ab, on_ac, on_bc}) {
            for (std::size_t i = 0; i < n; ++i) t[i] = t[i] < 0 ? 0 : t[i];
            for (std::size_t i = 0; i < n; ++i) t[i] = t[i] > 1 ? 1 : t[i];
        }
        for (std::size_t i = 0; i < n; ++i) {
            const double a[3] = {x[i] - a_[0], y[i] - a_[1], z[i] - a_[2]};
            const double b[3] = {a[0] - ab_[0], a[1] - ab_[1], a[2] - ab_[2]};
            const double d[3] = {a[0] - v[i] * ab_[0] - w[i] * ac_[0], a[1] - v[i] * ab_[1] - w[i] * ac_[1],
                                 a[2] - v[i] * ab_[2] - w[i] * ac_[2]};
            to_plane[i] = dot(d, d);
            to_ab[i] = to_side(a, ab_, on_ab[i]);
            to_ac[i] = to_side(a, ac_, on_ac[i]);
            to_bc[i] = to_side(b, bc_, on_bc[i]);
        }
        // Outside, the closest point is on a side beyond which the point lies. Sides for which this is uncertain due to
        // rounding are tested as well.
        constexpr double infinity = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < n; ++i) {
            const double sum = v[i] + w[i];
            const double ab = w[i] >= barycentric_tolerance ? infinity : to_ab[i];
            const double ac = v[i] >= barycentric_tolerance ? infinity : to_ac[i];
            const double bc = sum <= 1 - barycentric_tolerance ? infinity : to_bc[i];
            double outside = ac < ab ? ac : ab;
            outside = bc < outside ? bc : outside;
            double nearest = sum <= 1 ? to_plane[i] : outside;
            nearest = w[i] >= 0 ? nearest : outside;
            result[i] = v[i] >= 0 ? nearest : outside;
        }
    }

    double a_[3], ab_[3], ac_[3], bc_[3];
    double ab2_ = 0, ac2_ = 0, ab_ac_ = 0;
    double inv_ab2_ = 0, inv_ac2_ = 0, inv_bc2_ = 0;             // reciprocals; 0 if undefined
    double inv_det_ = std::numeric_limits<double>::quiet_NaN();  // if it stays, no condition on v and w holds
};

/// Largest of `at_least` and the squared distances of points from their respective nearest triangle (one-sided
/// Hausdorff distance). Points in succession often have the same nearest triangle, so the last one is tested first; a
/// batch is done as soon as all its points are within the current maximum. O(points times triangles) at worst
/// \param triangles  at least one
inline double farthest_squared(const PointBatches& points, std::span<const TriangleDistance> triangles,
                               double at_least) {
    double worst = at_least;
    vectorised([&] {
        std::size_t first = 0;
        for (const PointBatch& batch : points.batches()) {
            double nearest[PointBatch::size], d[PointBatch::size];
            std::fill(std::begin(nearest), std::end(nearest), std::numeric_limits<double>::infinity());
            double farthest = std::numeric_limits<double>::infinity();
            for (std::size_t j = 0; j < triangles.size() && farthest > worst; ++j) {
                const std::size_t k = first + j < triangles.size() ? first + j : first + j - triangles.size();
                triangles[k](batch, d);
                for (std::size_t i = 0; i < PointBatch::size; ++i)
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
template <class Visit>
void for_each_nearest(const PointBatches& points, std::span<const TriangleDistance> triangles,
                      Visit&& visit) {
    vectorised([&] {
        std::size_t begin = 0;
        for (const PointBatch& batch : points.batches()) {
            double nearest[PointBatch::size], d[PointBatch::size];
            std::uint64_t at[PointBatch::size] = {};
            std::fill(std::begin(nearest), std::end(nearest), std::numeric_limits<double>::infinity());
            for (std::size_t k = 0; k < triangles.size(); ++k) {
                triangles[k](batch, d);
                for (std::size_t i = 0; i < PointBatch::size; ++i) {
                    at[i] = d[i] < nearest[i] ? k : at[i];
                    nearest[i] = d[i] < nearest[i] ? d[i] : nearest[i];
                }
            }
            for (std::size_t i = 0; i < PointBatch::size && begin < points.size(); ++i) visit(begin++, at[i]);
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

}  // namespace engine
FAQEM_NAMESPACE_END

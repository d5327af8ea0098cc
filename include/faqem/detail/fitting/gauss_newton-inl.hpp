#pragma once

#include "faqem/detail/fitting/gauss_newton.hpp"

#include <algorithm>
#include <cmath>

#include "faqem/detail/base/buckets.hpp"
#include "faqem/engine/quadric/quadric.hpp"

FAQEM_DETAIL_BEGIN

inline constexpr double point_to_plane_weight = 0.9;
/// Distances are weighted as if they were at least this fraction of the mean, so that points with small
/// residuals keep the vertices in position.
inline constexpr double min_distance_share = 0.1;
/// Damping of a vertex, as a fraction of its own diagonal block.
inline constexpr double damping = 0.02;
/// Additional damping as a fraction of the mean diagonal block, for vertices with few correspondences. In the
/// mean, the blocks of fixed vertices count as zero.
inline constexpr double mean_damping = 2e-4;
/// Conjugate gradients end after this many iterations, or when the residual is below this fraction of the
/// right-hand side.
inline constexpr int max_iterations = 60;
inline constexpr double residual_tolerance = 1e-3;

using engine::Symmetric3;

/// Quadratic form of one residual: the weighted point-to-plane and point-to-point terms.
/// \param n  unit normal
inline Symmetric3 residual_metric(const Vector3& n, double weight) {
    const double a = weight * point_to_plane_weight, b = weight * (1 - point_to_plane_weight);
    return {a * n[0] * n[0] + b, a * n[0] * n[1], a * n[0] * n[2],
            a * n[1] * n[1] + b, a * n[1] * n[2], a * n[2] * n[2] + b};
}

/// Contribution of one face to the system.
struct FaceSystem {
    std::array<Symmetric3, 3> diagonal;      ///< block of corner k
    std::array<Symmetric3, 3> off_diagonal;  ///< block of corners k and k + 1 (modulo 3)
    std::array<Vector3, 3> rhs = {Vector3::Zero(), Vector3::Zero(), Vector3::Zero()};
};

/// pow(x, power). std::pow, which took 5% of the time of preset `best`, rounds as the C library does, which may depend on
/// the processor; the powers that are used do without.
inline double power_of(double x, double power) {
    if (power == 4) return (x * x) * (x * x);
    return power == 0.5 ? std::sqrt(x) : std::pow(x, power);
}

inline void add(const Correspondence& correspondence, double weight, FaceSystem& face) {
    const Symmetric3 metric = residual_metric(correspondence.normal, weight);
    const Vector3 weighted_residual = metric.apply(correspondence.residual);
    const Vec3& share = correspondence.sample.barycentric;
    for (std::size_t k = 0; k < 3; ++k) {
        face.rhs[k] += share[k] * weighted_residual;
        face.diagonal[k].add(metric, share[k] * share[k]);
        face.off_diagonal[k].add(metric, share[k] * share[(k + 1) % 3]);
    }
}

/// Computes the contributions of all faces. Distances are normalized by their mean.
inline std::vector<FaceSystem> face_systems(std::size_t faces,
                                            std::span<const Correspondence> correspondences, double power,
                                            const RunContext& context) {
    double mean = 0;
    for (const Correspondence& correspondence : correspondences) mean += correspondence.residual.norm();
    mean /= static_cast<double>(std::max<std::size_t>(correspondences.size(), 1));
    const Buckets<std::size_t> by_face(faces, [&](auto&& put) {
        for (std::size_t i = 0; i < correspondences.size(); ++i) put(correspondences[i].sample.face, i);
    });
    std::vector<FaceSystem> all(faces);
    parallel_each(faces, 512, context, [&](std::size_t f) {
        for (const std::size_t i : by_face[f]) {
            const double distance = std::max(correspondences[i].residual.norm(), min_distance_share * mean);
            add(correspondences[i], distance > 0 ? power_of(distance / mean, power) : 0, all[f]);
        }
    });
    return all;
}

/// The normal equations of a step. Rows and columns of fixed vertices are zero.
class NormalEquations {
public:
    NormalEquations(std::span<const Triangle> triangles, std::span<const Correspondence> correspondences,
                    std::span<const std::uint8_t> fixed, double power, const RunContext& context)
        : triangles_(triangles),
          faces_(face_systems(triangles.size(), correspondences, power, context)),
          free_(fixed.size()),
          diagonal_(fixed.size()),
          inverse_(fixed.size()),
          rhs_(fixed.size(), Vector3::Zero()) {
        for (std::size_t v = 0; v < free_.size(); ++v) free_[v] = !fixed[v];
        for (std::size_t f = 0; f < faces_.size(); ++f) {
            if (triangles_[f][0] == no_index) continue;
            for (std::size_t k = 0; k < 3; ++k) {
                diagonal_[triangles_[f][k]].add(faces_[f].diagonal[k], 1);
                rhs_[triangles_[f][k]] += faces_[f].rhs[k];
            }
        }
        apply_damping();
    }

    const std::vector<Vector3>& rhs() const { return rhs_; }

    void multiply(std::span<const Vector3> x, std::vector<Vector3>& result) const {
        for (std::size_t v = 0; v < x.size(); ++v) result[v] = diagonal_[v].apply(x[v]);
        for (std::size_t f = 0; f < faces_.size(); ++f) {
            const Triangle& t = triangles_[f];
            if (t[0] == no_index) continue;
            for (std::size_t k = 0; k < 3; ++k) {
                const Index v = t[k], w = t[(k + 1) % 3];
                result[v] += faces_[f].off_diagonal[k].apply(x[w]);
                result[w] += faces_[f].off_diagonal[k].apply(x[v]);
            }
        }
        for (std::size_t v = 0; v < x.size(); ++v)
            if (!free_[v]) result[v].setZero();
    }

    /// Block-Jacobi preconditioner: multiplies by the inverses of the diagonal blocks.
    void precondition(std::span<const Vector3> x, std::vector<Vector3>& result) const {
        for (std::size_t v = 0; v < x.size(); ++v) result[v] = inverse_[v].apply(x[v]);
    }

private:
    void apply_damping() {
        double whole_trace = 0;
        for (std::size_t v = 0; v < free_.size(); ++v)
            if (free_[v]) whole_trace += diagonal_[v].trace();
        const double mean_trace = whole_trace / static_cast<double>(std::max<std::size_t>(free_.size(), 1));
        for (std::size_t v = 0; v < free_.size(); ++v) {
            if (!free_[v]) {
                rhs_[v].setZero();
                continue;
            }
            const double diagonal_damping = (damping * diagonal_[v].trace() + mean_damping * mean_trace) / 3;
            diagonal_[v].add(Symmetric3{1, 0, 0, 1, 0, 1}, diagonal_damping > 0 ? diagonal_damping : 1.0);
            inverse_[v] = diagonal_[v].inverse();
        }
    }

    std::span<const Triangle> triangles_;
    std::vector<FaceSystem> faces_;
    std::vector<std::uint8_t> free_;
    std::vector<Symmetric3> diagonal_;
    std::vector<Symmetric3> inverse_;
    std::vector<Vector3> rhs_;
};

inline double dot(std::span<const Vector3> a, std::span<const Vector3> b) {
    double sum = 0;
    for (std::size_t v = 0; v < a.size(); ++v) sum += a[v].dot(b[v]);
    return sum;
}

FAQEM_INLINE std::vector<Vector3> gauss_newton_step(std::span<const Triangle> triangles,
                                                    std::span<const Correspondence> correspondences,
                                                    std::span<const std::uint8_t> fixed, double power,
                                                    const RunContext& context) {
    const NormalEquations system(triangles, correspondences, fixed, power, context);
    const std::size_t size = fixed.size();
    std::vector<Vector3> x(size, Vector3::Zero()), residual = system.rhs(), direction(size),
                                                   matrix_direction(size), preconditioned(size);
    system.precondition(residual, preconditioned);
    direction = preconditioned;
    double residual_product = dot(residual, preconditioned);
    const double enough = residual_tolerance * residual_tolerance * dot(residual, residual);
    for (int i = 0; i < max_iterations && dot(residual, residual) > enough; ++i) {
        context.check_now();
        system.multiply(direction, matrix_direction);
        const double length = residual_product / dot(direction, matrix_direction);
        for (std::size_t v = 0; v < size; ++v) {
            x[v] += length * direction[v];
            residual[v] -= length * matrix_direction[v];
        }
        system.precondition(residual, preconditioned);
        const double next = dot(residual, preconditioned);
        for (std::size_t v = 0; v < size; ++v)
            direction[v] = preconditioned[v] + (next / residual_product) * direction[v];
        residual_product = next;
    }
    return x;
}

FAQEM_DETAIL_END

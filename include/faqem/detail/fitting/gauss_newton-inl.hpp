#pragma once

#include "faqem/export.hpp"
#include "faqem/detail/fitting/gauss_newton.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "faqem/detail/base/bucketed.hpp"
#include "faqem/detail/base/parallel.hpp"

FAQEM_NAMESPACE_BEGIN
namespace detail {

using engine::Vector3;
using Matrix3 = Eigen::Matrix3d;

inline constexpr double along_normal = 0.9;
/// Distances below this share of the mean weigh as if they were that: what fits holds the vertex too.
inline constexpr double least_distance = 0.1;
/// Share of its own weight by which a vertex is held.
inline constexpr double damping = 0.02;
/// The same, as a share of the mean weight: for vertices that hardly a pull tells about.
inline constexpr double mean_damping = 2e-4;
/// Of conjugate gradients: at most so many iterations, until the residual is this share of the right side.
inline constexpr int most_iterations = 60;
inline constexpr double least_residual = 1e-3;

/// A symmetric matrix.
struct Symmetric3 {
    double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;

    void add(double factor, const Symmetric3& m) {
        xx += factor * m.xx, xy += factor * m.xy, xz += factor * m.xz;
        yy += factor * m.yy, yz += factor * m.yz, zz += factor * m.zz;
    }
    Vector3 operator*(const Vector3& v) const {
        return {xx * v[0] + xy * v[1] + xz * v[2], xy * v[0] + yy * v[1] + yz * v[2],
                xz * v[0] + yz * v[1] + zz * v[2]};
    }
    double trace() const { return xx + yy + zz; }
    Matrix3 matrix() const {
        Matrix3 m;
        m << xx, xy, xz, xy, yy, yz, xz, yz, zz;
        return m;
    }
};

/// Of one pull: how much its gap counts in each direction.
inline Symmetric3 metric_along(const Vector3& n, double weight) {
    const double a = weight * along_normal, b = weight * (1 - along_normal);
    return {a * n[0] * n[0] + b, a * n[0] * n[1], a * n[0] * n[2],
            a * n[1] * n[1] + b, a * n[1] * n[2], a * n[2] * n[2] + b};
}

/// The part of the system that belongs to one face.
struct FaceSystem {
    std::array<Symmetric3, 3> own;    ///< of each corner with itself
    std::array<Symmetric3, 3> other;  ///< of corner k with corner k + 1
    std::array<Vector3, 3> right = {Vector3::Zero(), Vector3::Zero(), Vector3::Zero()};
};

/// Of the power asked for most std::pow took 5% of all the time of `best`.
inline double raised(double x, double power) { return power == 0.5 ? std::sqrt(x) : std::pow(x, power); }

inline void add(const Pull& pull, double weight, FaceSystem& face) {
    const Symmetric3 metric = metric_along(pull.normal, weight);
    const Vector3 wanted = metric * pull.gap;
    const Vec3& share = pull.spot.weight;
    for (std::size_t k = 0; k < 3; ++k) {
        face.right[k] += share[k] * wanted;
        face.own[k].add(share[k] * share[k], metric);
        face.other[k].add(share[k] * share[(k + 1) % 3], metric);
    }
}

inline std::vector<FaceSystem> face_systems(std::size_t faces, std::span<const Pull> pulls, double power,
                                     Workers workers) {
    double mean = 0;
    for (const Pull& pull : pulls) {
        workers.poll();
        mean += pull.gap.norm();
    }
    mean /= static_cast<double>(std::max<std::size_t>(pulls.size(), 1));
    const Buckets<std::size_t> by_face(faces, [&](auto&& put) {
        for (std::size_t i = 0; i < pulls.size(); ++i) {
            workers.poll();
            put(pulls[i].spot.face, i);
        }
    });
    std::vector<FaceSystem> all(faces);
    parallel_blocks(faces, 512, workers, [&](std::size_t begin, std::size_t end) {
        for (std::size_t f = begin; f < end; ++f) {
            for (const std::size_t i : by_face[f]) {
                const double distance = std::max(pulls[i].gap.norm(), least_distance * mean);
                add(pulls[i], distance > 0 ? raised(distance / mean, power) : 0, all[f]);
            }
        }
    });
    return all;
}

/// The matrix of the system: rows and columns of fixed vertices are left out.
class System {
public:
    System(std::span<const Triangle> triangles, std::span<const Pull> pulls,
           std::span<const std::uint8_t> fixed, double power, Workers workers)
        : triangles_(triangles),
          faces_(face_systems(triangles.size(), pulls, power, workers)),
          free_(fixed.size()),
          own_(fixed.size()),
          inverse_(fixed.size(), Matrix3::Zero()),
          right_(fixed.size(), Vector3::Zero()),
          poll_(workers.poll) {
        for (std::size_t v = 0; v < free_.size(); ++v) free_[v] = !fixed[v];
        for (std::size_t f = 0; f < faces_.size(); ++f) {
            poll_();
            if (triangles_[f][0] == no_index) continue;
            for (std::size_t k = 0; k < 3; ++k) {
                own_[triangles_[f][k]].add(1, faces_[f].own[k]);
                right_[triangles_[f][k]] += faces_[f].right[k];
            }
        }
        hold();
    }

    const std::vector<Vector3>& right() const { return right_; }

    void multiply(std::span<const Vector3> x, std::vector<Vector3>& result) const {
        for (std::size_t v = 0; v < x.size(); ++v) result[v] = own_[v] * x[v];
        for (std::size_t f = 0; f < faces_.size(); ++f) {
            poll_();
            const Triangle& t = triangles_[f];
            if (t[0] == no_index) continue;
            for (std::size_t k = 0; k < 3; ++k) {
                const Index v = t[k], w = t[(k + 1) % 3];
                result[v] += faces_[f].other[k] * x[w];
                result[w] += faces_[f].other[k] * x[v];
            }
        }
        for (std::size_t v = 0; v < x.size(); ++v) {
            if (!free_[v]) result[v].setZero();
        }
    }

    /// The inverse of the blocks on the diagonal.
    void precondition(std::span<const Vector3> x, std::vector<Vector3>& result) const {
        for (std::size_t v = 0; v < x.size(); ++v) result[v] = inverse_[v] * x[v];
    }

private:
    void hold() {
        double whole_trace = 0;
        for (std::size_t v = 0; v < free_.size(); ++v) {
            if (free_[v]) whole_trace += own_[v].trace();
        }
        const double mean_trace = whole_trace / static_cast<double>(std::max<std::size_t>(free_.size(), 1));
        for (std::size_t v = 0; v < free_.size(); ++v) {
            poll_();
            if (!free_[v]) {
                right_[v].setZero();
                continue;
            }
            const double hold = (damping * own_[v].trace() + mean_damping * mean_trace) / 3;
            own_[v].add(hold > 0 ? hold : 1.0, {1, 0, 0, 1, 0, 1});
            inverse_[v] = own_[v].matrix().inverse();
        }
    }

    std::span<const Triangle> triangles_;
    std::vector<FaceSystem> faces_;
    std::vector<std::uint8_t> free_;
    std::vector<Symmetric3> own_;
    std::vector<Matrix3> inverse_;
    std::vector<Vector3> right_;
    Poll poll_;
};

inline double dot(std::span<const Vector3> a, std::span<const Vector3> b) {
    double sum = 0;
    for (std::size_t v = 0; v < a.size(); ++v) sum += a[v].dot(b[v]);
    return sum;
}

FAQEM_INLINE std::vector<Vector3> fitting_step(std::span<const Triangle> triangles, std::span<const Pull> pulls,
                                  std::span<const std::uint8_t> fixed, double power, Workers workers) {
    const System system(triangles, pulls, fixed, power, workers);
    const std::size_t size = fixed.size();
    std::vector<Vector3> x(size, Vector3::Zero()), residual = system.right(), direction(size), along(size),
                                                   eased(size);
    system.precondition(residual, eased);
    direction = eased;
    double height = dot(residual, eased);
    const double enough = least_residual * least_residual * dot(residual, residual);
    for (int i = 0; i < most_iterations && dot(residual, residual) > enough; ++i) {
        system.multiply(direction, along);
        const double length = height / dot(direction, along);
        for (std::size_t v = 0; v < size; ++v) {
            x[v] += length * direction[v];
            residual[v] -= length * along[v];
        }
        system.precondition(residual, eased);
        const double next = dot(residual, eased);
        for (std::size_t v = 0; v < size; ++v) direction[v] = eased[v] + (next / height) * direction[v];
        height = next;
    }
    return x;
}

}  // namespace detail
FAQEM_NAMESPACE_END

#include "fit.hpp"

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>

namespace faqem::detail {

namespace {

using engine::Vector3;
using Matrix3 = Eigen::Matrix3d;
using Sparse = Eigen::SparseMatrix<double>;

constexpr double along_normal = 0.9;
/// Distances below this share of the mean weigh as if they were that: what fits holds the vertex too.
constexpr double least_distance = 0.1;
/// Share of its own weight by which a vertex is held.
constexpr double damping = 0.02;
/// The same, as a share of the mean weight: for vertices that hardly a pull tells about.
constexpr double mean_damping = 2e-4;

/// The part of the system that belongs to one face: blocks of corner pairs and right-hand sides of corners.
struct FaceSystem {
    std::array<std::array<Matrix3, 3>, 3> matrix;
    std::array<Vector3, 3> right;
    FaceSystem() {
        for (auto& row : matrix) row.fill(Matrix3::Zero());
        right.fill(Vector3::Zero());
    }
};

std::vector<FaceSystem> face_systems(std::size_t faces, std::span<const Pull> pulls, double power) {
    std::vector<FaceSystem> all(faces);
    double mean = 0;
    for (const Pull& pull : pulls) mean += pull.gap.norm();
    mean /= static_cast<double>(std::max<std::size_t>(pulls.size(), 1));
    for (const Pull& pull : pulls) {
        const double distance = std::max(pull.gap.norm(), least_distance * mean);
        const double w = distance > 0 ? std::pow(distance / mean, power) : 0;
        const Matrix3 metric = w * (along_normal * pull.normal * pull.normal.transpose() +
                                    (1 - along_normal) * Matrix3::Identity());
        const Vector3 wanted = metric * pull.gap;
        FaceSystem& face = all[pull.spot.face];
        for (std::size_t j = 0; j < 3; ++j) {
            face.right[j] += pull.spot.weight[j] * wanted;
            for (std::size_t k = 0; k < 3; ++k) {
                face.matrix[j][k] += (pull.spot.weight[j] * pull.spot.weight[k]) * metric;
            }
        }
    }
    return all;
}

/// Collects the entries of the sparse system.
struct Assembly {
    std::vector<Eigen::Triplet<double>> entries;
    Eigen::VectorXd right;

    explicit Assembly(std::size_t vertices)
        : right(Eigen::VectorXd::Zero(3 * static_cast<Eigen::Index>(vertices))) {}
    void add(Index v, Index w, const Matrix3& m) {
        for (int r = 0; r < 3; ++r) {
            for (int c = 0; c < 3; ++c) entries.emplace_back(3 * v + r, 3 * w + c, m(r, c));
        }
    }
};

}  // namespace

std::vector<Vector3> fitting_step(std::span<const Triangle> triangles, std::span<const Pull> pulls,
                                  std::span<const std::uint8_t> fixed, double power) {
    const std::vector<FaceSystem> faces = face_systems(triangles.size(), pulls, power);
    Assembly system(fixed.size());
    std::vector<double> trace(fixed.size(), 0);
    double whole_trace = 0;
    for (std::size_t f = 0; f < faces.size(); ++f) {
        const Triangle& t = triangles[f];
        if (t[0] == no_index) continue;
        for (std::size_t j = 0; j < 3; ++j) {
            if (fixed[t[j]]) continue;
            system.right.segment<3>(3 * static_cast<Eigen::Index>(t[j])) += faces[f].right[j];
            trace[t[j]] += faces[f].matrix[j][j].trace();
            whole_trace += faces[f].matrix[j][j].trace();
            for (std::size_t k = 0; k < 3; ++k) {
                if (!fixed[t[k]]) system.add(t[j], t[k], faces[f].matrix[j][k]);
            }
        }
    }
    const double mean_trace = whole_trace / static_cast<double>(std::max<std::size_t>(fixed.size(), 1));
    for (Index v = 0; v < fixed.size(); ++v) {
        const double hold = (damping * trace[v] + mean_damping * mean_trace) / 3;
        system.add(v, v, (fixed[v] || !(hold > 0) ? 1.0 : hold) * Matrix3::Identity());
    }
    const auto size = static_cast<Eigen::Index>(3 * fixed.size());
    Sparse matrix(size, size);
    matrix.setFromTriplets(system.entries.begin(), system.entries.end());
    Eigen::ConjugateGradient<Sparse, Eigen::Lower | Eigen::Upper> solver;
    solver.setMaxIterations(60);
    solver.setTolerance(1e-3);
    solver.compute(matrix);
    const Eigen::VectorXd solution = solver.solve(system.right);
    std::vector<Vector3> steps(fixed.size());
    for (std::size_t v = 0; v < steps.size(); ++v) {
        steps[v] = solution.segment<3>(3 * static_cast<Eigen::Index>(v));
    }
    return steps;
}

}  // namespace faqem::detail

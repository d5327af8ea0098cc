#include "faqem/detail/fitting/gauss_newton.hpp"

#include <Eigen/Cholesky>
#include <cmath>

#include "support/catch.hpp"
#include "support/meshes.hpp"

using namespace faqem;
using detail::Correspondence;
using engine::Vector3;

namespace {

const std::vector<Triangle> one_face = {{0, 1, 2}};
const Vector3 up(0, 0, 1);

}  // namespace

TEST_CASE("gauss-newton: equal residuals at all corners move the triangle by that residual, up to damping") {
    std::vector<Correspondence> correspondences;
    for (std::size_t k = 0; k < 3; ++k) {
        Correspondence correspondence{{0, {0, 0, 0}}, 0.5 * up, up};
        correspondence.sample.barycentric[k] = 1;
        correspondences.push_back(correspondence);
    }
    const std::vector<std::uint8_t> free(3, 0);
    for (const Vector3& step : detail::gauss_newton_step(one_face, correspondences, free, 0.5, 1)) {
        // For each vertex, (w + damping) step = w residual, with damping = (0.02 + 2e-4) * 1.2 w / 3.
        CHECK(step.z() == Approx(0.5 / (1 + 0.0202 * 1.2 / 3)).epsilon(1e-3));
        CHECK(step.head<2>().norm() < 1e-12);
    }
}

TEST_CASE("gauss-newton: fixed vertices do not move, and the others compensate") {
    const std::vector<Correspondence> correspondences = {{{0, {0.5, 0.5, 0}}, up, up}};
    const std::vector<std::uint8_t> fixed = {1, 0, 0};
    const std::vector<Vector3> steps = detail::gauss_newton_step(one_face, correspondences, fixed, 0.5, 1);
    CHECK(steps[0] == Vector3::Zero());
    // The step is twice the residual: the midpoint of the edge moves by half of the step of one vertex.
    CHECK(steps[1].z() == Approx(2).epsilon(0.02));
    CHECK(steps[2].norm() < 1e-9);
}

TEST_CASE("gauss-newton: distant correspondences have a larger weight") {
    // Two correspondences at one corner, up by 4 and down by 1: weights 2 and 1, so (2 * 4 - 1) / 3.
    const std::vector<Correspondence> correspondences = {{{0, {1, 0, 0}}, 4 * up, up},
                                                         {{0, {1, 0, 0}}, -1 * up, up}};
    const std::vector<std::uint8_t> free(3, 0);
    CHECK(detail::gauss_newton_step(one_face, correspondences, free, 0.5, 1)[0].z() ==
          Approx(7.0 / 3).epsilon(0.02));
}

TEST_CASE("gauss-newton: without correspondences the step is zero") {
    const std::vector<std::uint8_t> free(3, 0);
    for (const Vector3& step : detail::gauss_newton_step(one_face, {}, free, 0.5, 1))
        CHECK(step == Vector3::Zero());
}

TEST_CASE("gauss-newton: the step solves the dense system") {
    // Two triangles with a common edge, one vertex fixed, random correspondences.
    const std::vector<Triangle> two = {{0, 1, 2}, {2, 1, 3}};
    const std::vector<std::uint8_t> fixed = {0, 0, 0, 1};
    test::Random random(3);
    std::vector<Correspondence> correspondences;
    for (int i = 0; i < 40; ++i) {
        const double a = random.between(0, 1), b = random.between(0, 1 - a);
        const auto any = [&] {
            return Vector3(random.between(-1, 1), random.between(-1, 1), random.between(-1, 1));
        };
        correspondences.push_back(
            {{static_cast<Index>(i % 2), {a, b, 1 - a - b}}, any(), any().normalized()});
    }
    double mean = 0;
    for (const Correspondence& correspondence : correspondences) mean += correspondence.residual.norm() / 40;
    Eigen::Matrix<double, 12, 12> matrix = Eigen::Matrix<double, 12, 12>::Zero();
    Eigen::Matrix<double, 12, 1> right = Eigen::Matrix<double, 12, 1>::Zero();
    for (const Correspondence& correspondence : correspondences) {
        Eigen::Matrix<double, 3, 12> there = Eigen::Matrix<double, 3, 12>::Zero();
        for (std::size_t k = 0; k < 3; ++k) {
            const Index v = two[correspondence.sample.face][k];
            if (!fixed[v])
                there.block<3, 3>(0, 3 * v) +=
                    correspondence.sample.barycentric[k] * Eigen::Matrix3d::Identity();
        }
        const double w = std::sqrt(std::max(correspondence.residual.norm() / mean, 0.1));
        const Eigen::Matrix3d metric = w * (0.9 * correspondence.normal * correspondence.normal.transpose() +
                                            0.1 * Eigen::Matrix3d::Identity());
        matrix += there.transpose() * metric * there;
        right += there.transpose() * metric * correspondence.residual;
    }
    const double all = matrix.trace();
    for (Eigen::Index v = 0; v < 4; ++v) {
        auto own = matrix.block<3, 3>(3 * v, 3 * v);
        const double hold =
            fixed[static_cast<std::size_t>(v)] ? 1 : (0.02 * own.trace() + 2e-4 * all / 4) / 3;
        own += hold * Eigen::Matrix3d::Identity();
    }
    const Eigen::Matrix<double, 12, 1> solution = matrix.ldlt().solve(right);
    const std::vector<Vector3> steps = detail::gauss_newton_step(two, correspondences, fixed, 0.5, 1);
    for (Eigen::Index v = 0; v < 4; ++v) {
        CHECK((steps[static_cast<std::size_t>(v)] - solution.segment<3>(3 * v)).norm() <
              5e-3 * solution.norm());
    }
    CHECK(steps[3] == Vector3::Zero());
    CHECK(detail::gauss_newton_step(two, correspondences, fixed, 0.5, 3) == steps);
}

TEST_CASE("gauss-newton: the position of a sample is the weighted mean of the corners") {
    const std::vector<Vector3> x = {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}};
    CHECK((detail::SurfaceSample{0, {0.25, 0.25, 0.5}}.position(x, one_face) - Vector3(0.25, 1, 0)).norm() <
          1e-15);
}

#pragma once
/// \file
/// Vector types: Eigen inside the engine, arrays in the interface.

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <type_traits>

#include "faqem/export.hpp"
#include "faqem/mesh.hpp"

#if !defined(EIGEN_VECTORIZE) && !EIGEN_VERSION_AT_LEAST(3, 4, 90)
/** \cond */  // Sums of three doubles in the order of processors whose vectors have two doubles; for dot products.
template <class Function, class Evaluator>
requires std::is_same_v<typename Evaluator::Scalar, double>
struct Eigen::internal::redux_novec_unroller<Function, Evaluator, 0, 3> {
    template <int i>
    using Value = redux_novec_unroller<Function, Evaluator, i, 1>;
    static double run(const Evaluator& values, const Function& sum) {
        return sum(sum(Value<0>::run(values, sum), Value<1>::run(values, sum)), Value<2>::run(values, sum));
    }
};
#endif  /// \endcond

FAQEM_ENGINE_BEGIN

using Vector3 = Eigen::Vector3d;

/// Conversions between the two types; exact.
inline Vector3 to_eigen(const Vec3& p) { return {p[0], p[1], p[2]}; }
inline Vec3 to_array(const Vector3& p) { return {p.x(), p.y(), p.z()}; }

/// The product m v. Eigen's own fuse multiplication and addition where the processor can, whatever the compiler may.
inline Vector3 product(const Eigen::Matrix3d& m, const Vector3& v) {
    return v[0] * m.col(0) + v[1] * m.col(1) + v[2] * m.col(2);
}

/// Area vector of triangle abc: its unit normal times twice its area.
inline Vector3 area_vector(const Vector3& a, const Vector3& b, const Vector3& c) {
    return (b - a).cross(c - a);
}

FAQEM_ENGINE_END

#include "asset/scene/affine.hpp"

#include <cmath>

namespace faqem::detail {

double max_or_nan(double a, double b) { return std::isnan(a) || a >= b ? a : b; }

double transformed_bound(const std::array<double, 16>& m, double largest) {
    double bound = 0;
    for (std::size_t r = 0; r < 3; ++r) {
        const double row =
            (std::abs(m[r]) + std::abs(m[4 + r]) + std::abs(m[8 + r])) * largest + std::abs(m[12 + r]);
        bound = max_or_nan(bound, row);
    }
    return bound;
}

NormalTransform::NormalTransform(const std::array<double, 16>& m) {
    const auto at = [&](std::size_t r, std::size_t col) { return m[4 * (col % 3) + r % 3]; };
    for (std::size_t r = 0; r < 3; ++r)
        for (std::size_t k = 0; k < 3; ++k)
            cofactors_[r][k] = at(r + 1, k + 1) * at(r + 2, k + 2) - at(r + 1, k + 2) * at(r + 2, k + 1);
    const double determinant = m[0] * cofactors_[0][0] + m[1] * cofactors_[1][0] + m[2] * cofactors_[2][0];
    sign_ = determinant < 0 ? -1 : 1;
}

Vec3f NormalTransform::operator()(const Vec3f& n) const {
    Vec3 q;
    for (std::size_t r = 0; r < 3; ++r)
        q[r] = sign_ * (cofactors_[r][0] * n[0] + cofactors_[r][1] * n[1] + cofactors_[r][2] * n[2]);
    const double length = std::hypot(q[0], q[1], q[2]);
    if (!(length > 0 && std::isfinite(length))) return {0, 0, 0};
    return {static_cast<float>(q[0] / length), static_cast<float>(q[1] / length),
            static_cast<float>(q[2] / length)};
}

}  // namespace faqem::detail

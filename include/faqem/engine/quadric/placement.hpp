#pragma once
/// \file
/// Where the new vertex of a collapse goes.

#include <limits>

#include "faqem/engine/quadric/quadric.hpp"
#include "faqem/export.hpp"

FAQEM_NAMESPACE_BEGIN
namespace engine {

/// Where the new vertex may go.
enum class AllowedPosition {
    anywhere,
    at_first,   ///< only where the pair's first vertex is
    at_second,  ///< only where its second vertex is
    nowhere,    ///< the pair may not be collapsed
};

/// The two of them together. \return nowhere if they contradict each other
inline AllowedPosition intersection(AllowedPosition a, AllowedPosition b) {
    if (a == AllowedPosition::anywhere || a == b) return b;
    return b == AllowedPosition::anywhere ? a : AllowedPosition::nowhere;
}

/// A collapse that may be done.
struct Candidate {
    Vector3 point;
    double cost = std::numeric_limits<double>::quiet_NaN();
};

/// The room for new vertices around a surface: its box, and a tenth of the diagonal on all sides. Planes that
/// are parallel but for noise meet anywhere.
inline Eigen::AlignedBox3d placement_bounds(const Eigen::AlignedBox3d& box) {
    const Vector3 margin = Vector3::Constant(0.1 * box.diagonal().norm());
    return {box.min() - margin, box.max() + margin};
}

/// The minimum of `q`; where it is ill conditioned, the best of a, b and their midpoint, first come first
/// taken (paper, Sec. 3.1).
/// \pre freedom is not `nowhere`
/// \param bounds  a minimum outside of it counts as ill conditioned; null: there is room everywhere
inline Vector3 optimal_position(const Quadric& q, const Vector3& a, const Vector3& b,
                                AllowedPosition allowed_position,
                                const Eigen::AlignedBox3d* bounds = nullptr) {
    if (allowed_position == AllowedPosition::at_first) return a;
    if (allowed_position == AllowedPosition::at_second) return b;
    if (const auto p = q.minimum(); p && (!bounds || bounds->contains(*p))) return *p;
    Vector3 best = a;
    double lowest = q(a);
    for (const Vector3& p : {b, Vector3(0.5 * (a + b))}) {
        const double error = q(p);
        if (error < lowest) lowest = error, best = p;
    }
    return best;
}

}  // namespace engine
FAQEM_NAMESPACE_END

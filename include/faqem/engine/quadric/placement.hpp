#pragma once
/// \file
/// Position of the vertex that a collapse creates.

#include <limits>

#include "faqem/engine/quadric/quadric.hpp"
#include "faqem/export.hpp"

FAQEM_ENGINE_BEGIN

/// Positions that the new vertex of a pair may have.
enum class AllowedPosition {
    anywhere,
    at_first,   ///< only the position of the pair's first vertex
    at_second,  ///< only the position of the pair's second vertex
    nowhere,    ///< the pair must not be collapsed
};

/// The positions that both arguments allow. O(1)
/// \return `nowhere` if there are none
inline AllowedPosition intersection(AllowedPosition a, AllowedPosition b) {
    if (a == AllowedPosition::anywhere || a == b) return b;
    return b == AllowedPosition::anywhere ? a : AllowedPosition::nowhere;
}

/// The positions that vertices which must not move allow. O(1)
inline AllowedPosition allowed_by_fixed(bool is_first_fixed, bool is_second_fixed) {
    if (is_first_fixed && is_second_fixed) return AllowedPosition::nowhere;
    if (is_first_fixed) return AllowedPosition::at_first;
    return is_second_fixed ? AllowedPosition::at_second : AllowedPosition::anywhere;
}

/// A plane or a line.
struct Flat {
    Vector3 point;          ///< a point in it, engine units
    Eigen::Matrix3d along;  ///< projects a vector onto its directions
};

/// A possible collapse of a pair.
struct Candidate {
    Vector3 point;                                           ///< position of the new vertex, engine units
    double cost = std::numeric_limits<double>::quiet_NaN();  ///< finite and >= 0 if a metric returned it
};

/// Bounds for the positions of new vertices: a box extended by a tenth of its diagonal on all sides. Planes
/// that are parallel except for noise may intersect anywhere; minima outside the bounds are rejected.
/// \param box  axis-aligned bounding box of the surface
inline Eigen::AlignedBox3d placement_bounds(const Eigen::AlignedBox3d& box) {
    const Vector3 margin = Vector3::Constant(0.1 * box.diagonal().norm());
    return {box.min() - margin, box.max() + margin};
}

/// The position of the new vertex: the minimum of a quadric, or, if that is ill-conditioned or outside the
/// bounds, the best of a, b and their midpoint (paper, Sec. 3.1). Of equally good positions, the first in
/// this order is taken. O(1)
/// \pre `allowed_position` is not `nowhere`
/// \param q                 the quadric to minimise
/// \param a, b              positions of the pair's vertices
/// \param allowed_position  `at_first` returns a, `at_second` returns b
/// \param bounds            see placement_bounds(); null: unbounded
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

/// As optimal_position() with AllowedPosition::anywhere, for positions in a plane or on a line. O(1)
/// \param a, b    positions of the pair's vertices; one that is not in the flat stands for the nearest point in it
/// \param flat    contains the result up to rounding
/// \param origin  origin of the coordinates of `q`, `a`, `b` and `bounds`
inline Vector3 optimal_position_in(const Flat& flat, const Vector3& origin, const Quadric& q,
                                   const Vector3& a, const Vector3& b, const Eigen::AlignedBox3d& bounds) {
    const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - flat.along;
    const Vector3 foot = product(across, flat.point - origin);  // the point in the flat nearest to the origin
    const Vector3 slope = product(flat.along, q.apply(foot) + q.b);
    // The second term makes the quadric regular; its minimum is in the flat.
    Eigen::Matrix3d m = q.trace() * across;
    for (int k = 0; k < 3; ++k) m.col(k) += product(flat.along, q.apply(flat.along.col(k)));
    const Quadric inside = {{m(0, 0), m(0, 1), m(0, 2), m(1, 1), m(1, 2), m(2, 2)}, slope, 0};
    return foot + product(flat.along, optimal_position(inside, product(flat.along, a), product(flat.along, b),
                                                       AllowedPosition::anywhere, &bounds));
}

FAQEM_ENGINE_END

#pragma once
/// \file
/// The terms of the composite metric (paper, Sec. 3.2). All lengths are in engine units.

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "faqem/engine/mesh/collapse_mesh.hpp"
#include "faqem/engine/mesh/pair_table.hpp"
#include "faqem/engine/quadric/quadric.hpp"
#include "faqem/export.hpp"

FAQEM_ENGINE_BEGIN

/// Weight of a face's plane in the base term. K is the squared distance to the plane, A the area of the
/// face.
enum class BaseWeight {
    unit,          ///< K (Garland and Heckbert 1997; paper eq. 1)
    area,          ///< A K
    inverse_area,  ///< K / (w A) (paper eq. 5)
};

/// Base term of one face; the same for all of its corners. O(1)
/// \param n2          area vector of the face: its unit normal times twice its area
/// \param corner      position of any corner
/// \param mode        weight of the plane
/// \param plane_area  w of paper eq. 5, > 0; used by `inverse_area` only
/// \param min_area    smaller areas are clamped to this value, so that 1/A is finite
/// \return zero for a face of zero area, which has no plane
inline Quadric base_term(const Vector3& n2, const Vector3& corner, BaseWeight mode, double plane_area,
                         double min_area) {
    const double length = n2.norm();
    if (!(length > 0)) return {};
    const double area = std::max(0.5 * length, min_area);
    const double weight = mode == BaseWeight::unit   ? 1.0
                          : mode == BaseWeight::area ? area
                                                     : 1.0 / (plane_area * area);
    return Quadric::plane_through(n2 / length, corner, weight);
}

/// Boundary neighbours of a vertex. O(valence)
/// \return the other ends of the boundary edges at v, smaller index first; nothing unless there are exactly
///     two
inline std::optional<std::array<Index, 2>> boundary_neighbours(const PairTable& pairs, Index v) {
    if (pairs.boundary_degree(v) != 2) return std::nullopt;
    std::array<Index, 2> found = {no_index, no_index};
    std::size_t count = 0;
    pairs.for_each_pair(v, [&](Neighbour n) {
        if (pairs.face_count(n.pair) == 1 && count < 2) found[count++] = n.vertex;
    });
    if (found[0] > found[1]) std::swap(found[0], found[1]);
    return found;
}

/// Curvature of the boundary v2, v1, v3 at v1 by finite differences (paper eq. 6): |d' x d''| / |d'|^3 with
/// d' = v3 - v2 and d'' = v3 - 2 v1 + v2. Since d' spans two edges, a circular boundary of radius R has a
/// curvature of about 1/(4R).
/// \return 0 if v2 and v3 coincide
inline double boundary_curvature(const Vector3& v1, const Vector3& v2, const Vector3& v3) {
    const Vector3 first = v3 - v2;
    const Vector3 second = v3 - 2 * v1 + v2;
    const double length = first.norm();
    const double kappa = first.cross(second).norm() / (length * length * length);
    return std::isfinite(kappa) ? kappa : 0;
}

/// Boundary and curvature term at a boundary vertex (paper eq. 7-9): kappa (p1 p1^T + p2 p2^T), where p1 is
/// the plane through v1, v2 and v3, and p2 is the plane through v1 perpendicular to v1 - v2. The normals
/// are not normalised, as printed in the paper.
/// \param v1      position of the vertex
/// \param v2, v3  positions of its boundary neighbours
inline Quadric boundary_term(const Vector3& v1, const Vector3& v2, const Vector3& v3) {
    const double kappa = boundary_curvature(v1, v2, v3);
    Quadric q = Quadric::plane_through((v1 - v2).cross(v3 - v1), v1, kappa);
    q += Quadric::plane_through(v1 - v2, v1, kappa);
    return q;
}

/// Normal term (paper eq. 10): the tangent plane at v, whose normal is the area-weighted mean of the face
/// normals. O(valence)
/// \param origin  origin of the coordinates of the result
/// \return zero if the normals cancel
inline Quadric normal_term(const CollapseMesh& mesh, Index v, const Vector3& origin = Vector3::Zero()) {
    Vector3 sum = Vector3::Zero();
    mesh.for_each_face(v, [&](Index f, unsigned) { sum += mesh.area_vector(f); });
    const double length = sum.norm();
    if (!(length > 0)) return {};
    return Quadric::plane_through(sum / length, mesh.position(v) - origin, 1);
}

/// Area term of the pair (u, v) (paper eq. 11): half of the squared doubled area of the triangles between
/// the new vertex and each boundary edge at u or v. A boundary edge between u and v counts once. The term
/// is not accumulated, since it refers to the current boundary. O(valence)
/// \param origin  origin of the coordinates of the result
inline Quadric area_term(const CollapseMesh& mesh, const PairTable& pairs, Index u, Index v,
                         const Vector3& origin = Vector3::Zero()) {
    Quadric q;
    for (const Index end : {u, v}) {
        if (pairs.boundary_degree(end) == 0) continue;
        pairs.for_each_pair(end, [&](Neighbour n) {
            if (pairs.face_count(n.pair) != 1 || (end == v && n.vertex == u)) return;
            q += Quadric::edge_area(mesh.position(end) - origin, mesh.position(n.vertex) - origin, 1);
        });
    }
    return q;
}

FAQEM_ENGINE_END

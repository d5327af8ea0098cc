#pragma once
/// \file
/// The terms of the composite metric, one function each (paper, Sec. 3.2). All in the engine's units.

#include <algorithm>
#include <array>
#include <optional>

#include "faqem/engine/mesh/collapse_mesh.hpp"
#include "faqem/engine/mesh/pair_table.hpp"
#include "faqem/engine/quadric/quadric.hpp"
#include "faqem/export.hpp"

FAQEM_NAMESPACE_BEGIN
namespace engine {

/// How much a face's plane counts in the base term.
enum class BaseWeight {
    unit,          ///< K (Garland and Heckbert 1997; paper eq. 1)
    area,          ///< A K
    inverse_area,  ///< K / (w A) (paper eq. 5)
};

/// Base term of one face with doubled-area vector `n2`, seen from any of its corners.
/// \param plane_area  w of paper eq. 5; used by inverse_area only, > 0
/// \param min_area  areas below are clamped to it, so that 1/A stays finite
/// \return zero for a face without area: it has no plane
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

/// The two ends of the border at v, smaller index first, if exactly two open edges meet there.
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

/// Curvature of the border v2, v1, v3 by finite differences (paper eq. 6):
/// |d' x d''| / |d'|^3 with d' = v3 - v2 and d'' = v3 - 2 v1 + v2. d' spans two steps: a circular rim of
/// radius R gives about 1/(4R).
/// \return 0 where v2 and v3 coincide
inline double boundary_curvature(const Vector3& v1, const Vector3& v2, const Vector3& v3) {
    const Vector3 first = v3 - v2;
    const Vector3 second = v3 - 2 * v1 + v2;
    const double length = first.norm();
    const double kappa = first.cross(second).norm() / (length * length * length);
    return std::isfinite(kappa) ? kappa : 0;
}

/// Boundary and curvature term at v1 between its border neighbours (paper eq. 7-9): kappa (p1 p1^T + p2
/// p2^T), p1 the plane of v1, v2, v3 and p2 the one through v1 across v1 - v2. The normals keep their length,
/// as printed.
inline Quadric boundary_term(const Vector3& v1, const Vector3& v2, const Vector3& v3) {
    const double kappa = boundary_curvature(v1, v2, v3);
    Quadric q = Quadric::plane_through((v1 - v2).cross(v3 - v1), v1, kappa);
    q += Quadric::plane_through(v1 - v2, v1, kappa);
    return q;
}

/// Normal term (paper eq. 10): the tangent plane at v, its normal the area-weighted mean of the faces'.
/// \return zero where the normals cancel
inline Quadric normal_term(const CollapseMesh& mesh, Index v) {
    Vector3 sum = Vector3::Zero();
    mesh.for_each_face(v, [&](Index f, unsigned) { sum += mesh.area_vector(f); });
    const double length = sum.norm();
    if (!(length > 0)) return {};
    return Quadric::plane_through(sum / length, mesh.position(v), 1);
}

/// Area term of the pair (u, v) (paper eq. 11): half of the squared doubled area that a new point spans with
/// each open edge at u or v; an open edge between the two counts once. Never accumulated: it belongs to the
/// current border.
inline Quadric area_term(const CollapseMesh& mesh, const PairTable& pairs, Index u, Index v) {
    Quadric q;
    for (const Index end : {u, v}) {
        if (pairs.boundary_degree(end) == 0) continue;
        pairs.for_each_pair(end, [&](Neighbour n) {
            if (pairs.face_count(n.pair) != 1 || (end == v && n.vertex == u)) return;
            q += Quadric::edge_area(mesh.position(end), mesh.position(n.vertex), 1);
        });
    }
    return q;
}

}  // namespace engine
FAQEM_NAMESPACE_END

#pragma once
/// \file
/// Points of the source near the corners of the simplified mesh, without a SurfaceMap.

#include <cmath>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "bake/parts/corners.hpp"
#include "bake/source/source_normals.hpp"
#include "faqem/detail/base/buckets.hpp"
#include "faqem/detail/base/parallel.hpp"
#include "faqem/detail/geometry/triangle.hpp"
#include "faqem/detail/mapping/successive_projection.hpp"
#include "faqem/forward_map.hpp"
#include "faqem/surface_map.hpp"
#include "scene/vector_conversion.hpp"

namespace faqem::detail {

/// Fractions of the way from a corner to the middle of the opposite edge: just inside the face, and at the three points
/// with which the integral of a quadratic function over it is exact.
inline constexpr std::array<double, 2> corner_insets = {0.02, 1.0 / 3};

/// The faces of the source around each vertex of the simplified mesh: those with a corner that was collapsed into it.
inline Buckets<Index> faces_around(const CollapseHistory& history, std::size_t vertices) {
    const std::vector<Index> vertex = vertex_map(history);
    return Buckets<Index>(vertices, [&](auto&& put) {
        for (Index f = 0; f < history.triangles.size(); ++f) {
            const Triangle& t = history.triangles[f];
            if (t[0] == no_index) continue;
            const Index a = vertex[t[0]], b = vertex[t[1]], c = vertex[t[2]];
            if (a != no_index) put(a, f);
            if (b != no_index && b != a) put(b, f);
            if (c != no_index && c != a && c != b) put(c, f);
        }
    });
}

/// The closest points of visit_corner_points(), among the faces around each vertex.
class CornerPointSearch {
public:
    explicit CornerPointSearch(const BakePart& part)
        : mesh_(part.simplified->mesh),
          history_(part.simplified->history),
          corners_(vertex_corners(mesh_)),
          faces_(faces_around(history_, mesh_.positions.size())) {}

    // Calls visit(corner, near, inner) for the corners of a vertex.
    template <class Visit>
    void visit_vertex(Index v, const RunContext& context, const Visit& visit) const {
        const std::span<const Index> candidates = faces_[v];
        const std::span<const std::uint64_t> corners = corners_[v];
        const Vector3 centre = to_eigen(mesh_.positions[v]);
        std::vector<double> distances;
        distances.reserve(candidates.size());
        for (const Index f : candidates)
            distances.push_back(std::sqrt(on_source(f, centre).distance_squared));
        for (const std::uint64_t corner : corners) {
            const Triangle& t = mesh_.triangles[corner / 3];
            const Vector3 normal = winding_normal(mesh_.positions, t);
            const auto closest = [&](double inset) {
                const Vec3 w = barycentrics_near_corner(corner % 3, inset);
                Vector3 p = Vector3::Zero();
                for (std::size_t i = 0; i < 3; ++i) p += w[i] * to_eigen(mesh_.positions[t[i]]);
                // Distances of the candidates change by at most the way from the centre.
                const double away = (p - centre).norm() * (1 + 1e-9);
                ClosestPoint best;
                Index found = no_index;
                for (std::size_t i = 0; i < candidates.size(); ++i) {
                    const double least = distances[i] - away;
                    if (least > 0 && least * least > best.distance_squared) continue;
                    const ClosestPoint at = on_source(candidates[i], p);
                    if (!(at.distance_squared < best.distance_squared)) continue;
                    if (!is_accepted(candidates[i], corner / 3, normal)) continue;
                    best = at;
                    found = candidates[i];
                }
                return SurfacePoint{found, to_array(best.barycentric), MapStep::history};
            };
            context.count(2 * map_query_cost);
            visit(corner, closest(corner_insets[0]), closest(corner_insets[1]));
        }
    }

    // Whether some vertex has so many corners and faces that their comparisons would be quadratic work.
    bool is_slow() const {
        constexpr std::size_t max_comparisons = 1 << 14;
        for (std::size_t v = 0; v < mesh_.positions.size(); ++v)
            if (faces_[v].size() * corners_[v].size() > max_comparisons) return true;
        return false;
    }

private:
    ClosestPoint on_source(Index f, const Vector3& p) const {
        const auto [a, b, c] = corners_of(history_.positions, history_.triangles[f]);
        return closest_point_on_triangle(p, a, b, c);
    }

    // \param face, normal  of the simplified mesh, the latter by its winding
    bool is_accepted(Index candidate, std::size_t face, const Vector3& normal) const {
        const std::vector<Index>& groups = history_.face_groups;
        if (!groups.empty() && groups[candidate] != groups[history_.remaining_faces[face]]) return false;
        if (normal.isZero(0)) return true;
        const Vector3 area = area_vector(history_.positions, history_.triangles[candidate]);
        return area.dot(normal) >= min_facing_cosine * area.norm();
    }

    const TriangleMesh& mesh_;
    const CollapseHistory& history_;
    VertexCorners corners_;
    Buckets<Index> faces_;
};

/// Finds the points of the source that are closest to two points near each corner of the simplified mesh, as
/// barycentrics_near_corner() gives them for corner_insets. They are on faces with a corner that was collapsed into the
/// vertex of the simplified corner, of the same group, and at most 80 degrees from the simplified face. BakePart::map gives
/// the same points unless they are on faces of another vertex or of another surface patch, but takes longer to prepare; if
/// there is one, it is used, and one is made for vertices with very many faces.
/// \param visit  visit(corner, near, inner), called once for each corner, concurrently; the face of a point may be no_index
/// \throws whatever `context` throws
/// O(n log n) in the faces of both meshes
inline void visit_corner_points(
    const BakePart& part, const RunContext& context,
    const std::function<void(std::uint64_t, const SurfacePoint&, const SurfacePoint&)>& visit) {
    const auto visit_mapped = [&](const PointMap& map) {
        parallel_each(3 * part.faces(), 256, context, [&](std::size_t c) {
            const auto at = [&](double inset) {
                return map.map(static_cast<Index>(c / 3), barycentrics_near_corner(c % 3, inset));
            };
            visit(c, at(corner_insets[0]), at(corner_insets[1]));
        });
    };
    if (part.map) return visit_mapped(*part.map);
    const CornerPointSearch search(part);
    if (search.is_slow())
        return visit_mapped(
            HistoryMap(make_surface_map(part.simplified->history, part.source->triangles, context)));
    parallel_blocks(part.simplified->mesh.positions.size(), 64, context,
                    [&](std::size_t begin, std::size_t end, const RunContext& block_context) {
                        for (std::size_t v = begin; v < end; ++v)
                            search.visit_vertex(static_cast<Index>(v), block_context, visit);
                    });
}

}  // namespace faqem::detail

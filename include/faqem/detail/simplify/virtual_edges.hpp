#pragma once
/// \file
/// Virtual edges: collapse candidates between connected components that are close but do not touch (paper,
/// supplementary).

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

#include "faqem/detail/geometry/bvh.hpp"
#include "faqem/engine/mesh/collapse_mesh.hpp"
#include "faqem/engine/mesh/components.hpp"
#include "faqem/engine/mesh/pair_table.hpp"
#include "faqem/export.hpp"

FAQEM_DETAIL_BEGIN

using engine::CollapseMesh;

// The nearest vertices of other components within a radius. Ties are ordered by index.
class NearestInOtherComponents {
public:
    // Squared distance and point.
    using Hit = std::pair<double, std::size_t>;

    NearestInOtherComponents(const std::vector<Index>& component_of, Index own, double radius_squared)
        : component_of_(component_of), own_(own), radius_squared_(radius_squared) {}

    // Points beyond this squared distance can be skipped; points at equal distance are ordered by index.
    double limit() const { return hits_.size() < most ? radius_squared_ : hits_.back().first; }

    void add(double distance_squared, std::size_t point) {
        if (component_of_[point] == own_ || !(distance_squared <= radius_squared_)) return;
        const Hit hit{distance_squared, point};
        hits_.insert(std::upper_bound(hits_.begin(), hits_.end(), hit), hit);
        if (hits_.size() > most) hits_.pop_back();
    }

    const std::vector<Hit>& hits() const { return hits_; }

private:
    static constexpr std::size_t most = 4;

    const std::vector<Index>& component_of_;
    Index own_;
    double radius_squared_;
    std::vector<Hit> hits_;
};

// True if faces at both vertices have a common group, and the dot product of the mean normals is positive.
inline bool are_compatible(const CollapseMesh& mesh, std::span<const Index> groups, Index u, Index v) {
    const auto normal = [&](Index w) {
        Vector3 n = Vector3::Zero();
        mesh.for_each_face(w, [&](Index f, unsigned) { n += mesh.area_vector(f); });
        return n;
    };
    if (!(normal(u).dot(normal(v)) > 0)) return false;
    if (groups.empty()) return true;
    return !mesh.all_of_faces(u, [&](Index f, unsigned) {
        return mesh.all_of_faces(v, [&](Index g, unsigned) { return groups[f] != groups[g]; });
    });
}

/// The vertices with faces, component by component.
struct VerticesByComponent {
    std::vector<Index> vertices;      ///< vertex slots
    std::vector<Index> component_of;  ///< by entry of `vertices`
    std::vector<Vector3> positions;   ///< by entry of `vertices`
};

inline VerticesByComponent vertices_by_component(const CollapseMesh& mesh,
                                                 std::span<const engine::Component> components) {
    VerticesByComponent result;
    std::vector<std::uint8_t> seen(mesh.vertex_slots(), 0);
    for (Index component = 0; component < components.size(); ++component) {
        for (const Index f : components[component].faces) {
            for (const Index v : mesh.triangle(f)) {
                if (std::exchange(seen[v], std::uint8_t{1})) continue;
                result.vertices.push_back(v);
                result.component_of.push_back(component);
                result.positions.push_back(mesh.position(v));
            }
        }
    }
    return result;
}

/// A virtual edge that may be added: its squared length, and its ends, the smaller one first.
using CandidateEdge = std::pair<double, std::pair<Index, Index>>;

/// Edges from each boundary vertex to the nearest boundary vertices of other components. An edge that is
/// found from both ends occurs twice.
inline std::vector<CandidateEdge> candidate_edges(const CollapseMesh& mesh, const VerticesByComponent& all,
                                                  std::span<const Index> face_groups, double distance,
                                                  double min_length) {
    const engine::PairTable surface(mesh, {});
    std::vector<Triangle> points;  // degenerate triangles: the tree is one of triangles
    points.reserve(all.vertices.size());
    for (Index point = 0; point < all.vertices.size(); ++point) points.push_back({point, point, point});
    const Bvh tree(all.positions, points);
    std::vector<CandidateEdge> edges;
    for (std::size_t i = 0; i < all.vertices.size(); ++i) {
        const Index v = all.vertices[i];
        if (surface.boundary_degree(v) == 0) continue;
        NearestInOtherComponents nearest(all.component_of, all.component_of[i], distance * distance);
        tree.visit_near(
            to_array(all.positions[i]), [&] { return nearest.limit(); },
            [&](const Bvh::Corners& point, double) {
                const Vector3 d = point.a - all.positions[i];
                nearest.add(d.x() * d.x() + d.y() * d.y() + d.z() * d.z(), point.face);
            });
        for (const auto& [length_squared, point] : nearest.hits()) {
            const Index w = all.vertices[point];
            if (!(length_squared >= min_length * min_length) || surface.boundary_degree(w) == 0) continue;
            if (!are_compatible(mesh, face_groups, v, w)) continue;
            edges.push_back({length_squared, std::minmax(v, w)});
        }
    }
    return edges;
}

/// Finds pairs of boundary vertices of different components.
///
/// For each boundary vertex the four nearest vertices of other components are examined. A pair is used if
/// both vertices are on a boundary, their mean normals form an angle of less than 90 degrees, and faces at
/// both belong to the same group. If there are more pairs than vertices, the shortest ones are returned.
///
/// Differs from the paper in two ways. The paper compares centroids of triangles, which misses close vertices
/// of large triangles. It also joins closed components: where they touch, such collapses cost nothing and
/// create non-manifold vertices that no later collapse removes.
/// \param mesh         the surface, engine units; read only during the call
/// \param face_groups  empty, or one per face slot
/// \param distance     maximum length, engine units, > 0
/// \param min_length   minimum length, engine units: shorter pairs would be degenerate (paper: 1e-8 of the
///                     diagonal)
/// \return distinct pairs of vertex slots, each with the smaller one first, sorted
/// Complexity: O(n log n) expected
/// Source: FA-QEM, supplementary
inline std::vector<std::pair<Index, Index>> virtual_edges(const CollapseMesh& mesh,
                                                          std::span<const Index> face_groups, double distance,
                                                          double min_length) {
    const std::vector<engine::Component> components = engine::components(mesh);
    if (components.size() < 2) return {};
    const VerticesByComponent all = vertices_by_component(mesh, components);
    std::vector<CandidateEdge> edges = candidate_edges(mesh, all, face_groups, distance, min_length);
    std::sort(edges.begin(), edges.end());
    edges.erase(
        std::unique(edges.begin(), edges.end(),
                    [](const CandidateEdge& x, const CandidateEdge& y) { return x.second == y.second; }),
        edges.end());
    if (edges.size() > all.vertices.size()) edges.resize(all.vertices.size());
    std::vector<std::pair<Index, Index>> result;
    result.reserve(edges.size());
    for (const CandidateEdge& edge : edges) result.push_back(edge.second);
    std::sort(result.begin(), result.end());
    return result;
}

FAQEM_DETAIL_END

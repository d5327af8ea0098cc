#pragma once

#include "faqem/detail/simplify/virtual_edges.hpp"
#include "faqem/export.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>

#include "faqem/detail/geometry/bvh.hpp"
#include "faqem/engine/mesh/components.hpp"
#include "faqem/engine/mesh/pair_table.hpp"

FAQEM_NAMESPACE_BEGIN
namespace detail {

using engine::CollapseMesh;
using engine::Vector3;

// The nearest vertices of other components within a radius. Ties are ordered by index.
class NearestInOtherComponents {
public:
    struct Hit {
        double distance_squared;
        std::size_t point;
        bool operator<(const Hit& o) const {
            return std::tie(distance_squared, point) < std::tie(o.distance_squared, o.point);
        }
    };

    NearestInOtherComponents(const std::vector<Index>& component_of, Index own, double radius_squared)
        : component_of_(component_of), own_(own), radius_squared_(radius_squared) {}

    // Points beyond this squared distance can be skipped; points at equal distance are ordered by index.
    double limit() const {
        return count_ < hits_.size() ? radius_squared_ : hits_[count_ - 1].distance_squared;
    }

    void add(double distance_squared, std::size_t point) {
        if (component_of_[point] == own_ || !(distance_squared <= radius_squared_)) return;
        const Hit hit{distance_squared, point};
        if (count_ == hits_.size()) {
            if (!(hit < hits_.back())) return;
        } else {
            ++count_;
        }
        std::size_t i = count_ - 1;
        for (; i > 0 && hit < hits_[i - 1]; --i) hits_[i] = hits_[i - 1];
        hits_[i] = hit;
    }

    std::span<const Hit> hits() const { return std::span(hits_).first(count_); }

private:
    const std::vector<Index>& component_of_;
    Index own_;
    double radius_squared_;
    std::array<Hit, 4> hits_ = {};
    std::size_t count_ = 0;
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

FAQEM_INLINE std::vector<std::pair<Index, Index>> virtual_edges(const CollapseMesh& mesh,
                                                                std::span<const Index> face_groups,
                                                                double distance, double min_length,
                                                                engine::CancellationCheck check_cancelled) {
    const std::vector<engine::Component> parts = engine::components(mesh, check_cancelled);
    if (parts.size() < 2) return {};
    const engine::PairTable surface(mesh, {}, check_cancelled);
    std::vector<Index> vertices;
    std::vector<Vector3> positions;
    std::vector<Triangle> points;  // degenerate triangles: the tree is one of triangles
    std::vector<Index> component_of;
    std::vector<std::uint8_t> seen(mesh.vertex_slots(), 0);
    for (Index part = 0; part < parts.size(); ++part) {
        for (const Index f : parts[part].faces) {
            check_cancelled();
            for (const Index v : mesh.triangle(f)) {
                if (std::exchange(seen[v], std::uint8_t{1})) continue;
                const auto point = static_cast<Index>(vertices.size());
                vertices.push_back(v);
                positions.push_back(mesh.position(v));
                points.push_back({point, point, point});
                component_of.push_back(part);
            }
        }
    }
    const Bvh tree(positions, points, check_cancelled);

    struct Edge {
        double length_squared;
        Index a, b;
        bool operator<(const Edge& o) const {
            return std::tie(length_squared, a, b) < std::tie(o.length_squared, o.a, o.b);
        }
    };
    std::vector<Edge> edges;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        check_cancelled();
        NearestInOtherComponents nearest(component_of, component_of[i], distance * distance);
        const Index v = vertices[i];
        if (surface.boundary_degree(v) == 0) continue;
        tree.visit_near(
            engine::to_array(positions[i]), [&] { return nearest.limit(); },
            [&](Index point) {
                const Vector3 d = positions[point] - positions[i];
                nearest.add(d.x() * d.x() + d.y() * d.y() + d.z() * d.z(), point);
            });
        for (const auto& hit : nearest.hits()) {
            const Index w = vertices[hit.point];
            if (!(hit.distance_squared >= min_length * min_length) || surface.boundary_degree(w) == 0)
                continue;
            if (!are_compatible(mesh, face_groups, v, w)) continue;
            edges.push_back({hit.distance_squared, std::min(v, w), std::max(v, w)});
        }
    }
    std::sort(edges.begin(), edges.end(), engine::cancellable_less(check_cancelled));
    edges.erase(std::unique(edges.begin(), edges.end(),
                            [](const Edge& x, const Edge& y) { return x.a == y.a && x.b == y.b; }),
                edges.end());
    if (edges.size() > vertices.size()) edges.resize(vertices.size());
    std::vector<std::pair<Index, Index>> result;
    result.reserve(edges.size());
    for (const Edge& edge : edges) result.emplace_back(edge.a, edge.b);
    std::sort(result.begin(), result.end());
    return result;
}

}  // namespace detail
FAQEM_NAMESPACE_END

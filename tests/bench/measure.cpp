#include "measure.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "faqem/detail/geometry/bvh.hpp"
#include "faqem/engine/mesh/vector.hpp"

namespace faqem::bench {

namespace {

using engine::Vector3;

/// A half-edge: its edge, its face and whether it runs from the smaller to the larger vertex.
struct HalfEdge {
    Index low, high, face;
    bool forward;
};

/// Returns the half-edges of all faces, sorted by edge.
std::vector<HalfEdge> sorted_halfedges(const TriangleMesh& mesh) {
    std::vector<HalfEdge> halfedges;
    halfedges.reserve(3 * mesh.triangles.size());
    for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
        const Triangle& t = mesh.triangles[f];
        for (std::size_t k = 0; k < 3; ++k) {
            const Index u = t[k], v = t[(k + 1) % 3];
            if (u != v) halfedges.push_back({std::min(u, v), std::max(u, v), static_cast<Index>(f), u < v});
        }
    }
    std::sort(halfedges.begin(), halfedges.end(), [](const HalfEdge& a, const HalfEdge& b) {
        return std::tie(a.low, a.high, a.face) < std::tie(b.low, b.high, b.face);
    });
    return halfedges;
}

/// Calls visit(first, count) with the half-edges of each edge.
template <class Visit>
void for_each_edge(const std::vector<HalfEdge>& halfedges, Visit&& visit) {
    for (std::size_t i = 0, j = 0; i < halfedges.size(); i = j) {
        while (j < halfedges.size() && halfedges[j].low == halfedges[i].low &&
               halfedges[j].high == halfedges[i].high)
            ++j;
        visit(&halfedges[i], j - i);
    }
}

/// Returns the unit normal of a face, or zero if its height is below 1e-12 of its longest edge.
Vector3 normal(const TriangleMesh& mesh, const Triangle& t) {
    const Vector3 a = engine::to_eigen(mesh.positions[t[0]]), b = engine::to_eigen(mesh.positions[t[1]]),
                  c = engine::to_eigen(mesh.positions[t[2]]);
    const Vector3 n = engine::area_vector(a, b, c);
    const double longest = std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
    const double length = n.norm();
    if (!(length > 1e-12 * longest)) return Vector3::Zero();
    return n / length;
}

/// Returns the boundary edges as degenerate triangles, for the BVH.
std::vector<Triangle> boundary_segments(const TriangleMesh& mesh) {
    std::vector<Triangle> segments;
    for_each_edge(sorted_halfedges(mesh), [&](const HalfEdge* halfedge, std::size_t count) {
        if (count == 1) segments.push_back({halfedge->low, halfedge->high, halfedge->high});
    });
    return segments;
}

/// Returns the maximum distance of samples on the segments to another boundary.
double one_sided_distance(const TriangleMesh& from, const std::vector<Triangle>& segments,
                          const detail::Bvh& to, std::size_t samples) {
    double length = 0;
    const auto end = [&](const Triangle& s, std::size_t k) { return engine::to_eigen(from.positions[s[k]]); };
    for (const Triangle& s : segments) length += (end(s, 1) - end(s, 0)).norm();
    double worst = 0;
    for (const Triangle& s : segments) {
        const double share = (end(s, 1) - end(s, 0)).norm() / length;
        const auto steps = static_cast<std::size_t>(std::ceil(share * static_cast<double>(samples))) + 1;
        for (std::size_t i = 0; i <= steps; ++i) {
            const double t = static_cast<double>(i) / static_cast<double>(steps);
            const Vector3 p = (1 - t) * end(s, 0) + t * end(s, 1);
            worst = std::max(worst, to.closest(engine::to_array(p)).distance_squared);
        }
    }
    return std::sqrt(worst);
}

}  // namespace

std::uint64_t foldovers(const TriangleMesh& mesh) {
    std::vector<Vector3> normals;
    normals.reserve(mesh.triangles.size());
    for (const Triangle& t : mesh.triangles) normals.push_back(normal(mesh, t));
    std::uint64_t count = 0;
    for_each_edge(sorted_halfedges(mesh), [&](const HalfEdge* halfedges, std::size_t faces) {
        if (faces != 2) return;
        const double dot = normals[halfedges[0].face].dot(normals[halfedges[1].face]);
        count += (halfedges[0].forward != halfedges[1].forward ? dot : -dot) < -0.9;
    });
    return count;
}

std::uint64_t flat_faces(const TriangleMesh& mesh) {
    return static_cast<std::uint64_t>(
        std::count_if(mesh.triangles.begin(), mesh.triangles.end(),
                      [&](const Triangle& t) { return normal(mesh, t) == Vector3::Zero(); }));
}

std::optional<double> border_hausdorff(const TriangleMesh& a, const TriangleMesh& b, std::size_t samples) {
    const std::vector<Triangle> of_a = boundary_segments(a), of_b = boundary_segments(b);
    if (of_a.empty() || of_b.empty()) return std::nullopt;
    const detail::Bvh tree_a(a.positions, of_a), tree_b(b.positions, of_b);
    return std::max(one_sided_distance(a, of_a, tree_b, samples),
                    one_sided_distance(b, of_b, tree_a, samples));
}

}  // namespace faqem::bench

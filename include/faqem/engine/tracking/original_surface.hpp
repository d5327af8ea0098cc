#pragma once
/// \file
/// The surface before simplification, and the mapping of its vertices to the current mesh.

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "faqem/engine/mesh/boundary_edges.hpp"
#include "faqem/engine/mesh/collapse_mesh.hpp"
#include "faqem/engine/tracking/distance.hpp"
#include "faqem/export.hpp"

FAQEM_ENGINE_BEGIN

/// Original vertices that are tracked, and the vertex of the current mesh that each was merged into. Both
/// arrays have the same length.
struct TrackedVertices {
    std::vector<Index> original, current;
    /// Empty, or for each vertex of the original surface a face of the current mesh near it, or no_index.
    std::vector<Index> faces = {};

    /// Tracks all vertices that have a target. O(vertices)
    /// \param vertex_map  for each original vertex, the vertex of the current mesh it was merged into, or
    ///     no_index
    explicit TrackedVertices(std::span<const Index> vertex_map) {
        for (Index v = 0; v < vertex_map.size(); ++v)
            if (vertex_map[v] != no_index) add(v, vertex_map[v]);
    }
    TrackedVertices() = default;

    /// Adds a vertex.
    /// \param v       original vertex; larger than those added before
    /// \param target  vertex of the current mesh
    void add(Index v, Index target) {
        original.push_back(v);
        current.push_back(target);
    }
};

/// The original surface, with adjacency. Immutable after construction; const functions may be called from
/// several threads.
class OriginalSurface {
public:
    /// Finds the faces of each vertex and the boundary edges. O(triangles); 20 bytes per triangle, and 4
    /// per vertex if there is a boundary
    /// \param positions        one per vertex, engine units; borrowed
    /// \param triangles        indices into `positions`, pairwise different within a triangle; borrowed
    OriginalSurface(std::span<const Vector3> positions, std::span<const Triangle> triangles)
        : positions_(positions),
          triangles_(triangles),
          boundary_edges_(find_boundary_edges(triangles, positions.size())),
          face_offsets_(positions.size() + 1, 0) {
        for (const Triangle& t : triangles_)
            for (const Index v : t) ++face_offsets_[v + 1];
        std::partial_sum(face_offsets_.begin(), face_offsets_.end(), face_offsets_.begin());
        vertex_faces_.resize(face_offsets_.back());
        for (Index f = 0; f < triangles_.size(); ++f)
            for (const Index v : triangles_[f]) vertex_faces_[face_offsets_[v]++] = f;
        // Each offset has moved to the start of the next vertex.
        std::copy_backward(face_offsets_.begin(), face_offsets_.end() - 1, face_offsets_.end());
        face_offsets_.front() = 0;
        find_boundary_neighbours();
    }

    /// Position of vertex v.
    const Vector3& position(Index v) const { return positions_[v]; }
    /// The boundary edges, as returned by find_boundary_edges().
    std::span<const std::array<Index, 2>> boundary_edges() const { return boundary_edges_; }
    /// The boundary neighbours of vertex v, ascending.
    std::span<const Index> boundary_neighbours(Index v) const {
        if (boundary_edges_.empty()) return {};
        return std::span(boundary_neighbours_)
            .subspan(boundary_offsets_[v], boundary_offsets_[v + 1] - boundary_offsets_[v]);
    }

    /// Squared distance from p to the faces of vertex v. O(valence)
    /// \param at_most  returned if it is smaller
    double squared_distance_to_ring(Index v, const Vector3& p, double at_most) const {
        for (std::uint32_t i = face_offsets_[v]; i < face_offsets_[v + 1]; ++i) {
            const Triangle& t = triangles_[vertex_faces_[i]];
            const TriangleDistance distance(positions_[t[0]], positions_[t[1]], positions_[t[2]]);
            at_most = std::min(at_most, distance(p));
        }
        return at_most;
    }

private:
    // The edges are sorted, so that the neighbours of each vertex are, too.
    void find_boundary_neighbours() {
        if (boundary_edges_.empty()) return;
        boundary_offsets_.assign(positions_.size() + 1, 0);
        for (const auto& [a, b] : boundary_edges_) ++boundary_offsets_[a + 1], ++boundary_offsets_[b + 1];
        std::partial_sum(boundary_offsets_.begin(), boundary_offsets_.end(), boundary_offsets_.begin());
        boundary_neighbours_.resize(boundary_offsets_.back());
        for (const auto& [a, b] : boundary_edges_) {
            boundary_neighbours_[boundary_offsets_[a]++] = b;
            boundary_neighbours_[boundary_offsets_[b]++] = a;
        }
        std::copy_backward(boundary_offsets_.begin(), boundary_offsets_.end() - 1, boundary_offsets_.end());
        boundary_offsets_.front() = 0;
    }

    std::span<const Vector3> positions_;
    std::span<const Triangle> triangles_;
    std::vector<std::array<Index, 2>> boundary_edges_;
    std::vector<std::uint32_t> face_offsets_;  // start of the faces of each vertex in vertex_faces_
    std::vector<Index> vertex_faces_;
    // Start of the boundary neighbours of each vertex; empty if there is no boundary.
    std::vector<std::uint32_t> boundary_offsets_;
    std::vector<Index> boundary_neighbours_;
};

FAQEM_ENGINE_END

#pragma once
/// \file
/// The surface before the first collapse, and what has become of its vertices.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "faqem/engine/complex.hpp"
#include "faqem/engine/distance.hpp"
#include "faqem/engine/open_edges.hpp"

namespace faqem::engine {

/// Vertices of the original, and the vertex of a complex that each has gone into.
struct Lineage {
    std::vector<Index> original, today;

    /// Of all of them.
    /// \param into  for each original vertex, or no_index
    explicit Lineage(std::span<const Index> into) {
        for (Index v = 0; v < into.size(); ++v) {
            if (into[v] != no_index) add(v, into[v]);
        }
    }
    Lineage() = default;

    void add(Index v, Index into) {
        original.push_back(v);
        today.push_back(into);
    }
};

/// The surface that is simplified, as it was. Does not change; several engines may look at it.
class Original {
public:
    /// \param positions, triangles  borrowed; triangles of different corners
    /// \throws what the poll throws
    /// O(triangles); 20 bytes per triangle
    Original(std::span<const Vector3> positions, std::span<const Triangle> triangles, Poll poll = {})
        : positions_(positions),
          triangles_(triangles),
          open_edges_(find_open_edges(triangles, positions.size(), poll)),
          rings_(positions.size() + 1, 0) {
        for (const Triangle& t : triangles_) {
            for (const Index v : t) ++rings_[v + 1];
        }
        std::partial_sum(rings_.begin(), rings_.end(), rings_.begin());
        ring_faces_.resize(rings_.back());
        for (Index f = 0; f < triangles_.size(); ++f) {
            poll();
            for (const Index v : triangles_[f]) ring_faces_[rings_[v]++] = f;
        }
        // Each is where the next begins now.
        std::copy_backward(rings_.begin(), rings_.end() - 1, rings_.end());
        rings_.front() = 0;
    }

    const Vector3& position(Index v) const { return positions_[v]; }
    /// Edges with one face, as find_open_edges() gives them.
    std::span<const std::array<Index, 2>> open_edges() const { return open_edges_; }

    /// Squared distance of p to the faces around vertex v, or `at_most` where that is smaller. O(valence)
    double squared_distance_around(Index v, const Vector3& p, double at_most) const {
        for (std::uint32_t i = rings_[v]; i < rings_[v + 1]; ++i) {
            const Triangle& t = triangles_[ring_faces_[i]];
            const TriangleDistance distance(positions_[t[0]], positions_[t[1]], positions_[t[2]]);
            at_most = std::min(at_most, distance(p));
        }
        return at_most;
    }

private:
    std::span<const Vector3> positions_;
    std::span<const Triangle> triangles_;
    std::vector<std::array<Index, 2>> open_edges_;
    std::vector<std::uint32_t> rings_;  // where the faces of each vertex begin
    std::vector<Index> ring_faces_;
};

}  // namespace faqem::engine

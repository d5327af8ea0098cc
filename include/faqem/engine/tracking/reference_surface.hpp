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

#include "faqem/export.hpp"
#include "faqem/engine/mesh/triangle_soup.hpp"
#include "faqem/engine/tracking/distance.hpp"
#include "faqem/engine/mesh/boundary_edges.hpp"

FAQEM_NAMESPACE_BEGIN
namespace engine {

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
    /// O(triangles); 20 bytes per triangle, and 4 per vertex where there is a border
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
        find_open_ends(poll);
    }

    const Vector3& position(Index v) const { return positions_[v]; }
    /// Edges with one face, as find_open_edges() gives them.
    std::span<const std::array<Index, 2>> open_edges() const { return open_edges_; }
    /// The other ends of these edges at vertex v, ascending.
    std::span<const Index> open_ends(Index v) const {
        if (open_edges_.empty()) return {};
        return std::span(open_ends_).subspan(open_rings_[v], open_rings_[v + 1] - open_rings_[v]);
    }

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
    // The edges are in order, so that each vertex gets the smaller ends first.
    void find_open_ends(Poll poll) {
        if (open_edges_.empty()) return;
        open_rings_.assign(positions_.size() + 1, 0);
        for (const auto& [a, b] : open_edges_) ++open_rings_[a + 1], ++open_rings_[b + 1];
        std::partial_sum(open_rings_.begin(), open_rings_.end(), open_rings_.begin());
        open_ends_.resize(open_rings_.back());
        for (const auto& [a, b] : open_edges_) {
            poll();
            open_ends_[open_rings_[a]++] = b;
            open_ends_[open_rings_[b]++] = a;
        }
        std::copy_backward(open_rings_.begin(), open_rings_.end() - 1, open_rings_.end());
        open_rings_.front() = 0;
    }

    std::span<const Vector3> positions_;
    std::span<const Triangle> triangles_;
    std::vector<std::array<Index, 2>> open_edges_;
    std::vector<std::uint32_t> rings_;  // where the faces of each vertex begin
    std::vector<Index> ring_faces_;
    std::vector<std::uint32_t> open_rings_;  // where the open ends of each vertex begin; empty: no border
    std::vector<Index> open_ends_;
};

}  // namespace engine
FAQEM_NAMESPACE_END

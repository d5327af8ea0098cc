#pragma once
/// \file
/// Vertices for corners of polygons that share a position but differ in other values.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "asset/scene/part_arrays.hpp"
#include "asset/scene/value_numbers.hpp"
#include "faqem/mesh.hpp"

namespace faqem::detail {

/// Indices of the position and of two other values of a corner; no_index for a value that it does not have.
using CornerKey = std::array<Index, 3>;

/// Assigns vertices to distinct corners. Vertex i is position i with the values of its first corner; other
/// combinations get vertices after these, in the order of the corners.
class CornerVertices {
public:
    /// \param positions  number of positions
    explicit CornerVertices(std::size_t positions)
        : first_(positions, {no_index, no_index}), seen_(positions, 0) {}

    /// Returns the vertex of a corner.
    /// \pre count() <= max_index_count
    Index vertex(const CornerKey& c) {
        std::array<Index, 2>& first = first_[c[0]];
        if (!seen_[c[0]]) {
            seen_[c[0]] = 1;
            first = {c[1], c[2]};
        }
        if (first[0] == c[1] && first[1] == c[2]) return c[0];
        return static_cast<Index>(first_.size() + extra_.insert(c));
    }

    /// Number of vertices.
    std::uint64_t count() const { return first_.size() + extra_.values().size(); }

    /// Indices of the position and the other values of vertex v.
    CornerKey corner(std::size_t v) const {
        if (v >= first_.size()) return extra_.values()[v - first_.size()];
        return {static_cast<Index>(v), first_[v][0], first_[v][1]};
    }

private:
    std::vector<std::array<Index, 2>> first_;  // values of the first corner at each position
    std::vector<std::uint8_t> seen_;
    UniqueValues<CornerKey> extra_;
};

/// Gives a part the vertices of corners: those after its own have the values of the vertex at their position.
inline void add_corner_vertices(Part& part, const CornerVertices& vertices) {
    visit_vertex_arrays(
        [&](const VertexArray&, auto& values) {
            const std::size_t old = values.size();
            if (old > 0) values.resize(vertices.count());
            for (std::size_t v = old; v < values.size(); ++v) values[v] = values[vertices.corner(v)[0]];
        },
        part);
}

}  // namespace faqem::detail

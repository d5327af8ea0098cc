#pragma once
/// \file
/// The faces around each vertex of the original.

#include <span>
#include <vector>

#include "faqem/mesh.hpp"

namespace faqem::detail {

/// Faces by vertex, ascending.
class FaceRings {
public:
    /// \param vertices   number of vertices
    /// \param triangles  over them; three no_index: no face
    /// O(vertices + faces)
    FaceRings(std::size_t vertices, std::span<const Triangle> triangles) : begin_(vertices + 1, 0) {
        for (const Triangle& t : triangles) {
            if (t[0] == no_index) continue;
            for (const Index v : t) ++begin_[v + 1];
        }
        for (std::size_t v = 0; v < vertices; ++v) begin_[v + 1] += begin_[v];
        faces_.resize(begin_[vertices]);
        std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
        for (std::size_t f = 0; f < triangles.size(); ++f) {
            if (triangles[f][0] == no_index) continue;
            for (const Index v : triangles[f]) faces_[next[v]++] = static_cast<Index>(f);
        }
    }

    std::span<const Index> at(Index v) const {
        return std::span(faces_).subspan(begin_[v], begin_[v + 1] - begin_[v]);
    }

private:
    std::vector<std::size_t> begin_;
    std::vector<Index> faces_;
};

}  // namespace faqem::detail

#pragma once
/// \file
/// The faces around each vertex of a mesh that stays as it is.

#include <cstddef>
#include <span>
#include <vector>

#include "faqem/mesh.hpp"

namespace faqem::detail {

/// The faces around each vertex, in their order.
class FacesAround {
public:
    FacesAround() = default;
    /// \param vertices   their number
    /// \param triangles  a triangle with no_index corners is none
    /// O(vertices + faces)
    FacesAround(std::size_t vertices, std::span<const Triangle> triangles) : begin_(vertices + 1, 0) {
        for (const Triangle& t : triangles) {
            if (t[0] == no_index) continue;
            for (const Index v : t) ++begin_[v];
        }
        std::size_t end = 0;
        for (std::size_t& begin : begin_) begin = end += begin;
        faces_.resize(end);
        for (std::size_t f = triangles.size(); f-- > 0;) {
            if (triangles[f][0] == no_index) continue;
            for (const Index v : triangles[f]) faces_[--begin_[v]] = static_cast<Index>(f);
        }
    }

    std::span<const Index> operator[](Index v) const {
        return std::span(faces_).subspan(begin_[v], begin_[v + std::size_t{1}] - begin_[v]);
    }

private:
    std::vector<std::size_t> begin_;
    std::vector<Index> faces_;
};

}  // namespace faqem::detail

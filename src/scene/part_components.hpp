#pragma once
/// \file
/// Connected components of all parts of a scene, numbered one after the other.

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "faqem/asset.hpp"
#include "faqem/detail/measure/removed_components.hpp"

namespace faqem::detail {

/// Components of the parts of a scene, with vertices at equal positions joined.
struct PartComponents {
    std::vector<std::vector<Index>> of_face;  ///< by part and face
    std::vector<Index> first;                 ///< by part: its first component
    Index count = 0;

    /// The part of a component.
    std::size_t part_of(Index component) const {
        return static_cast<std::size_t>(std::upper_bound(first.begin(), first.end(), component) -
                                        first.begin()) -
               1;
    }
};

/// Finds the components of all parts.
/// Complexity: O(vertices log vertices + faces)
inline PartComponents part_components(const Asset& source) {
    PartComponents result;
    for (const Part& part : source.parts) {
        FaceComponents found = face_components(part.positions, part.triangles);
        for (Index& component : found.component) component += result.count;
        result.first.push_back(result.count);
        result.count += found.count;
        result.of_face.push_back(std::move(found.component));
    }
    return result;
}

}  // namespace faqem::detail

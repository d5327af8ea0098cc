#pragma once
/// \file
/// Faces that lie on others.

#include <algorithm>
#include <utility>
#include <vector>

#include "faqem/export.hpp"
#include "faqem/engine/mesh/triangle_soup.hpp"

FAQEM_NAMESPACE_BEGIN
namespace engine {

/// The living faces with the corners and the winding of one before them, ascending. Without them the surface
/// is the same. O(n log n)
/// \throws what the poll throws
inline std::vector<Index> double_faces(const Complex& complex, Poll poll = {}) {
    std::vector<std::pair<Triangle, Index>> faces;
    for (Index f = 0; f < complex.face_slots(); ++f) {
        poll();
        if (!complex.alive(f)) continue;
        Triangle t = complex.triangle(f);
        std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
        faces.emplace_back(t, f);
    }
    std::sort(faces.begin(), faces.end(), polled_less(poll));
    std::vector<Index> doubles;
    for (std::size_t i = 1; i < faces.size(); ++i) {
        if (faces[i].first == faces[i - 1].first) doubles.push_back(faces[i].second);
    }
    std::sort(doubles.begin(), doubles.end());
    return doubles;
}

}  // namespace engine
FAQEM_NAMESPACE_END

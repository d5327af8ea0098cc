#pragma once
/// \file
/// Faces that lie on others.

#include <algorithm>
#include <utility>
#include <vector>

#include "faqem/engine/mesh/collapse_mesh.hpp"
#include "faqem/export.hpp"

FAQEM_NAMESPACE_BEGIN
namespace engine {

/// The living faces with the corners and the winding of one before them, ascending. Without them the surface
/// is the same. O(n log n)
/// \throws what the poll throws
inline std::vector<Index> duplicate_faces(const CollapseMesh& mesh, CancellationCheck check_cancelled = {}) {
    std::vector<std::pair<Triangle, Index>> faces;
    for (Index f = 0; f < mesh.face_slots(); ++f) {
        check_cancelled();
        if (!mesh.is_alive(f)) continue;
        Triangle t = mesh.triangle(f);
        std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
        faces.emplace_back(t, f);
    }
    std::sort(faces.begin(), faces.end(), cancellable_less(check_cancelled));
    std::vector<Index> duplicates;
    for (std::size_t i = 1; i < faces.size(); ++i) {
        if (faces[i].first == faces[i - 1].first) duplicates.push_back(faces[i].second);
    }
    std::sort(duplicates.begin(), duplicates.end());
    return duplicates;
}

}  // namespace engine
FAQEM_NAMESPACE_END

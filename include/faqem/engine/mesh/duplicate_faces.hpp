#pragma once
/// \file
/// Detection of duplicate faces.

#include <algorithm>
#include <utility>
#include <vector>

#include "faqem/engine/mesh/collapse_mesh.hpp"
#include "faqem/engine/mesh/pair_table.hpp"
#include "faqem/export.hpp"

FAQEM_ENGINE_BEGIN

/// Finds faces with the same vertices and winding as a face of lower index. Removing them does not change
/// the surface. O(n log n)
/// \param mesh             removed faces are ignored
/// \return indices of the duplicate faces, ascending
inline std::vector<Index> duplicate_faces(const CollapseMesh& mesh) {
    std::vector<std::pair<Triangle, Index>> faces;
    for (Index f = 0; f < mesh.face_slots(); ++f) {
        if (!mesh.is_alive(f)) continue;
        Triangle t = mesh.triangle(f);
        std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
        faces.emplace_back(t, f);
    }
    std::sort(faces.begin(), faces.end());
    std::vector<Index> duplicates;
    for (std::size_t i = 1; i < faces.size(); ++i)
        if (faces[i].first == faces[i - 1].first) duplicates.push_back(faces[i].second);
    std::sort(duplicates.begin(), duplicates.end());
    return duplicates;
}

/// Removes duplicate_faces() until the target is reached.
/// \param recorder  notified before each deletion
/// \return whether any was removed
template <class Recorder>
bool remove_duplicate_faces(CollapseMesh& mesh, PairTable& pairs, std::size_t target_faces,
                            Recorder& recorder) {
    const std::size_t before = mesh.face_count();
    for (const Index f : duplicate_faces(mesh)) {
        if (mesh.face_count() <= target_faces) break;
        const Triangle corners = mesh.triangle(f);
        recorder.before_deletion(f);
        mesh.remove_face(f);
        pairs.after_face_removal(mesh, corners);
    }
    return mesh.face_count() < before;
}

FAQEM_ENGINE_END

#pragma once
/// \file
/// Collapse histories with given collapses, recorded by brute force over all faces.

#include <vector>

#include "faqem/history.hpp"

namespace faqem::test {

/// Records given collapses of an original mesh.
class HandHistory {
public:
    HandHistory(std::vector<Vec3> positions, std::vector<Triangle> triangles, std::vector<Index> groups = {})
        : now_(triangles), alive_(triangles.size(), true) {
        history_.positions = std::move(positions);
        history_.triangles = std::move(triangles);
        history_.face_groups = std::move(groups);
        history_.patch_begin = {0};
    }

    /// Collapses versions a and b. \return the new version
    Index collapse(Index a, Index b, const Vec3& position) {
        const Index made = static_cast<Index>(history_.positions.size() + history_.collapses.size());
        history_.collapses.push_back({a, b, position});
        for (Index f = 0; f < now_.size(); ++f) {
            Triangle& t = now_[f];
            bool touched = false;
            for (Index v : t) touched = touched || v == a || v == b;
            if (!alive_[f] || !touched) continue;
            history_.patch_faces.push_back(f);
            for (Index& v : t) v = v == a || v == b ? made : v;
            alive_[f] = t[0] != t[1] && t[1] != t[2] && t[2] != t[0];
        }
        history_.patch_begin.push_back(history_.patch_faces.size());
        return made;
    }

    /// The history, with the remaining faces as the simplified mesh.
    CollapseHistory finish() {
        std::vector<bool> used(history_.positions.size() + history_.collapses.size(), false);
        for (Index f = 0; f < now_.size(); ++f) {
            if (!alive_[f]) continue;
            history_.remaining_faces.push_back(f);
            for (Index v : now_[f]) used[v] = true;
        }
        for (Index v = 0; v < used.size(); ++v) {
            if (used[v]) history_.remaining_versions.push_back(v);
        }
        return history_;
    }

    /// Current corner versions of an input face.
    const Triangle& corners(Index f) const { return now_[f]; }

private:
    CollapseHistory history_;
    std::vector<Triangle> now_;
    std::vector<bool> alive_;
};

/// The simplified mesh of a finished history.
inline TriangleMesh small_mesh(const CollapseHistory& history) {
    TriangleMesh mesh;
    std::vector<Index> number(history.positions.size() + history.collapses.size(), no_index);
    for (Index v : history.remaining_versions) {
        number[v] = static_cast<Index>(mesh.positions.size());
        mesh.positions.push_back(history.position(v));
    }
    for (Index f : history.remaining_faces) {
        Triangle t = history.triangles[f];
        for (std::size_t k = 0; k < history.collapses.size(); ++k) {
            const Collapse& c = history.collapses[k];
            for (Index& v : t) {
                if (v == c.first || v == c.second) v = static_cast<Index>(history.positions.size() + k);
            }
        }
        mesh.triangles.push_back({number[t[0]], number[t[1]], number[t[2]]});
        if (!history.face_groups.empty()) mesh.face_groups.push_back(history.face_groups[f]);
    }
    return mesh;
}

}  // namespace faqem::test

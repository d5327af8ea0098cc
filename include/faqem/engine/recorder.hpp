#pragma once
/// \file
/// Recorders are notified of every collapse before it happens.

#include <span>
#include <utility>
#include <vector>

#include "faqem/engine/mesh/collapse_mesh.hpp"
#include "faqem/engine/quadric/placement.hpp"
#include "faqem/export.hpp"
#include "faqem/history.hpp"

FAQEM_ENGINE_BEGIN

/// Receives the collapses and deletions of an Engine.
template <class R>
concept CollapseRecorder = requires(R recorder, const CollapseMesh& mesh, Index survivor, Index removed,
                                    const Candidate& to, Index face) {
    // Called before `survivor` and `removed` are merged into `survivor` at to.point; the mesh is still
    // unchanged.
    {recorder.before_collapse(mesh, survivor, removed, to)};
    // Called before a face is deleted that is not part of a collapse.
    {recorder.before_deletion(face)};
};

/// Records nothing. Compiles to no code.
struct NoRecorder {
    void before_collapse(const CollapseMesh&, Index, Index, const Candidate&) {}
    void before_deletion(Index) {}
};

/// Records a CollapseHistory. Positions are in engine units.
class HistoryRecorder {
public:
    /// \param vertices           history index of each vertex slot of the mesh
    /// \param faces              history index of each face slot
    /// \param first_new_version  history index of the vertex that the first collapse creates; further
    ///     collapses get the following indices
    HistoryRecorder(std::vector<Index> vertices, std::vector<Index> faces, Index first_new_version)
        : version_(std::move(vertices)), faces_(std::move(faces)), first_new_version_(first_new_version) {
        history_.patch_begin.push_back(0);
    }

    /// Uses the slot numbers of `mesh` as history indices. New vertices are numbered from the number of
    /// vertex slots on. O(vertices + faces)
    explicit HistoryRecorder(const CollapseMesh& mesh)
        : HistoryRecorder(all_indices(mesh.vertex_slots()), all_indices(mesh.face_slots()),
                          static_cast<Index>(mesh.vertex_slots())) {}

    /// Records a collapse and the faces around the pair. O(valence)
    void before_collapse(const CollapseMesh& mesh, Index survivor, Index removed, const Candidate& to) {
        mesh.for_each_face_around(survivor, removed,
                                  [&](Index f, unsigned) { history_.patch_faces.push_back(faces_[f]); });
        add(survivor, removed, to.point);
    }

    /// Reserves memory.
    /// \param collapses  number of further collapses
    /// \param faces      total number of faces around the pairs of these collapses
    void reserve(std::size_t collapses, std::size_t faces) {
        history_.collapses.reserve(history_.collapses.size() + collapses);
        history_.patch_begin.reserve(history_.patch_begin.size() + collapses);
        history_.patch_faces.reserve(history_.patch_faces.size() + faces);
    }

    /// Records a collapse with the given faces. O(size of `patch`)
    /// \param survivor, removed  vertex slots
    /// \param to                 position of the new vertex
    /// \param patch              slots of the faces that contain one of the vertices or both
    void add_collapse(Index survivor, Index removed, const Vector3& to, std::span<const Index> patch) {
        for (const Index f : patch) history_.patch_faces.push_back(faces_[f]);
        add(survivor, removed, to);
    }

    /// Records the deletion of a face. O(1)
    void before_deletion(Index face) {
        history_.deleted_faces.push_back({history_.collapses.size(), faces_[face]});
    }

    /// Continues with another mesh, whose slots are a subset of the current ones. O(new slots)
    /// \param vertices  for each vertex slot of the new mesh, its slot in the current mesh
    /// \param faces     likewise for face slots
    void renumber(std::span<const Index> vertices, std::span<const Index> faces) {
        std::vector<Index> version(vertices.begin(), vertices.end()), left(faces.begin(), faces.end());
        for (Index& slot : version) slot = version_[slot];
        for (Index& slot : left) slot = faces_[slot];
        version_ = std::move(version);
        faces_ = std::move(left);
    }

    /// Current history index of a vertex slot.
    Index version(Index slot) const { return version_[slot]; }

    /// The collapses, their patches and the deleted faces recorded so far. The other members are empty.
    const CollapseHistory& history() const { return history_; }

    /// Moves the recorded history out of the recorder. The caller must fill the other members.
    CollapseHistory take() { return std::move(history_); }

private:
    void add(Index survivor, Index removed, const Vector3& to) {
        const auto count = static_cast<Index>(history_.collapses.size());
        history_.collapses.push_back({version_[survivor], version_[removed], to_array(to)});
        history_.patch_begin.push_back(history_.patch_faces.size());
        version_[survivor] = first_new_version_ + count;
    }

    CollapseHistory history_;
    std::vector<Index> version_;  // history index of each vertex slot
    std::vector<Index> faces_;    // history index of each face slot
    Index first_new_version_;
};

static_assert(CollapseRecorder<NoRecorder> && CollapseRecorder<HistoryRecorder>);

FAQEM_ENGINE_END

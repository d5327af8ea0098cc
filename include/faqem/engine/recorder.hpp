#pragma once
/// \file
/// Recorders see every collapse before it happens. NoRecorder compiles to nothing.

#include <concepts>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "faqem/engine/mesh/collapse_mesh.hpp"
#include "faqem/engine/quadric/placement.hpp"
#include "faqem/export.hpp"
#include "faqem/history.hpp"

FAQEM_NAMESPACE_BEGIN
namespace engine {

template <class R>
concept CollapseRecorder = requires(R recorder, const CollapseMesh& mesh, Index survivor, Index removed,
                                    const Candidate& to, Index face) {
    // Both are about to become `survivor` at to.point; the complex is still as before.
    {recorder.before_collapse(mesh, survivor, removed, to)};
    // The face goes with its component.
    {recorder.before_deletion(face)};
};

/// Records nothing, at no cost.
struct NoRecorder {
    void before_collapse(const CollapseMesh&, Index, Index, const Candidate&) {}
    void before_deletion(Index) {}
};

/// Records the collapse history, in engine units.
class HistoryRecorder {
public:
    /// \param vertices  what the history calls the vertex slots of the complex
    /// \param faces     what it calls its face slots
    /// \param first_new_version     what it calls the vertex that the first collapse makes; the next ones follow
    HistoryRecorder(std::vector<Index> vertices, std::vector<Index> faces, Index first_new_version)
        : version_(std::move(vertices)), faces_(std::move(faces)), first_new_version_(first_new_version) {
        history_.patch_begin.push_back(0);
    }

    /// Calls the slots by their numbers.
    explicit HistoryRecorder(const CollapseMesh& mesh)
        : HistoryRecorder(identity(mesh.vertex_slots()), identity(mesh.face_slots()),
                          static_cast<Index>(mesh.vertex_slots())) {}

    void before_collapse(const CollapseMesh& mesh, Index survivor, Index removed, const Candidate& to) {
        mesh.for_each_face_around(survivor, removed,
                                  [&](Index f, unsigned) { history_.patch_faces.push_back(faces_[f]); });
        add(survivor, removed, to.point);
    }

    /// Makes room for more collapses with so many faces around them, together.
    void reserve(std::size_t collapses, std::size_t faces) {
        history_.collapses.reserve(history_.collapses.size() + collapses);
        history_.patch_begin.reserve(history_.patch_begin.size() + collapses);
        history_.patch_faces.reserve(history_.patch_faces.size() + faces);
    }

    /// Records a collapse whose faces are known.
    /// \param patch  face slots with one of both vertices
    void add_collapse(Index survivor, Index removed, const Vector3& to, std::span<const Index> patch) {
        for (const Index f : patch) history_.patch_faces.push_back(faces_[f]);
        add(survivor, removed, to);
    }

    void before_deletion(Index face) {
        history_.deleted_faces.push_back({history_.collapses.size(), faces_[face]});
    }

    /// Goes on with another complex.
    /// \param vertices, faces  the slots that its slots were
    void renumber(std::span<const Index> vertices, std::span<const Index> faces) {
        const auto take = [](std::vector<Index>& of, std::span<const Index> slots) {
            std::vector<Index> taken;
            taken.reserve(slots.size());
            for (const Index slot : slots) taken.push_back(of[slot]);
            of = std::move(taken);
        };
        take(version_, vertices);
        take(faces_, faces);
    }

    /// What the history calls the vertex that a slot is now.
    Index version(Index slot) const { return version_[slot]; }

    /// The collapses, their patches and the deleted faces so far.
    const CollapseHistory& history() const { return history_; }

    /// Gives away the collapses, their patches and the deleted faces; the rest is the caller's to fill.
    CollapseHistory take() { return std::move(history_); }

private:
    static std::vector<Index> identity(std::size_t count) {
        std::vector<Index> result(count);
        std::iota(result.begin(), result.end(), Index{0});
        return result;
    }

    void add(Index survivor, Index removed, const Vector3& to) {
        const auto count = static_cast<Index>(history_.collapses.size());
        history_.collapses.push_back({version_[survivor], version_[removed], to_array(to)});
        history_.patch_begin.push_back(history_.patch_faces.size());
        version_[survivor] = first_new_version_ + count;
    }

    CollapseHistory history_;
    std::vector<Index> version_;  // of each vertex slot
    std::vector<Index> faces_;    // of each face slot
    Index first_new_version_;
};

static_assert(CollapseRecorder<NoRecorder> && CollapseRecorder<HistoryRecorder>);

}  // namespace engine
FAQEM_NAMESPACE_END

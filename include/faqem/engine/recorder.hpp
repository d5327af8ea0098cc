#pragma once
/// \file
/// Recorders see every collapse before it happens. NoRecorder compiles to nothing.

#include <concepts>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "faqem/export.hpp"
#include "faqem/engine/mesh/triangle_soup.hpp"
#include "faqem/engine/quadric/placement.hpp"
#include "faqem/history.hpp"

FAQEM_NAMESPACE_BEGIN
namespace engine {

template <class R>
concept CollapseRecorder = requires(R recorder, const Complex& complex, Index survivor, Index gone,
                                    const Candidate& to, Index face) {
    // Both are about to become `survivor` at to.point; the complex is still as before.
    {recorder.collapsing(complex, survivor, gone, to)};
    // The face goes with its component.
    {recorder.deleting(face)};
};

/// Records nothing, at no cost.
struct NoRecorder {
    void collapsing(const Complex&, Index, Index, const Candidate&) {}
    void deleting(Index) {}
};

/// Records the collapse history, in engine units.
class HistoryRecorder {
public:
    /// \param vertices  what the history calls the vertex slots of the complex
    /// \param faces     what it calls its face slots
    /// \param fresh     what it calls the vertex that the first collapse makes; the next ones follow
    HistoryRecorder(std::vector<Index> vertices, std::vector<Index> faces, Index fresh)
        : version_(std::move(vertices)), faces_(std::move(faces)), fresh_(fresh) {
        history_.patch_begin.push_back(0);
    }

    /// Calls the slots by their numbers.
    explicit HistoryRecorder(const Complex& complex)
        : HistoryRecorder(numbers(complex.vertex_slots()), numbers(complex.face_slots()),
                          static_cast<Index>(complex.vertex_slots())) {}

    void collapsing(const Complex& complex, Index survivor, Index gone, const Candidate& to) {
        complex.for_each_face_around(survivor, gone,
                                     [&](Index f, unsigned) { history_.patch_faces.push_back(faces_[f]); });
        add(survivor, gone, to.point);
    }

    /// Makes room for more collapses with so many faces around them, together.
    void reserve(std::size_t collapses, std::size_t faces) {
        history_.collapses.reserve(history_.collapses.size() + collapses);
        history_.patch_begin.reserve(history_.patch_begin.size() + collapses);
        history_.patch_faces.reserve(history_.patch_faces.size() + faces);
    }

    /// Records a collapse whose faces are known.
    /// \param patch  face slots with one of both vertices
    void collapsed(Index survivor, Index gone, const Vector3& to, std::span<const Index> patch) {
        for (const Index f : patch) history_.patch_faces.push_back(faces_[f]);
        add(survivor, gone, to);
    }

    void deleting(Index face) { history_.deleted_faces.push_back({history_.collapses.size(), faces_[face]}); }

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
    const CollapseHistory& so_far() const { return history_; }

    /// Gives away the collapses, their patches and the deleted faces; the rest is the caller's to fill.
    CollapseHistory take() { return std::move(history_); }

private:
    static std::vector<Index> numbers(std::size_t count) {
        std::vector<Index> result(count);
        std::iota(result.begin(), result.end(), Index{0});
        return result;
    }

    void add(Index survivor, Index gone, const Vector3& to) {
        const auto count = static_cast<Index>(history_.collapses.size());
        history_.collapses.push_back({version_[survivor], version_[gone], to_array(to)});
        history_.patch_begin.push_back(history_.patch_faces.size());
        version_[survivor] = fresh_ + count;
    }

    CollapseHistory history_;
    std::vector<Index> version_;  // of each vertex slot
    std::vector<Index> faces_;    // of each face slot
    Index fresh_;
};

static_assert(CollapseRecorder<NoRecorder> && CollapseRecorder<HistoryRecorder>);

}  // namespace engine
FAQEM_NAMESPACE_END

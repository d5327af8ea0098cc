#pragma once
/// \file
/// The curves along which faces of different groups (materials) meet, kept while the surface is simplified.
///
/// Together with the open edges they touch they are a graph on the surface. A collapse must not tear it,
/// close it up, or move one of its nodes: places where it branches, ends, or meets an open border.

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "faqem/export.hpp"
#include "faqem/engine/mesh/triangle_soup.hpp"
#include "faqem/engine/mesh/pair_table.hpp"
#include "faqem/engine/quadric/placement.hpp"
#include "faqem/engine/util/hash.hpp"

FAQEM_NAMESPACE_BEGIN
namespace engine {

/// Which vertices are on a curve, and what may be done to them. Empty (no memory, no rule) where none is to
/// be kept.
class GroupCurves {
public:
    GroupCurves() = default;

    /// \param groups  empty, or one per face slot; borrowed, must outlive this
    /// \throws what the poll throws
    GroupCurves(const Complex& complex, std::span<const Index> groups, Poll poll = {}) : groups_(groups) {
        if (groups.empty()) return;
        is_on_curve_.assign(complex.vertex_slots(), 0);
        mark_.assign(complex.vertex_slots(), 0);
        for (Index v = 0; v < complex.vertex_slots(); ++v) {
            poll();
            Index first = no_index;
            is_on_curve_[v] = !complex.all_faces(v, [&](Index f, unsigned) {
                if (first == no_index) first = f;
                return groups_[f] == groups_[first];
            });
        }
        if (std::count(is_on_curve_.begin(), is_on_curve_.end(), 1) == 0) *this = {};
    }

    bool empty() const { return groups_.empty(); }
    /// Is v on a curve, or was it? Never, when empty.
    bool has(Index v) const { return !is_on_curve_.empty() && is_on_curve_[v]; }
    /// Are two faces of different groups? Never, when empty.
    bool differ(Index f, Index g) const { return !groups_.empty() && groups_[f] != groups_[g]; }

    /// Calls visit(face, neighbour) for each face on an edge (v, neighbour) where groups meet.
    /// O(valence squared)
    template <class Visit>
    void for_each_edge(const Complex& complex, Index v, Visit&& visit) const {
        complex.for_each_face(v, [&](Index f, unsigned corner) {
            for (unsigned k = 1; k < 3; ++k) {
                End end{complex.triangle(f)[(corner + k) % 3], groups_[f]};
                complex.for_each_face(v, [&](Index g, unsigned) {
                    if (complex.has_corner(g, end.vertex)) end.add(groups_[g]);
                });
                if (end.is_on_curve()) visit(f, end.vertex);
            }
        });
    }

    /// Where the pair (u, v) may go. O(valence) next to curves, else O(1).
    Freedom freedom(const Complex& complex, const PairTable& pairs, Index u, Index v) {
        if (empty()) return Freedom::anywhere;
        // Without curves an edge has one group on all sides; the ends of a virtual pair may have two.
        if (!has(u) && !has(v)) return same_group(complex, u, v) ? Freedom::anywhere : Freedom::nowhere;
        shared_.clear();
        complex.for_each_face(u, [&](Index f, unsigned) {
            if (complex.has_corner(f, v)) shared_.push_back(groups_[f]);
        });
        if (shared_.empty()) return Freedom::nowhere;
        const bool u_stays = has(u) && (is_node(complex, pairs, u) || has_other_group(complex, u));
        const bool v_stays = has(v) && (is_node(complex, pairs, v) || has_other_group(complex, v));
        if (u_stays && v_stays) return Freedom::nowhere;
        if (closes_a_loop(complex, u, v)) return Freedom::nowhere;
        return u_stays ? Freedom::at_first : v_stays ? Freedom::at_second : Freedom::anywhere;
    }

    /// u and v are about to become u.
    void collapsing(Index u, Index v) {
        if (!empty()) is_on_curve_[u] |= is_on_curve_[v];
    }

private:
    /// An edge from the vertex in hand.
    struct End {
        Index vertex, group;       ///< the group of one of its faces
        std::uint32_t faces = 0;   ///< it has
        bool has_others = false;   ///< groups
        std::uint64_t parity = 0;  ///< 0 where each group has an even number of faces, and else but by chance
        void add(Index other) {
            ++faces;
            has_others |= other != group;
            parity ^= scrambled((std::uint64_t{other} + 1) * 0x9e3779b97f4a7c15u);
        }
        /// Where all groups go on, as in sheets that lie back to back, none has a border.
        bool is_on_curve() const { return has_others && parity != 0; }
        bool is_in_graph() const { return faces == 1 || is_on_curve(); }
    };

    bool same_group(const Complex& complex, Index u, Index v) const {
        const auto group = [&](Index w) {
            Index first = no_index;
            complex.all_faces(w, [&](Index f, unsigned) { return first = f, false; });
            return groups_[first];
        };
        return group(u) == group(v);
    }

    bool has_other_group(const Complex& complex, Index v) const {
        return !complex.all_faces(v, [&](Index f, unsigned) {
            return std::find(shared_.begin(), shared_.end(), groups_[f]) != shared_.end();
        });
    }

    // Does the graph do anything else at v than go by or through?
    bool is_node(const Complex& complex, const PairTable& pairs, Index v) {
        look_around(complex, v);
        const auto degree =
            std::count_if(ring_.begin(), ring_.end(), [](const End& end) { return end.is_on_curve(); });
        return degree > 0 && (degree != 2 || pairs.boundary_degree(v) > 0);
    }

    // Do edges of the graph from u and from v meet at a third vertex? The collapse would make one of two, and
    // what they enclose would go.
    bool closes_a_loop(const Complex& complex, Index u, Index v) {
        look_around(complex, u);
        std::swap(ring_, around_u_);
        look_around(complex, v);
        for (Index i = 0; i < ring_.size(); ++i) mark_[ring_[i].vertex] = i + 1;
        const bool closes = std::any_of(around_u_.begin(), around_u_.end(), [&](const End& end) {
            const Index at = mark_[end.vertex];
            if (at == 0 || !end.is_in_graph() || !ring_[at - 1].is_in_graph()) return false;
            return end.is_on_curve() || ring_[at - 1].is_on_curve();
        });
        for (const End& end : ring_) mark_[end.vertex] = 0;
        return closes;
    }

    // Fills ring_ with the edges at v.
    void look_around(const Complex& complex, Index v) {
        ring_.clear();
        complex.for_each_face(v, [&](Index f, unsigned corner) {
            const Triangle& t = complex.triangle(f);
            for (unsigned k = 1; k < 3; ++k) {
                Index& at = mark_[t[(corner + k) % 3]];
                if (at == 0) {
                    ring_.push_back({t[(corner + k) % 3], groups_[f]});
                    at = static_cast<Index>(ring_.size());
                }
                ring_[at - 1].add(groups_[f]);
            }
        });
        for (const End& end : ring_) mark_[end.vertex] = 0;
    }

    std::span<const Index> groups_;
    std::vector<std::uint8_t> is_on_curve_;
    std::vector<Index> shared_;         // groups of the pair in hand
    std::vector<End> ring_, around_u_;  // edges of the vertex in hand
    std::vector<Index> mark_;           // 1 + place in a ring, while looking around; else 0
};

}  // namespace engine
FAQEM_NAMESPACE_END

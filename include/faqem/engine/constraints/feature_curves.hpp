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

#include "faqem/engine/mesh/collapse_mesh.hpp"
#include "faqem/engine/mesh/pair_table.hpp"
#include "faqem/engine/quadric/placement.hpp"
#include "faqem/engine/util/hash.hpp"
#include "faqem/export.hpp"

FAQEM_NAMESPACE_BEGIN
namespace engine {

/// Which vertices are on a curve, and what may be done to them. Empty (no memory, no rule) where none is to
/// be kept.
class FeatureCurves {
public:
    FeatureCurves() = default;

    /// \param groups  empty, or one per face slot; borrowed, must outlive this
    /// \throws what the poll throws
    FeatureCurves(const CollapseMesh& mesh, std::span<const Index> groups,
                  CancellationCheck check_cancelled = {})
        : groups_(groups) {
        if (groups.empty()) return;
        is_on_curve_.assign(mesh.vertex_slots(), 0);
        mark_.assign(mesh.vertex_slots(), 0);
        for (Index v = 0; v < mesh.vertex_slots(); ++v) {
            check_cancelled();
            Index first = no_index;
            is_on_curve_[v] = !mesh.all_of_faces(v, [&](Index f, unsigned) {
                if (first == no_index) first = f;
                return groups_[f] == groups_[first];
            });
        }
        if (std::count(is_on_curve_.begin(), is_on_curve_.end(), 1) == 0) *this = {};
    }

    bool empty() const { return groups_.empty(); }
    /// Is v on a curve, or was it? Never, when empty.
    bool has_vertex(Index v) const { return !is_on_curve_.empty() && is_on_curve_[v]; }
    /// Are two faces of different groups? Never, when empty.
    bool are_different_groups(Index f, Index g) const { return !groups_.empty() && groups_[f] != groups_[g]; }

    /// Calls visit(face, neighbour) for each face on an edge (v, neighbour) where groups meet.
    /// O(valence squared)
    template <class Visit>
    void for_each_curve_edge(const CollapseMesh& mesh, Index v, Visit&& visit) const {
        mesh.for_each_face(v, [&](Index f, unsigned corner) {
            for (unsigned k = 1; k < 3; ++k) {
                IncidentEdge end{mesh.triangle(f)[(corner + k) % 3], groups_[f]};
                mesh.for_each_face(v, [&](Index g, unsigned) {
                    if (mesh.has_corner(g, end.vertex)) end.add(groups_[g]);
                });
                if (end.is_on_curve()) visit(f, end.vertex);
            }
        });
    }

    /// Where the pair (u, v) may go. O(valence) next to curves, else O(1).
    AllowedPosition allowed_position(const CollapseMesh& mesh, const PairTable& pairs, Index u, Index v) {
        if (empty()) return AllowedPosition::anywhere;
        // Without curves an edge has one group on all sides; the ends of a virtual pair may have two.
        if (!has_vertex(u) && !has_vertex(v))
            return are_same_group(mesh, u, v) ? AllowedPosition::anywhere : AllowedPosition::nowhere;
        shared_groups_.clear();
        mesh.for_each_face(u, [&](Index f, unsigned) {
            if (mesh.has_corner(f, v)) shared_groups_.push_back(groups_[f]);
        });
        if (shared_groups_.empty()) return AllowedPosition::nowhere;
        const bool u_stays = has_vertex(u) && (is_node(mesh, pairs, u) || has_other_group(mesh, u));
        const bool v_stays = has_vertex(v) && (is_node(mesh, pairs, v) || has_other_group(mesh, v));
        if (u_stays && v_stays) return AllowedPosition::nowhere;
        if (closes_loop(mesh, u, v)) return AllowedPosition::nowhere;
        return u_stays   ? AllowedPosition::at_first
               : v_stays ? AllowedPosition::at_second
                         : AllowedPosition::anywhere;
    }

    /// u and v are about to become u.
    void before_collapse(Index u, Index v) {
        if (!empty()) is_on_curve_[u] |= is_on_curve_[v];
    }

private:
    /// An edge from the vertex in hand.
    struct IncidentEdge {
        Index vertex, group;              ///< the group of one of its faces
        std::uint32_t faces = 0;          ///< it has
        bool has_several_groups = false;  ///< groups
        std::uint64_t group_parity =
            0;  ///< 0 where each group has an even number of faces, and else but by chance
        void add(Index other) {
            ++faces;
            has_several_groups |= other != group;
            group_parity ^= splitmix64((std::uint64_t{other} + 1) * 0x9e3779b97f4a7c15u);
        }
        /// Where all groups go on, as in sheets that lie back to back, none has a border.
        bool is_on_curve() const { return has_several_groups && group_parity != 0; }
        bool is_in_graph() const { return faces == 1 || is_on_curve(); }
    };

    bool are_same_group(const CollapseMesh& mesh, Index u, Index v) const {
        const auto group = [&](Index w) {
            Index first = no_index;
            mesh.all_of_faces(w, [&](Index f, unsigned) { return first = f, false; });
            return groups_[first];
        };
        return group(u) == group(v);
    }

    bool has_other_group(const CollapseMesh& mesh, Index v) const {
        return !mesh.all_of_faces(v, [&](Index f, unsigned) {
            return std::find(shared_groups_.begin(), shared_groups_.end(), groups_[f]) !=
                   shared_groups_.end();
        });
    }

    // Does the graph do anything else at v than go by or through?
    bool is_node(const CollapseMesh& mesh, const PairTable& pairs, Index v) {
        find_incident_edges(mesh, v);
        const auto degree = std::count_if(incident_edges_.begin(), incident_edges_.end(),
                                          [](const IncidentEdge& end) { return end.is_on_curve(); });
        return degree > 0 && (degree != 2 || pairs.boundary_degree(v) > 0);
    }

    // Do edges of the graph from u and from v meet at a third vertex? The collapse would make one of two, and
    // what they enclose would go.
    bool closes_loop(const CollapseMesh& mesh, Index u, Index v) {
        find_incident_edges(mesh, u);
        std::swap(incident_edges_, edges_at_u_);
        find_incident_edges(mesh, v);
        for (Index i = 0; i < incident_edges_.size(); ++i) mark_[incident_edges_[i].vertex] = i + 1;
        const bool closes = std::any_of(edges_at_u_.begin(), edges_at_u_.end(), [&](const IncidentEdge& end) {
            const Index at = mark_[end.vertex];
            if (at == 0 || !end.is_in_graph() || !incident_edges_[at - 1].is_in_graph()) return false;
            return end.is_on_curve() || incident_edges_[at - 1].is_on_curve();
        });
        for (const IncidentEdge& end : incident_edges_) mark_[end.vertex] = 0;
        return closes;
    }

    // Fills ring_ with the edges at v.
    void find_incident_edges(const CollapseMesh& mesh, Index v) {
        incident_edges_.clear();
        mesh.for_each_face(v, [&](Index f, unsigned corner) {
            const Triangle& t = mesh.triangle(f);
            for (unsigned k = 1; k < 3; ++k) {
                Index& at = mark_[t[(corner + k) % 3]];
                if (at == 0) {
                    incident_edges_.push_back({t[(corner + k) % 3], groups_[f]});
                    at = static_cast<Index>(incident_edges_.size());
                }
                incident_edges_[at - 1].add(groups_[f]);
            }
        });
        for (const IncidentEdge& end : incident_edges_) mark_[end.vertex] = 0;
    }

    std::span<const Index> groups_;
    std::vector<std::uint8_t> is_on_curve_;
    std::vector<Index> shared_groups_;                       // groups of the pair in hand
    std::vector<IncidentEdge> incident_edges_, edges_at_u_;  // edges of the vertex in hand
    std::vector<Index> mark_;  // 1 + place in a ring, while looking around; else 0
};

}  // namespace engine
FAQEM_NAMESPACE_END

#pragma once
/// \file
/// Curves between faces of different groups (materials), which are preserved during simplification.
///
/// Together with the boundary edges they touch, the curves form a graph on the surface. A collapse must not
/// split or close a curve, and must not move a node: a vertex at which the graph branches, ends or meets a
/// boundary.

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

FAQEM_ENGINE_BEGIN

/// The vertices on curves between groups, and the positions that collapses may have. Empty, without memory
/// or constraints, if there are no curves to preserve. Not thread-safe.
class FeatureCurves {
public:
    FeatureCurves() = default;

    /// Finds the vertices on curves. O(vertices + faces)
    /// \param groups           empty, or the group of each face slot; borrowed, must outlive this object
    FeatureCurves(const CollapseMesh& mesh, std::span<const Index> groups) : groups_(groups) {
        if (groups.empty()) return;
        is_on_curve_.assign(mesh.vertex_slots(), 0);
        mark_.assign(mesh.vertex_slots(), 0);
        for (Index v = 0; v < mesh.vertex_slots(); ++v) {
            Index first = no_index;
            is_on_curve_[v] = !mesh.all_of_faces(v, [&](Index f, unsigned) {
                if (first == no_index) first = f;
                return groups_[f] == groups_[first];
            });
        }
        if (std::count(is_on_curve_.begin(), is_on_curve_.end(), 1) == 0) *this = {};
    }

    /// Whether there are no curves.
    bool empty() const { return groups_.empty(); }
    /// Whether v is or was on a curve; false if empty().
    bool has_vertex(Index v) const { return !is_on_curve_.empty() && is_on_curve_[v]; }
    /// Whether faces f and g have different groups; false if empty().
    bool are_different_groups(Index f, Index g) const { return !groups_.empty() && groups_[f] != groups_[g]; }

    /// Calls visit(face, neighbour) for each face of each curve edge (v, neighbour). O(valence squared)
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

    /// Positions that the pair (u, v) may be collapsed to without changing the graph of curves. O(valence)
    /// at curves, else O(1)
    AllowedPosition allowed_position(const CollapseMesh& mesh, const PairTable& pairs, Index u, Index v) {
        if (empty()) return AllowedPosition::anywhere;
        // If neither vertex is on a curve, all faces of an edge have one group; the vertices of a virtual
        // pair may have different groups.
        if (!has_vertex(u) && !has_vertex(v))
            return are_same_group(mesh, u, v) ? AllowedPosition::anywhere : AllowedPosition::nowhere;
        shared_groups_.clear();
        mesh.for_each_face_between(u, v, [&](Index f) { shared_groups_.push_back(groups_[f]); });
        if (shared_groups_.empty()) return AllowedPosition::nowhere;
        const bool u_stays = has_vertex(u) && (is_node(mesh, pairs, u) || has_other_group(mesh, u));
        const bool v_stays = has_vertex(v) && (is_node(mesh, pairs, v) || has_other_group(mesh, v));
        if ((u_stays && v_stays) || closes_loop(mesh, u, v)) return AllowedPosition::nowhere;
        return allowed_by_fixed(u_stays, v_stays);
    }

    /// Must be called before v is merged into u.
    void before_collapse(Index u, Index v) {
        if (!empty()) is_on_curve_[u] |= is_on_curve_[v];
    }

private:
    /// An edge at the current vertex.
    struct IncidentEdge {
        Index vertex, group;              ///< the other end, and the group of one of its faces
        std::uint32_t faces = 0;          ///< number of faces
        bool has_several_groups = false;  ///< whether its faces have different groups
        /// 0 if each group has an even number of faces; otherwise 0 only in case of a hash collision.
        std::uint64_t group_parity = 0;
        void add(Index other) {
            ++faces;
            has_several_groups |= other != group;
            group_parity ^= splitmix64((std::uint64_t{other} + 1) * 0x9e3779b97f4a7c15u);
        }
        /// Whether it is on a curve. If each group continues across the edge, as in surface patches back to
        /// back, none of them has a boundary there.
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
            return std::count(shared_groups_.begin(), shared_groups_.end(), groups_[f]) > 0;
        });
    }

    // Whether v is a node: on a curve, but not an inner vertex of one curve.
    bool is_node(const CollapseMesh& mesh, const PairTable& pairs, Index v) {
        find_incident_edges(mesh, v);
        const auto degree = std::count_if(incident_edges_.begin(), incident_edges_.end(),
                                          [](const IncidentEdge& end) { return end.is_on_curve(); });
        return degree > 0 && (degree != 2 || pairs.boundary_degree(v) > 0);
    }

    // Whether graph edges from u and from v meet at a third vertex. The collapse would merge them, and the
    // region enclosed by them would vanish.
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

    // Sets incident_edges_ to the edges at v.
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
    std::vector<Index> shared_groups_;                       // groups of the faces at the pair
    std::vector<IncidentEdge> incident_edges_, edges_at_u_;  // edges at the current vertex, at u
    std::vector<Index> mark_;                                // scratch: 1 + index in incident_edges_, else 0
};

FAQEM_ENGINE_END

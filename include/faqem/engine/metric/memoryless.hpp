#pragma once
/// \file
/// Memoryless metric: costs are measured on the current surface, so that the errors of earlier collapses
/// are not counted repeatedly (Lindstrom and Turk 1998).

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "faqem/engine/mesh/normal_cones.hpp"
#include "faqem/engine/metric/accumulated.hpp"
#include "faqem/export.hpp"

FAQEM_ENGINE_BEGIN

/// Weights of the edge planes of the memoryless metric. Their costs, like those of the face planes, are
/// areas times squared distances; 0 disables a term.
struct MemorylessWeights {
    double edge = 1;  ///< planes along boundary edges, times the squared edge length
    /// Likewise for edges with three or more faces, less if the faces continue each other straight through
    /// the edge: the surface patches of a doubled surface need no constraint.
    double nonmanifold_edge = 5;
    /// Likewise for edges at which the surface folds back (normals more than 120 degrees apart). The rim of
    /// a thin blade has hardly any area; without this term the blade would shrink from its tip.
    double fold_edge = 0.2;
    /// Likewise for preserved edges between face groups, for each of the two faces.
    double group_edge = 0.5;
};

/// Area-weighted planes of the faces at both vertices, and planes through certain edges, perpendicular to
/// their faces (see MemorylessWeights). Without the latter, open meshes would first lose their boundary.
/// Not thread-safe.
///
/// All planes of a vertex pass through it, so that six numbers store their quadric: the sum of w n n^T.
class MemorylessMetric : public MetricDefaults {
public:
    /// \param weights  weights of the edge planes
    /// \param curves   boundaries between face groups, which are preserved by planes of weight
    ///     `group_edge`; borrowed; null: none
    explicit MemorylessMetric(const MemorylessWeights& weights = {}, const FeatureCurves* curves = nullptr)
        : weights_(weights), curves_(curves) {}

    /// Computes the planes of the current mesh. O(faces) for bounded valence
    void initialise(const CollapseMesh& mesh, const PairTable& pairs) {
        vertex_planes_.assign(mesh.vertex_slots(), {});
        edge_planes_.assign(mesh.vertex_slots(), {});
        for (Index f = 0; f < mesh.face_slots(); ++f)
            if (mesh.is_alive(f)) add_face(mesh, f, no_index, no_index, 1);
        Eigen::AlignedBox3d box;
        for (Index v = 0; v < vertex_planes_.size(); ++v) {
            update_edge_planes(mesh, pairs, v);
            if (mesh.degree(v) > 0) box.extend(mesh.position(v));
        }
        placement_bounds_ = placement_bounds(box);
    }

    /// The quadric of the pair is the sum of those of both vertices minus half of that of the shared faces,
    /// so that a shared face counts one and a half times. O(1) for manifold pairs, else O(smaller valence)
    /// \param flat  if not null, the new vertex is in it, unless it is at one of the pair's vertices
    std::optional<Candidate> evaluate(const CollapseMesh& mesh, const PairTable& pairs, Index pair,
                                      AllowedPosition allowed_position, const Flat* flat = nullptr) const {
        if (allowed_position == AllowedPosition::nowhere) return std::nullopt;
        const Index u = pairs.first(pair), v = pairs.second(pair);
        const std::uint32_t faces = pairs.face_count(pair);
        // In coordinates relative to u, in which v is at d.
        const Vector3& origin = mesh.position(u);
        const Vector3 d = mesh.position(v) - origin;
        Planes shared;
        sum_shared(mesh, pairs, pair, shared);
        const Planes at_v = planes_at(mesh, v);
        Planes sum = planes_at(mesh, u);
        sum.add(at_v, 1);
        sum.add(shared, -0.5);
        const Vector3 moment = at_v.apply(d);
        const Quadric q = {sum, -moment, d.dot(moment)};
        const Eigen::AlignedBox3d bounds(placement_bounds_.min() - origin, placement_bounds_.max() - origin);
        const Vector3 p = flat && allowed_position == AllowedPosition::anywhere
                              ? optimal_position_in(*flat, origin, q, Vector3::Zero(), d, bounds)
                              : optimal_position(q, Vector3::Zero(), d, allowed_position, &bounds);
        double cost = std::max(q(p), 0.0);
        if (faces > 0 && mesh.degree(u) == faces && mesh.degree(v) == faces) {
            cost += last_faces_price(
                mesh, [&](auto&& visit) { mesh.for_each_face(u, [&](Index f, unsigned) { visit(f); }); });
        }
        if (!std::isfinite(cost)) return std::nullopt;
        if (allowed_position == AllowedPosition::at_second) return Candidate{mesh.position(v), cost};
        return Candidate{p == d ? mesh.position(v) : Vector3(origin + p), cost};
    }

    void before_collapse(const CollapseMesh& mesh, const PairTable&, Index survivor, Index removed,
                         const Vector3&) {
        mesh.for_each_face_around(survivor, removed,
                                  [&](Index f, unsigned) { add_face(mesh, f, survivor, removed, -1); });
    }

    void after_collapse(const CollapseMesh& mesh, const PairTable& pairs, Index survivor,
                        std::span<const PairTable::Change> around) {
        cones_.after_collapse(mesh, survivor);
        vertex_planes_[survivor] = {};
        mesh.for_each_face(survivor, [&](Index f, unsigned) { add_face(mesh, f, no_index, no_index, 1); });
        update_edge_planes(mesh, pairs, survivor);
        for (const PairTable::Change& change : around) {
            const Index v = change.neighbour.vertex;
            if (vertex_planes_[v].has_edge_planes || !has_regular_edges_only(mesh, pairs, v))
                update_edge_planes_beside(mesh, pairs, v, survivor);
        }
    }

    Reevaluation reevaluation(const PairTable::Change&) const { return Reevaluation::deferred; }

private:
    /// Sum of w n n^T.
    using Planes = Symmetric3;

    /// The face planes of a vertex relative to its current position. One cache line.
    struct alignas(64) VertexPlanes {
        Planes faces;
        bool has_edge_planes = false;  ///< whether edge_planes_ has an entry for the vertex
    };

    // Adds a face to the planes of its corners, or subtracts it (sign -1). u and v are skipped.
    void add_face(const CollapseMesh& mesh, Index f, Index u, Index v, double sign) {
        Planes planes;
        planes.add(mesh.normal(f), sign * mesh.area(f));
        for (const Index corner : mesh.triangle(f))
            if (corner != u && corner != v) vertex_planes_[corner].faces.add(planes, 1);
    }

    Planes planes_at(const CollapseMesh& mesh, Index v) const {
        const VertexPlanes& planes = vertex_planes_[v];
        Planes q = planes.faces;
        if (!planes.has_edge_planes) return q;
        if (!high_valence_edges_.empty()) {
            const auto known = high_valence_edges_.find(v);
            if (known != high_valence_edges_.end()) sum_high_valence_edges(mesh, v, known->second);
        }
        q.add(edge_planes_[v], 1);
        return q;
    }

    // Recomputes the planes along boundary edges, non-manifold edges, folds and group boundaries at v.
    void update_edge_planes(const CollapseMesh& mesh, const PairTable& pairs, Index v) {
        vertex_planes_[v].has_edge_planes = false;
        if (!high_valence_edges_.empty()) high_valence_edges_.erase(v);
        if (has_regular_edges_only(mesh, pairs, v)) return;
        if (mesh.is_high_valence(v)) {
            HighValenceEdges& edges = high_valence_edges_[v];
            pairs.for_each_pair(v, [&](Neighbour n) { edges.ends.push_back(n.vertex); });
            vertex_planes_[v].has_edge_planes = edges.is_stale = true;
            return;
        }
        Planes q;
        pairs.for_each_pair(v, [&](Neighbour n) {
            if (const double w = edge_weight(mesh, pairs, n.pair, v, n.vertex); w > 0) {
                vertex_planes_[v].has_edge_planes = true;
                for_each_face(mesh, pairs, n.pair,
                              [&](Index f) { add_edge_plane(mesh, f, v, n.vertex, w, q); });
            }
        });
        edge_planes_[v] = q;
    }

    bool has_regular_edges_only(const CollapseMesh& mesh, const PairTable& pairs, Index v) {
        if (pairs.boundary_degree(v) + pairs.nonmanifold_degree(v) > 0) return false;
        if (curves_ && curves_->has_vertex(v)) return false;
        return !(weights_.fold_edge > 0) || cones_.is_narrow(mesh, v);
    }

    // As update_edge_planes(), if only the faces shared by v and u have changed.
    void update_edge_planes_beside(const CollapseMesh& mesh, const PairTable& pairs, Index v, Index u) {
        const auto known =
            high_valence_edges_.empty() ? high_valence_edges_.end() : high_valence_edges_.find(v);
        if (known == high_valence_edges_.end() || has_regular_edges_only(mesh, pairs, v))
            return update_edge_planes(mesh, pairs, v);
        std::vector<Index>& ends = known->second.ends;
        mesh.for_each_face_between(u, v, [&](Index f) {
            for (const Index w : mesh.triangle(f))
                if (w != v) ends.push_back(w);
        });
        vertex_planes_[v].has_edge_planes = known->second.is_stale = true;
    }

    // The planes of a high-valence vertex are summed when a pair needs them: often its neighbours are collapsed first, many
    // of them.
    struct HighValenceEdges {
        std::vector<Index>
            ends;  // of the edges that have planes, ascending; stale: of those that may have, in any order
        bool is_stale = false;
    };

    void sum_high_valence_edges(const CollapseMesh& mesh, Index v, HighValenceEdges& edges) const {
        if (!std::exchange(edges.is_stale, false)) return;
        std::vector<Index>& ends = edges.ends;
        std::sort(ends.begin(), ends.end());
        ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
        Planes q;
        std::erase_if(ends, [&](Index w) {
            const auto [lower, higher] = mesh.lower_degree_first(v, w);
            Planes own;
            std::uint32_t faces = 0;
            Index first = no_index, last = no_index;
            mesh.for_each_face_between(v, w, [&](Index f) {
                ++faces;
                first = last;
                last = f;
                add_edge_plane(mesh, f, v, w, 1, own);
            });
            const double weight = edge_weight(mesh, lower, higher, faces, first, last);
            if (!(weight > 0)) return true;
            q.add(own, weight);
            return false;
        });
        edge_planes_[v] = q;
    }

    // Adds the planes of the faces of a pair, and those along its edge.
    void sum_shared(const CollapseMesh& mesh, const PairTable& pairs, Index pair, Planes& q) const {
        const auto [u, v] = mesh.lower_degree_first(pairs.first(pair), pairs.second(pair));
        for_each_face(mesh, pairs, pair, [&](Index f) { q.add(mesh.normal(f), mesh.area(f)); });
        const double w = edge_weight(mesh, pairs, pair, u, v);
        if (!(w > 0)) return;
        for_each_face(mesh, pairs, pair, [&, a = u, b = v](Index f) { add_edge_plane(mesh, f, a, b, w, q); });
    }

    // Calls visit(face) for each face of an edge. O(1) for at most two faces, else O(smaller valence)
    template <class Visit>
    static void for_each_face(const CollapseMesh& mesh, const PairTable& pairs, Index pair, Visit&& visit) {
        const std::uint32_t count = pairs.face_count(pair);
        if (count <= 2) {
            for (std::uint32_t k = 0; k < count; ++k) visit(pairs.faces(pair)[k]);
            return;
        }
        mesh.for_each_face_between(pairs.first(pair), pairs.second(pair), visit);
    }

    double edge_weight(const CollapseMesh& mesh, const PairTable& pairs, Index pair, Index u, Index v) const {
        const auto [first, last] = pairs.faces(pair);
        return edge_weight(mesh, u, v, pairs.face_count(pair), first, last);
    }

    // \param first, last  the two faces if `faces` is 2
    double edge_weight(const CollapseMesh& mesh, Index u, Index v, std::uint32_t faces, Index first,
                       Index last) const {
        if (faces == 1) return weights_.edge;
        if (faces > 2) return weights_.nonmanifold_edge * std::min(1.0, imbalance(mesh, u, v));
        if (faces != 2) return 0;
        if (curves_ && curves_->are_different_groups(first, last)) return weights_.group_edge;
        const double cosine = mesh.normal(first).dot(mesh.normal(last));
        if (!(std::abs(cosine) > 0.5)) return 0;
        // If the windings are inconsistent, opposite normals mean that the surface is flat.
        const bool agree = mesh.has_directed_edge(first, u, v) != mesh.has_directed_edge(last, u, v);
        return agree == (cosine < 0) ? weights_.fold_edge : 0;
    }

    // Squared length of the sum of the unit vectors from the edge (u, v) into its faces: 0 if the faces
    // form pairs that continue each other.
    double imbalance(const CollapseMesh& mesh, Index u, Index v) const {
        const Vector3& a = mesh.position(u);
        const Vector3 e = mesh.position(v) - a;
        Vector3 sum = Vector3::Zero();
        mesh.for_each_face(u, [&](Index f, unsigned corner) {
            const Triangle& t = mesh.triangle(f);
            const Index next = t[(corner + 1) % 3], other = t[(corner + 2) % 3];
            if (next != v && other != v) return;
            const Vector3 inward = e.cross(mesh.normal(f));
            const double length = inward.norm();
            if (!(length > 0)) return;
            const Vector3& apex = mesh.position(next == v ? other : next);
            sum += (inward.dot(apex - a) < 0 ? -1 : 1) / length * inward;
        });
        return sum.squaredNorm();
    }

    void add_edge_plane(const CollapseMesh& mesh, Index f, Index a, Index b, double weight, Planes& q) const {
        const Vector3 e = mesh.position(b) - mesh.position(a);
        const Vector3 across = e.cross(mesh.normal(f));
        const double length = across.norm();
        if (length > 0) q.add(across / length, weight * e.squaredNorm());
    }

    MemorylessWeights weights_;
    const FeatureCurves* curves_;
    Eigen::AlignedBox3d placement_bounds_;  // see placement_bounds()
    std::vector<VertexPlanes> vertex_planes_;
    mutable std::vector<Planes> edge_planes_;  // per vertex: sum of the planes along its edges
    mutable std::map<Index, HighValenceEdges> high_valence_edges_;  // per high-valence vertex with such edges
    NormalCones cones_;
};

static_assert(CollapseMetric<MemorylessMetric>);

FAQEM_ENGINE_END

#pragma once
/// \file
/// A metric without memory: what a collapse costs is measured on the surface as it is now, so that the errors
/// of earlier collapses are not counted again and again (Lindstrom and Turk 1998).

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "faqem/export.hpp"
#include "faqem/engine/metric/accumulated.hpp"

FAQEM_NAMESPACE_BEGIN
namespace engine {

/// Weights of the memoryless metric. Both terms are areas times squared distances.
struct MemorylessWeights {
    double edge = 1;  ///< planes along open edges, times their squared length
    /// The same along edges with three faces or more, less where these go on straight through the edge: the
    /// sheets of a doubled surface need no holding.
    double nonmanifold_edge = 5;
    /// The same along edges where the surface folds back (normals more than 120 degrees apart): the rim of a
    /// thin blade has hardly any area, and without this the blade shrinks from its tip.
    double fold_edge = 0.2;
    /// The same along kept edges between groups, for each of the two faces.
    double group_edge = 0.5;
};

/// Area-weighted planes of the faces around both vertices, and planes that hold open edges in place: each
/// goes through its edge, across its face. Without them open meshes lose their border first.
///
/// All planes of a vertex go through it, so six numbers hold their quadric: the sum of w n n^T.
class MemorylessMetric {
public:
    /// \param curves  between groups, to be held in place; borrowed; null: none
    explicit MemorylessMetric(const MemorylessWeights& weights = {}, const GroupCurves* curves = nullptr)
        : weights_(weights), curves_(curves) {}

    void initialise(const Complex& complex, const PairTable& pairs, Poll poll = {}) {
        rings_.assign(complex.vertex_slots(), {});
        edges_.assign(complex.vertex_slots(), {});
        for (Index f = 0; f < complex.face_slots(); ++f) {
            poll();
            if (complex.alive(f)) add_face(complex, f, no_index, no_index, 1);
        }
        Eigen::AlignedBox3d box;
        for (Index v = 0; v < rings_.size(); ++v) {
            poll();
            find_edges(complex, pairs, v);
            if (complex.degree(v) > 0) box.extend(complex.position(v));
        }
        room_ = room_around(box);
    }

    /// The sum of both rings less half of what they share: a shared face counts one and a half times.
    std::optional<Candidate> evaluate(const Complex& complex, const PairTable& pairs, Index pair,
                                      Freedom freedom) const {
        if (freedom == Freedom::nowhere) return std::nullopt;
        const Index u = pairs.first(pair), v = pairs.second(pair);
        const std::uint32_t faces = pairs.face_count(pair);
        // In coordinates around u, where v is at d.
        const Vector3& origin = complex.position(u);
        const Vector3 d = complex.position(v) - origin;
        Planes shared;
        sum_shared(complex, pairs, pair, shared);
        const Planes at_v = ring(v);
        Planes sum = ring(u);
        sum.add(at_v, 1);
        sum.add(shared, -0.5);
        const Vector3 moment = at_v.apply(d);
        const Quadric q = {sum.xx, sum.xy, sum.xz, sum.yy, sum.yz, sum.zz, -moment, d.dot(moment)};
        const Eigen::AlignedBox3d room(room_.min() - origin, room_.max() - origin);
        const Vector3 p = place(q, Vector3::Zero(), d, freedom, &room);
        double cost = std::max(q(p), 0.0);
        if (faces > 0 && complex.degree(u) == faces && complex.degree(v) == faces)
            cost += cost_of_part(complex, u);
        if (!std::isfinite(cost)) return std::nullopt;
        if (freedom == Freedom::at_second) return Candidate{complex.position(v), cost};
        return Candidate{p == d ? complex.position(v) : Vector3(origin + p), cost};
    }

    void collapsing(const Complex& complex, const PairTable&, Index survivor, Index gone, const Vector3&) {
        complex.for_each_face_around(survivor, gone,
                                     [&](Index f, unsigned) { add_face(complex, f, survivor, gone, -1); });
    }

    void collapsed(const Complex& complex, const PairTable& pairs, Index survivor,
                   std::span<const PairTable::Change> around) {
        rings_[survivor] = {};
        complex.for_each_face(survivor,
                              [&](Index f, unsigned) { add_face(complex, f, no_index, no_index, 1); });
        find_edges(complex, pairs, survivor);
        for (const PairTable::Change& change : around) {
            const Index v = change.neighbour.vertex;
            if (rings_[v].has_edges || !has_plain_edges_only(complex, pairs, v))
                find_edges_beside(complex, pairs, v, survivor);
        }
    }

    Staleness staleness(const PairTable::Change&) const { return Staleness::lazily; }

private:
    /// A part that goes is missed at its own size at least, and may be all there is for a long way around: it
    /// goes where collapses elsewhere cost this many times its longest edge squared, squared.
    static constexpr double part_weight = 100;

    /// Sum of w n n^T.
    struct Planes {
        double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;
        void add(const Vector3& n, double w) {
            const Vector3 m = w * n;
            xx += m.x() * n.x(), xy += m.x() * n.y(), xz += m.x() * n.z();
            yy += m.y() * n.y(), yz += m.y() * n.z(), zz += m.z() * n.z();
        }
        void add(const Planes& o, double w) {
            xx += w * o.xx, xy += w * o.xy, xz += w * o.xz, yy += w * o.yy, yz += w * o.yz, zz += w * o.zz;
        }
        Vector3 apply(const Vector3& p) const {
            return {xx * p.x() + xy * p.y() + xz * p.z(), xy * p.x() + yy * p.y() + yz * p.z(),
                    xz * p.x() + yz * p.y() + zz * p.z()};
        }
    };

    /// Of a vertex, around itself, now. A cache line.
    struct alignas(64) Ring {
        Planes faces;
        bool has_edges = false;  ///< with planes of their own
    };

    // Adds the face to its corners' rings, or takes it away (sign -1), except at u and v.
    void add_face(const Complex& complex, Index f, Index u, Index v, double sign) {
        Planes planes;
        planes.add(complex.normal(f), sign * complex.area(f));
        for (const Index corner : complex.triangle(f)) {
            if (corner != u && corner != v) rings_[corner].faces.add(planes, 1);
        }
    }

    Planes ring(Index v) const {
        const Ring& ring = rings_[v];
        Planes q = ring.faces;
        if (ring.has_edges) q.add(edges_[v], 1);
        return q;
    }

    // Sums up the planes along the open, crowded and folding edges of v, and those between groups.
    void find_edges(const Complex& complex, const PairTable& pairs, Index v) {
        rings_[v].has_edges = false;
        if (!hub_edges_.empty()) hub_edges_.erase(v);
        if (has_plain_edges_only(complex, pairs, v)) return;
        if (complex.is_hub(v)) {
            std::vector<Index>& ends = hub_edges_[v];
            pairs.for_each_pair(v, [&](Neighbour n) { ends.push_back(n.vertex); });
            return sum_hub_edges(complex, v, ends);
        }
        Planes q;
        pairs.for_each_pair(v, [&](Neighbour n) {
            if (const double w = edge_weight(complex, pairs, n.pair, v, n.vertex); w > 0) {
                rings_[v].has_edges = true;
                for_each_face(complex, pairs, n.pair,
                              [&](Index f) { add_edge_plane(complex, f, v, n.vertex, w, q); });
            }
        });
        edges_[v] = q;
    }

    bool has_plain_edges_only(const Complex& complex, const PairTable& pairs, Index v) const {
        if (pairs.boundary_degree(v) + pairs.nonmanifold_degree(v) > 0) return false;
        if (curves_ && curves_->has(v)) return false;
        return !(weights_.fold_edge > 0) || complex.is_calm(v);
    }

    // find_edges(), where nothing has changed but the faces that v shares with u.
    void find_edges_beside(const Complex& complex, const PairTable& pairs, Index v, Index u) {
        const auto known = hub_edges_.empty() ? hub_edges_.end() : hub_edges_.find(v);
        if (known == hub_edges_.end() || has_plain_edges_only(complex, pairs, v))
            return find_edges(complex, pairs, v);
        std::vector<Index>& ends = known->second;
        const auto [few, many] = complex.by_degree(u, v);
        complex.for_each_face(few, [&, other = many](Index f, unsigned) {
            if (!complex.has_corner(f, other)) return;
            for (const Index w : complex.triangle(f)) {
                if (w != v) ends.push_back(w);
            }
        });
        sum_hub_edges(complex, v, ends);
    }

    // \param ends  of edges that may count; those stay that do, in ascending order
    void sum_hub_edges(const Complex& complex, Index v, std::vector<Index>& ends) {
        std::sort(ends.begin(), ends.end());
        ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
        Planes q;
        std::erase_if(ends, [&](Index w) {
            const auto [few, many] = complex.by_degree(v, w);
            Planes own;
            std::uint32_t faces = 0;
            Index first = no_index, last = no_index;
            complex.for_each_face(few, [&, other = many](Index f, unsigned) {
                if (!complex.has_corner(f, other)) return;
                ++faces;
                first = last;
                last = f;
                add_edge_plane(complex, f, v, w, 1, own);
            });
            const double weight = edge_weight(complex, few, many, faces, first, last);
            if (!(weight > 0)) return true;
            q.add(own, weight);
            return false;
        });
        rings_[v].has_edges = !ends.empty();
        edges_[v] = q;
    }

    // The planes of the faces of an edge, and those along it.
    void sum_shared(const Complex& complex, const PairTable& pairs, Index pair, Planes& q) const {
        const auto [u, v] = complex.by_degree(pairs.first(pair), pairs.second(pair));
        for_each_face(complex, pairs, pair, [&](Index f) { q.add(complex.normal(f), complex.area(f)); });
        const double w = edge_weight(complex, pairs, pair, u, v);
        if (!(w > 0)) return;
        for_each_face(complex, pairs, pair,
                      [&, a = u, b = v](Index f) { add_edge_plane(complex, f, a, b, w, q); });
    }

    // Calls visit(face) for those of an edge. O(1) where it has at most two, else O(the smaller valence)
    template <class Visit>
    static void for_each_face(const Complex& complex, const PairTable& pairs, Index pair, Visit&& visit) {
        const std::uint32_t count = pairs.face_count(pair);
        if (count <= 2) {
            for (std::uint32_t k = 0; k < count; ++k) visit(pairs.faces(pair)[k]);
            return;
        }
        const auto [few, many] = complex.by_degree(pairs.first(pair), pairs.second(pair));
        complex.for_each_face(few, [&, other = many](Index f, unsigned) {
            if (complex.has_corner(f, other)) visit(f);
        });
    }

    // \pre u's faces are all that is left of their part
    static double cost_of_part(const Complex& complex, Index u) {
        double longest = 0;
        complex.for_each_face(u, [&](Index f, unsigned) {
            const Triangle& t = complex.triangle(f);
            for (unsigned k = 0; k < 3; ++k) {
                const Vector3 edge = complex.position(t[(k + 1) % 3]) - complex.position(t[k]);
                longest = std::max(longest, edge.squaredNorm());
            }
        });
        return part_weight * longest * longest;
    }

    double edge_weight(const Complex& complex, const PairTable& pairs, Index pair, Index u, Index v) const {
        const auto [first, last] = pairs.faces(pair);
        return edge_weight(complex, u, v, pairs.face_count(pair), first, last);
    }

    // \param first, last  the faces, where there are two
    double edge_weight(const Complex& complex, Index u, Index v, std::uint32_t faces, Index first,
                       Index last) const {
        if (faces == 1) return weights_.edge;
        if (faces > 2) return weights_.nonmanifold_edge * std::min(1.0, imbalance(complex, u, v));
        if (faces != 2) return 0;
        if (curves_ && curves_->differ(first, last)) return weights_.group_edge;
        const double cosine = complex.normal(first).dot(complex.normal(last));
        if (!(std::abs(cosine) > 0.5)) return 0;
        // Windings may disagree: then opposite normals mean that the surface goes straight on.
        const bool agree = complex.goes_from(first, u, v) != complex.goes_from(last, u, v);
        return agree == (cosine < 0) ? weights_.fold_edge : 0;
    }

    // Squared length of the sum of unit vectors from the edge (u, v) into its faces: 0 where each face has
    // one that continues it.
    double imbalance(const Complex& complex, Index u, Index v) const {
        const Vector3& a = complex.position(u);
        const Vector3 e = complex.position(v) - a;
        Vector3 sum = Vector3::Zero();
        complex.for_each_face(u, [&](Index f, unsigned corner) {
            const Triangle& t = complex.triangle(f);
            const Index next = t[(corner + 1) % 3], other = t[(corner + 2) % 3];
            if (next != v && other != v) return;
            const Vector3 into = e.cross(complex.normal(f));
            const double length = into.norm();
            if (!(length > 0)) return;
            const Vector3& apex = complex.position(next == v ? other : next);
            sum += (into.dot(apex - a) < 0 ? -1 : 1) / length * into;
        });
        return sum.squaredNorm();
    }

    void add_edge_plane(const Complex& complex, Index f, Index a, Index b, double weight, Planes& q) const {
        const Vector3 e = complex.position(b) - complex.position(a);
        const Vector3 across = e.cross(complex.normal(f));
        const double length = across.norm();
        if (length > 0) q.add(across / length, weight * e.squaredNorm());
    }

    MemorylessWeights weights_;
    const GroupCurves* curves_;
    Eigen::AlignedBox3d room_;  // for new vertices
    std::vector<Ring> rings_;
    std::vector<Planes> edges_;                      // of each vertex: planes along its edges
    std::map<Index, std::vector<Index>> hub_edges_;  // of hubs with such edges: their other ends, ascending
};

static_assert(CollapseMetric<MemorylessMetric>);

}  // namespace engine
FAQEM_NAMESPACE_END

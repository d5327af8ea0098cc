#pragma once
/// \file
/// A metric without memory: what a collapse costs is measured on the surface as it is now, so that the errors
/// of earlier collapses are not counted again and again (Lindstrom and Turk 1998).

#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include "faqem/engine/metric.hpp"

namespace faqem::engine {

/// Weights of the memoryless metric. Both terms are areas times squared distances.
struct MemorylessWeights {
    double edge = 1;              ///< planes along open edges, times their squared length
    double nonmanifold_edge = 5;  ///< the same along edges with three faces or more
    /// The same along edges where the surface folds back (normals more than 120 degrees apart): the rim of a
    /// thin blade has hardly any area, and without this the blade shrinks from its tip.
    double fold_edge = 0.2;
};

/// Area-weighted planes of the faces around both vertices, and planes that hold open edges in place: each
/// goes through its edge, across its face. Without them open meshes lose their border first.
///
/// All planes of a vertex go through it, so six numbers hold their quadric: the sum of w n n^T.
class MemorylessMetric {
public:
    explicit MemorylessMetric(const MemorylessWeights& weights = {}) : weights_(weights) {}

    void initialise(const Complex& complex, const PairTable& pairs) {
        facets_.resize(complex.face_slots());
        for (Index f = 0; f < facets_.size(); ++f) {
            if (complex.alive(f)) facets_[f] = facet(complex, f);
        }
        rings_.resize(complex.vertex_slots());
        for (Index v = 0; v < rings_.size(); ++v) rings_[v] = ring(complex, pairs, v);
    }

    /// The sum of both rings less half of what they share: a shared face counts one and a half times.
    std::optional<Candidate> evaluate(const Complex& complex, const PairTable&, Index u, Index v,
                                      Freedom freedom) const {
        if (freedom == Freedom::nowhere) return std::nullopt;
        // In coordinates around u, where v is at d.
        const Vector3& origin = complex.position(u);
        const Vector3 d = complex.position(v) - origin;
        Planes shared;
        const std::uint32_t faces = sum_shared(complex, u, v, shared);
        const Planes& at_v = rings_[v];
        Planes sum = rings_[u];
        sum.add(at_v, 1);
        sum.add(shared, -0.5);
        const Vector3 moment = at_v.apply(d);
        const Quadric q = {sum.xx, sum.xy, sum.xz, sum.yy, sum.yz, sum.zz, -moment, d.dot(moment)};
        const Vector3 p = place(q, Vector3::Zero(), d, freedom);
        double cost = std::max(q(p), 0.0);
        // The last faces of a part go last: a small part may be all there is for a long way around.
        if (faces > 0 && complex.degree(u) == faces && complex.degree(v) == faces) cost += part_cost;
        if (!std::isfinite(cost)) return std::nullopt;
        if (freedom == Freedom::at_second) return Candidate{complex.position(v), cost};
        return Candidate{p == d ? complex.position(v) : Vector3(origin + p), cost};
    }

    void collapsing(const Complex&, const PairTable&, Index, Index, const Vector3&) {}

    void collapsed(const Complex& complex, const PairTable& pairs, Index survivor,
                   std::span<const PairTable::Change> around) {
        complex.for_each_face(survivor, [&](Index f, unsigned) { facets_[f] = facet(complex, f); });
        rings_[survivor] = ring(complex, pairs, survivor);
        for (const PairTable::Change& change : around) {
            const Index v = change.neighbour.vertex;
            rings_[v] = ring(complex, pairs, v);
        }
    }

    Staleness staleness(const PairTable::Change&) const { return Staleness::lazily; }

private:
    /// Far above any cost on a model of diagonal 1.
    static constexpr double part_cost = 1e6;

    struct Facet {
        Vector3 normal = Vector3::Zero();  ///< unit; zero without area
        double area = 0;
    };

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

    static Facet facet(const Complex& complex, Index f) {
        const Vector3 n = complex.area_vector(f);
        const double length = n.norm();
        if (!(length > 0)) return {};
        return {n / length, 0.5 * length};
    }

    Planes ring(const Complex& complex, const PairTable& pairs, Index v) const {
        Planes q;
        Vector3 sum = Vector3::Zero();
        complex.for_each_face(v, [&](Index f, unsigned) {
            const Facet& facet = facets_[f];
            q.add(facet.normal, facet.area);
            sum += facet.normal;
        });
        // Where all normals are within 60 degrees of one direction no two are 120 degrees apart.
        const double limit = 0.5 * sum.norm();
        const bool may_fold = weights_.fold_edge > 0 && !complex.all_faces(v, [&](Index f, unsigned) {
            return facets_[f].normal.dot(sum) > limit;
        });
        if (!may_fold && pairs.boundary_degree(v) == 0 && pairs.nonmanifold_degree(v) == 0) return q;
        pairs.for_each_pair(v, [&](Neighbour n) {
            if (const double w = edge_weight(complex, v, n.vertex, pairs.face_count(n.pair)); w > 0) {
                complex.for_each_face(v, [&](Index f, unsigned) {
                    if (complex.has_corner(f, n.vertex)) add_edge_plane(complex, f, v, n.vertex, w, q);
                });
            }
        });
        return q;
    }

    std::uint32_t sum_shared(const Complex& complex, Index u, Index v, Planes& q) const {
        if (complex.degree(v) < complex.degree(u)) std::swap(u, v);
        std::uint32_t shared = 0;
        complex.for_each_face(u, [&](Index f, unsigned) {
            if (!complex.has_corner(f, v)) return;
            ++shared;
            q.add(facets_[f].normal, facets_[f].area);
        });
        const double w = edge_weight(complex, u, v, shared);
        if (!(w > 0)) return shared;
        complex.for_each_face(u, [&](Index f, unsigned) {
            if (complex.has_corner(f, v)) add_edge_plane(complex, f, u, v, w, q);
        });
        return shared;
    }

    double edge_weight(const Complex& complex, Index u, Index v, std::uint32_t faces) const {
        if (faces == 1) return weights_.edge;
        if (faces > 2) return weights_.nonmanifold_edge;
        return faces == 2 && weights_.fold_edge > 0 && folds(complex, u, v) ? weights_.fold_edge : 0;
    }

    bool folds(const Complex& complex, Index u, Index v) const {
        Index first = no_index, last = no_index;
        complex.for_each_face(u, [&](Index f, unsigned) {
            if (!complex.has_corner(f, v)) return;
            first = last;
            last = f;
        });
        return facets_[first].normal.dot(facets_[last].normal) < -0.5;
    }

    void add_edge_plane(const Complex& complex, Index f, Index a, Index b, double weight, Planes& q) const {
        const Vector3 e = complex.position(b) - complex.position(a);
        const Vector3 across = e.cross(facets_[f].normal);
        const double length = across.norm();
        if (length > 0) q.add(across / length, weight * e.squaredNorm());
    }

    MemorylessWeights weights_;
    std::vector<Facet> facets_;  // of each face, now
    std::vector<Planes> rings_;  // of each vertex, around itself, now
};

static_assert(CollapseMetric<MemorylessMetric>);

}  // namespace faqem::engine

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
class MemorylessMetric {
public:
    explicit MemorylessMetric(const MemorylessWeights& weights = {}) : weights_(weights) {}

    void initialise(const Complex& complex, const PairTable& pairs) {
        rings_.resize(complex.vertex_slots());
        for (Index v = 0; v < rings_.size(); ++v) rings_[v] = ring(complex, pairs, v);
    }

    /// The sum of both rings less half of what they share: a shared face counts one and a half times.
    std::optional<Candidate> evaluate(const Complex& complex, const PairTable&, Index u, Index v,
                                      Freedom freedom) const {
        if (freedom == Freedom::nowhere) return std::nullopt;
        Quadric q = rings_[u] + rings_[v];
        const std::uint32_t shared = subtract_shared(complex, u, v, q);
        const Vector3 p = place(q, complex.position(u), complex.position(v), freedom);
        double cost = std::max(q(p), 0.0);
        // The last faces of a part go last: a small part may be all there is for a long way around.
        if (shared > 0 && complex.degree(u) == shared && complex.degree(v) == shared) cost += part_cost;
        if (!std::isfinite(cost)) return std::nullopt;
        return Candidate{p, cost};
    }

    void collapsing(const Complex&, const PairTable&, Index, Index, const Vector3&) {}

    void collapsed(const Complex& complex, const PairTable& pairs, Index survivor,
                   std::span<const PairTable::Change> around) {
        rings_[survivor] = ring(complex, pairs, survivor);
        for (const PairTable::Change& change : around) {
            const Index v = change.neighbour.vertex;
            rings_[v] = ring(complex, pairs, v);
        }
    }

    bool affects(const PairTable::Change&) const { return true; }

private:
    /// Far above any cost on a model of diagonal 1.
    static constexpr double part_cost = 1e6;

    Quadric ring(const Complex& complex, const PairTable& pairs, Index v) const {
        Quadric q;
        complex.for_each_face(v, [&](Index f, unsigned) { q += face_plane(complex, f); });
        pairs.for_each_pair(v, [&](Neighbour n) {
            if (const double w = edge_weight(complex, v, n.vertex, pairs.face_count(n.pair)); w > 0) {
                complex.for_each_face(v, [&](Index f, unsigned) {
                    if (complex.has_corner(f, n.vertex)) q += edge_plane(complex, f, v, n.vertex, w);
                });
            }
        });
        return q;
    }

    std::uint32_t subtract_shared(const Complex& complex, Index u, Index v, Quadric& q) const {
        std::uint32_t shared = 0;
        Quadric both;
        complex.for_each_face(u, [&](Index f, unsigned) { shared += complex.has_corner(f, v); });
        const double w = edge_weight(complex, u, v, shared);
        complex.for_each_face(u, [&](Index f, unsigned) {
            if (!complex.has_corner(f, v)) return;
            both += face_plane(complex, f);
            if (w > 0) both += edge_plane(complex, f, u, v, w);
        });
        both *= -0.5;
        q += both;
        return shared;
    }

    double edge_weight(const Complex& complex, Index u, Index v, std::uint32_t faces) const {
        if (faces == 1) return weights_.edge;
        if (faces > 2) return weights_.nonmanifold_edge;
        return faces == 2 && weights_.fold_edge > 0 && folds(complex, u, v) ? weights_.fold_edge : 0;
    }

    static bool folds(const Complex& complex, Index u, Index v) {
        Vector3 first = Vector3::Zero(), last = Vector3::Zero();
        complex.for_each_face(u, [&](Index f, unsigned) {
            if (!complex.has_corner(f, v)) return;
            first = last;
            last = complex.area_vector(f);
        });
        return first.dot(last) < -0.5 * first.norm() * last.norm();
    }

    static Quadric face_plane(const Complex& complex, Index f) {
        return base_term(complex.area_vector(f), complex.position(complex.triangle(f)[0]), BaseWeight::area,
                         1, 0);
    }

    static Quadric edge_plane(const Complex& complex, Index f, Index a, Index b, double weight) {
        const Vector3 e = complex.position(b) - complex.position(a);
        const Vector3 across = e.cross(complex.area_vector(f));
        const double length = across.norm();
        if (!(length > 0)) return {};
        return Quadric::plane_through(across / length, complex.position(a), weight * e.squaredNorm());
    }

    MemorylessWeights weights_;
    std::vector<Quadric> rings_;  // of each vertex, now
};

static_assert(CollapseMetric<MemorylessMetric>);

}  // namespace faqem::engine

#pragma once
/// \file
/// What a collapse costs. A metric gives a point and a cost for a pair, or nothing: "do not collapse".

#include <algorithm>
#include <cmath>
#include <concepts>
#include <optional>
#include <span>
#include <vector>

#include "faqem/export.hpp"
#include "faqem/engine/mesh/triangle_soup.hpp"
#include "faqem/engine/constraints/feature_curves.hpp"
#include "faqem/engine/mesh/pair_table.hpp"
#include "faqem/engine/quadric/placement.hpp"
#include "faqem/engine/quadric/quadric.hpp"
#include "faqem/engine/quadric/terms.hpp"

FAQEM_NAMESPACE_BEGIN
namespace engine {

/// What a collapse does to the cost of other pairs of the survivor's neighbours.
enum class Staleness {
    none,    ///< nothing
    lazily,  ///< it is looked at again when the pair's turn comes; vetoed pairs are tried again
    now,     ///< it is evaluated at once
};

/// A metric owns its state per vertex and is told of every collapse.
template <class M>
concept CollapseMetric = requires(M metric, const M& const_metric, const Complex& complex,
                                  const PairTable& pairs, Index pair, Index u, Index v, Freedom freedom,
                                  const Vector3& p, const PairTable::Change& change,
                                  std::span<const PairTable::Change> around) {
    {metric.initialise(complex, pairs)};
    // Candidate for the pair; nothing if it must not be collapsed. Finite, cost >= 0.
    { const_metric.evaluate(complex, pairs, pair, freedom) } -> std::same_as<std::optional<Candidate>>;
    // u and v are about to become u at p; the complex is still as before.
    {metric.collapsing(complex, pairs, u, v, p)};
    // The collapse is done; `around` are the survivor's neighbours.
    {metric.collapsed(complex, pairs, u, around)};
    // What it did to other pairs of this neighbour of the survivor.
    { const_metric.staleness(change) } -> std::same_as<Staleness>;
};

/// A metric that polls in its long loops, from the beginning on.
template <class M>
concept PollingMetric = CollapseMetric<M> &&
    requires(M metric, const Complex& complex, const PairTable& pairs, Poll poll) {
    {metric.initialise(complex, pairs, poll)};
};

template <CollapseMetric M>
void initialise(M& metric, const Complex& complex, const PairTable& pairs, Poll poll) {
    if constexpr (PollingMetric<M>) {
        metric.initialise(complex, pairs, poll);
    } else {
        metric.initialise(complex, pairs);
    }
}

/// A metric whose costs come in two steps: evaluate() tells at least, refine() what it really is.
template <class M>
concept RefiningMetric = CollapseMetric<M> &&
    requires(M metric, const Complex& complex, const PairTable& pairs, Index u, Index v,
             const Candidate& candidate) {
    // Cost of a candidate of evaluate(): not below candidate.cost.
    { metric.refine(complex, pairs, u, v, candidate) } -> std::same_as<double>;
};

/// A metric that counts the same error more in one place than in another.
template <class M>
concept WeighingMetric = CollapseMetric<M> && requires(const M& metric, Index u, Index v) {
    // What the costs of the pair (u, v) were multiplied by.
    { metric.weight(u, v) } -> std::same_as<double>;
};

/// A metric whose costs depend on the target.
template <class M>
concept AimingMetric = CollapseMetric<M> && requires(M metric, std::size_t target_faces, double weight) {
    // From now on the target is a lower one. `weight`: what the square of a distance costs, no less than
    // before.
    {metric.aim(target_faces, weight)};
};

/// When the area term takes part.
enum class AreaTerm {
    after_placement,   ///< added to the cost once the point is found (paper eq. 4)
    before_placement,  ///< the point minimises the sum (Liu et al. 2024)
};

/// A weighted sum of the paper's terms; weight 0 turns one off.
struct CompositeWeights {
    BaseWeight base = BaseWeight::unit;
    double plane_area = 1;  ///< paper eq. 5, with BaseWeight::inverse_area
    double boundary = 0;    ///< paper eq. 9
    double normal = 0;      ///< paper eq. 10
    double area = 0;        ///< paper eq. 4
    AreaTerm area_term = AreaTerm::after_placement;
    double seam = 1;        ///< factor on the quadric of seam vertices
    double least_area = 0;  ///< clamp of face areas, engine units squared
};

/// The composite metric with memory: each vertex carries the sum of all quadrics that were merged into it
/// (paper, Algorithm 1; Garland and Heckbert 1997).
class MemoryMetric {
public:
    /// \param weights       of the terms
    /// \param seam_vertex   empty, or one per vertex: nonzero where the UVs are split
    /// \param curves        between groups, to be held in place; null: none
    explicit MemoryMetric(const CompositeWeights& weights, std::span<const std::uint8_t> seam_vertex = {},
                          const GroupCurves* curves = nullptr)
        : weights_(weights), seam_vertex_(seam_vertex), curves_(curves) {}

    void initialise(const Complex& complex, const PairTable& pairs, Poll poll = {}) {
        quadrics_.assign(complex.vertex_slots(), {});
        room_.setEmpty();
        for (Index f = 0; f < complex.face_slots(); ++f) {
            poll();
            if (!complex.alive(f)) continue;
            const Triangle& t = complex.triangle(f);
            for (const Index v : t) room_.extend(complex.position(v));
            const Quadric q = base_term(complex.area_vector(f), complex.position(t[0]), weights_.base,
                                        weights_.plane_area, weights_.least_area);
            for (const Index v : t) quadrics_[v] += q;
        }
        for (Index v = 0; v < complex.vertex_slots(); ++v) {
            poll();
            add_vertex_terms(complex, pairs, v);
        }
        room_ = room_around(room_);
    }

    std::optional<Candidate> evaluate(const Complex& complex, const PairTable& pairs, Index pair,
                                      Freedom freedom) const {
        if (freedom == Freedom::nowhere) return std::nullopt;
        const Index u = pairs.first(pair), v = pairs.second(pair);
        Quadric q = quadrics_[u] + quadrics_[v];
        const bool has_area =
            weights_.area > 0 && (pairs.boundary_degree(u) > 0 || pairs.boundary_degree(v) > 0);
        Quadric area;
        if (has_area) {
            area = area_term(complex, pairs, u, v);
            area *= weights_.area;
            if (weights_.area_term == AreaTerm::before_placement) q += area;
        }
        const Vector3 p = place(q, complex.position(u), complex.position(v), freedom, &room_);
        double cost = std::max(q(p), 0.0);
        if (has_area && weights_.area_term == AreaTerm::after_placement) cost += std::max(area(p), 0.0);
        if (!std::isfinite(cost)) return std::nullopt;
        return Candidate{p, cost};
    }

    void collapsing(const Complex&, const PairTable&, Index survivor, Index gone, const Vector3&) {
        quadrics_[survivor] += quadrics_[gone];
    }

    void collapsed(const Complex&, const PairTable&, Index, std::span<const PairTable::Change>) {}

    Staleness staleness(const PairTable::Change& change) const {
        return weights_.area > 0 && change.boundary_changed ? Staleness::now : Staleness::none;
    }

    /// The quadric that vertex v carries.
    const Quadric& quadric(Index v) const { return quadrics_[v]; }

private:
    void add_vertex_terms(const Complex& complex, const PairTable& pairs, Index v) {
        Quadric& q = quadrics_[v];
        if (weights_.boundary > 0) {
            if (const auto ends = border_neighbours(pairs, v)) {
                Quadric border = boundary_term(complex.position(v), complex.position((*ends)[0]),
                                               complex.position((*ends)[1]));
                border *= weights_.boundary;
                q += border;
            }
        }
        if (weights_.normal > 0) {
            Quadric normal = normal_term(complex, v);
            normal *= weights_.normal;
            q += normal;
        }
        if (curves_ && curves_->has(v)) add_curve_planes(complex, v);
        if (!seam_vertex_.empty() && seam_vertex_[v]) q *= weights_.seam;
    }

    // A square face stands on each edge between two groups, on either side across its face (after Garland and
    // Heckbert 1997).
    void add_curve_planes(const Complex& complex, Index v) {
        curves_->for_each_edge(complex, v, [&](Index f, Index neighbour) {
            const Vector3 edge = complex.position(neighbour) - complex.position(v);
            const Vector3 across = edge.cross(complex.area_vector(f).normalized());
            const double length = across.norm();
            if (!(length > 0)) return;
            quadrics_[v] += base_term(2 * edge.squaredNorm() / length * across, complex.position(v),
                                      weights_.base, weights_.plane_area, weights_.least_area);
        });
    }

    CompositeWeights weights_;
    std::span<const std::uint8_t> seam_vertex_;
    const GroupCurves* curves_;
    std::vector<Quadric> quadrics_;
    Eigen::AlignedBox3d room_;  // for new vertices: the box of the original, with a margin
};

static_assert(CollapseMetric<MemoryMetric>);

}  // namespace engine
FAQEM_NAMESPACE_END

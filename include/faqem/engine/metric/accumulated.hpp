#pragma once
/// \file
/// What a collapse costs. A metric gives a point and a cost for a pair, or nothing: "do not collapse".

#include <algorithm>
#include <cmath>
#include <concepts>
#include <optional>
#include <span>
#include <vector>

#include "faqem/engine/constraints/feature_curves.hpp"
#include "faqem/engine/mesh/collapse_mesh.hpp"
#include "faqem/engine/mesh/pair_table.hpp"
#include "faqem/engine/quadric/placement.hpp"
#include "faqem/engine/quadric/quadric.hpp"
#include "faqem/engine/quadric/terms.hpp"
#include "faqem/export.hpp"

FAQEM_NAMESPACE_BEGIN
namespace engine {

/// What a collapse does to the cost of other pairs of the survivor's neighbours.
enum class Reevaluation {
    none,       ///< nothing
    deferred,   ///< it is looked at again when the pair's turn comes; vetoed pairs are tried again
    immediate,  ///< it is evaluated at once
};

/// A metric owns its state per vertex and is told of every collapse.
template <class M>
concept CollapseMetric = requires(M metric, const M& const_metric, const CollapseMesh& mesh,
                                  const PairTable& pairs, Index pair, Index u, Index v,
                                  AllowedPosition allowed_position, const Vector3& p,
                                  const PairTable::Change& change,
                                  std::span<const PairTable::Change> around) {
    {metric.initialise(mesh, pairs)};
    // Candidate for the pair; nothing if it must not be collapsed. Finite, cost >= 0.
    { const_metric.evaluate(mesh, pairs, pair, allowed_position) } -> std::same_as<std::optional<Candidate>>;
    // u and v are about to become u at p; the complex is still as before.
    {metric.before_collapse(mesh, pairs, u, v, p)};
    // The collapse is done; `around` are the survivor's neighbours.
    {metric.after_collapse(mesh, pairs, u, around)};
    // What it did to other pairs of this neighbour of the survivor.
    { const_metric.reevaluation(change) } -> std::same_as<Reevaluation>;
};

/// A metric that polls in its long loops, from the beginning on.
template <class M>
concept CancellableMetric = CollapseMetric<M> &&
    requires(M metric, const CollapseMesh& mesh, const PairTable& pairs, CancellationCheck check_cancelled) {
    {metric.initialise(mesh, pairs, check_cancelled)};
};

template <CollapseMetric M>
void initialise(M& metric, const CollapseMesh& mesh, const PairTable& pairs,
                CancellationCheck check_cancelled) {
    if constexpr (CancellableMetric<M>) {
        metric.initialise(mesh, pairs, check_cancelled);
    } else {
        metric.initialise(mesh, pairs);
    }
}

/// A metric whose costs come in two steps: evaluate() tells at least, exact_cost() what it really is.
template <class M>
concept LowerBoundMetric = CollapseMetric<M> &&
    requires(M metric, const CollapseMesh& mesh, const PairTable& pairs, Index u, Index v,
             const Candidate& candidate) {
    // Cost of a candidate of evaluate(): not below candidate.cost.
    { metric.exact_cost(mesh, pairs, u, v, candidate) } -> std::same_as<double>;
};

/// A metric that counts the same error more in one place than in another.
template <class M>
concept VertexWeightedMetric = CollapseMetric<M> && requires(const M& metric, Index u, Index v) {
    // What the costs of the pair (u, v) were multiplied by.
    { metric.weight(u, v) } -> std::same_as<double>;
};

/// A metric whose costs depend on the target.
template <class M>
concept TargetDependentMetric = CollapseMetric<M> &&
    requires(M metric, std::size_t target_faces, double weight) {
    // From now on the target is a lower one. `weight`: what the square of a distance costs, no less than
    // before.
    {metric.set_target(target_faces, weight)};
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
    double seam = 1;      ///< factor on the quadric of seam vertices
    double min_area = 0;  ///< clamp of face areas, engine units squared
};

/// The composite metric with memory: each vertex carries the sum of all quadrics that were merged into it
/// (paper, Algorithm 1; Garland and Heckbert 1997).
class AccumulatedMetric {
public:
    /// \param weights       of the terms
    /// \param seam_vertex   empty, or one per vertex: nonzero where the UVs are split
    /// \param curves        between groups, to be held in place; null: none
    explicit AccumulatedMetric(const CompositeWeights& weights,
                               std::span<const std::uint8_t> seam_vertex = {},
                               const FeatureCurves* curves = nullptr)
        : weights_(weights), seam_vertex_(seam_vertex), curves_(curves) {}

    void initialise(const CollapseMesh& mesh, const PairTable& pairs,
                    CancellationCheck check_cancelled = {}) {
        quadrics_.assign(mesh.vertex_slots(), {});
        placement_bounds_.setEmpty();
        for (Index f = 0; f < mesh.face_slots(); ++f) {
            check_cancelled();
            if (!mesh.is_alive(f)) continue;
            const Triangle& t = mesh.triangle(f);
            for (const Index v : t) placement_bounds_.extend(mesh.position(v));
            const Quadric q = base_term(mesh.area_vector(f), mesh.position(t[0]), weights_.base,
                                        weights_.plane_area, weights_.min_area);
            for (const Index v : t) quadrics_[v] += q;
        }
        for (Index v = 0; v < mesh.vertex_slots(); ++v) {
            check_cancelled();
            add_vertex_terms(mesh, pairs, v);
        }
        placement_bounds_ = placement_bounds(placement_bounds_);
    }

    std::optional<Candidate> evaluate(const CollapseMesh& mesh, const PairTable& pairs, Index pair,
                                      AllowedPosition allowed_position) const {
        if (allowed_position == AllowedPosition::nowhere) return std::nullopt;
        const Index u = pairs.first(pair), v = pairs.second(pair);
        Quadric q = quadrics_[u] + quadrics_[v];
        const bool has_area =
            weights_.area > 0 && (pairs.boundary_degree(u) > 0 || pairs.boundary_degree(v) > 0);
        Quadric area;
        if (has_area) {
            area = area_term(mesh, pairs, u, v);
            area *= weights_.area;
            if (weights_.area_term == AreaTerm::before_placement) q += area;
        }
        const Vector3 p =
            optimal_position(q, mesh.position(u), mesh.position(v), allowed_position, &placement_bounds_);
        double cost = std::max(q(p), 0.0);
        if (has_area && weights_.area_term == AreaTerm::after_placement) cost += std::max(area(p), 0.0);
        if (!std::isfinite(cost)) return std::nullopt;
        return Candidate{p, cost};
    }

    void before_collapse(const CollapseMesh&, const PairTable&, Index survivor, Index removed,
                         const Vector3&) {
        quadrics_[survivor] += quadrics_[removed];
    }

    void after_collapse(const CollapseMesh&, const PairTable&, Index, std::span<const PairTable::Change>) {}

    Reevaluation reevaluation(const PairTable::Change& change) const {
        return weights_.area > 0 && change.boundary_changed ? Reevaluation::immediate : Reevaluation::none;
    }

    /// The quadric that vertex v carries.
    const Quadric& quadric(Index v) const { return quadrics_[v]; }

private:
    void add_vertex_terms(const CollapseMesh& mesh, const PairTable& pairs, Index v) {
        Quadric& q = quadrics_[v];
        if (weights_.boundary > 0) {
            if (const auto ends = boundary_neighbours(pairs, v)) {
                Quadric term =
                    boundary_term(mesh.position(v), mesh.position((*ends)[0]), mesh.position((*ends)[1]));
                term *= weights_.boundary;
                q += term;
            }
        }
        if (weights_.normal > 0) {
            Quadric normal = normal_term(mesh, v);
            normal *= weights_.normal;
            q += normal;
        }
        if (curves_ && curves_->has_vertex(v)) add_curve_planes(mesh, v);
        if (!seam_vertex_.empty() && seam_vertex_[v]) q *= weights_.seam;
    }

    // A square face stands on each edge between two groups, on either side across its face (after Garland and
    // Heckbert 1997).
    void add_curve_planes(const CollapseMesh& mesh, Index v) {
        curves_->for_each_curve_edge(mesh, v, [&](Index f, Index neighbour) {
            const Vector3 edge = mesh.position(neighbour) - mesh.position(v);
            const Vector3 across = edge.cross(mesh.area_vector(f).normalized());
            const double length = across.norm();
            if (!(length > 0)) return;
            quadrics_[v] += base_term(2 * edge.squaredNorm() / length * across, mesh.position(v),
                                      weights_.base, weights_.plane_area, weights_.min_area);
        });
    }

    CompositeWeights weights_;
    std::span<const std::uint8_t> seam_vertex_;
    const FeatureCurves* curves_;
    std::vector<Quadric> quadrics_;
    Eigen::AlignedBox3d placement_bounds_;  // for new vertices: the box of the original, with a margin
};

static_assert(CollapseMetric<AccumulatedMetric>);

}  // namespace engine
FAQEM_NAMESPACE_END

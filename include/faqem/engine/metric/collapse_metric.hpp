#pragma once
/// \file
/// The concept of collapse metrics, and bases of metrics.

#include <concepts>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>

#include "faqem/engine/constraints/contraction.hpp"
#include "faqem/engine/mesh/collapse_mesh.hpp"
#include "faqem/engine/mesh/pair_table.hpp"
#include "faqem/engine/quadric/placement.hpp"
#include "faqem/export.hpp"

FAQEM_ENGINE_BEGIN

/// How a collapse affects the costs of other pairs of the survivor's neighbours.
enum class Reevaluation {
    none,       ///< not at all
    deferred,   ///< costs are updated when the pair is popped; rejected pairs are evaluated at once
    immediate,  ///< all these pairs are evaluated at once
};

/// A collapse metric: determines the cost of a collapse and the position of the new vertex. It owns its
/// per-vertex state, which it updates with each collapse. Positions and lengths are in engine units. A metric
/// derives from MetricDefaults and has at least evaluate() and reevaluation(). A metric that wraps another one
/// derives from MetricWrapper and has at least evaluate().
template <class M>
concept CollapseMetric = requires(M metric, const M& const_metric, const CollapseMesh& mesh,
                                  const PairTable& pairs, Index pair, Index u, Index v,
                                  AllowedPosition allowed_position, const Vector3& p,
                                  const Candidate& candidate, const Contraction& contraction,
                                  std::size_t target_faces, double weight, const PairTable::Change& change,
                                  std::span<const PairTable::Change> around) {
    // True if evaluate() returns a lower bound of the cost. The engine then calls exact_cost() for pairs that
    // are about to be collapsed.
    { M::has_exact_cost } -> std::convertible_to<bool>;
    // Computes the state for the given mesh. Called once, before the other functions.
    {metric.initialise(mesh, pairs)};
    // Position and cost of a pair, both finite and the cost >= 0; or nothing if it must not be collapsed.
    { const_metric.evaluate(mesh, pairs, pair, allowed_position) } -> std::same_as<std::optional<Candidate>>;
    // Exact cost of a candidate returned by evaluate(); at least candidate.cost, or infinity: it is refused.
    { metric.exact_cost(mesh, pairs, pair, candidate) } -> std::same_as<double>;
    // Whether a candidate, for which exact_cost() was just called, must not be collapsed.
    { metric.exceeds_limit(candidate) } -> std::same_as<bool>;
    // Cost of contracting several vertices to candidate.point; at least candidate.cost, or infinity: it is refused.
    { metric.contraction_cost(mesh, contraction, candidate) } -> std::same_as<double>;
    // The factor > 0 by which the costs of the pair (u, v) were multiplied.
    { const_metric.weight(u, v) } -> std::same_as<double>;
    // Changes the target to a lower face count. `weight` is the cost of a squared distance; it is not smaller
    // than before.
    {metric.set_target(target_faces, weight)};
    // Called before u and v are merged into u at p; the mesh is still unchanged.
    {metric.before_collapse(mesh, pairs, u, v, p)};
    // Called after u and v were merged into u. `around` are the neighbours of u.
    {metric.after_collapse(mesh, pairs, u, around)};
    // How the last collapse affected the other pairs of this neighbour of the survivor.
    { const_metric.reevaluation(change) } -> std::same_as<Reevaluation>;
};

/// Base of metrics: defaults for a metric with exact costs, weight 1 and no state.
struct MetricDefaults {
    static constexpr bool has_exact_cost = false;
    static void initialise(const CollapseMesh&, const PairTable&) {}
    static double exact_cost(const CollapseMesh&, const PairTable&, Index, const Candidate& candidate) {
        return candidate.cost;
    }
    static double contraction_cost(const CollapseMesh&, const Contraction&, const Candidate& candidate) {
        return candidate.cost;
    }
    static bool exceeds_limit(const Candidate&) { return false; }
    static constexpr double weight(Index, Index) { return 1; }
    static void set_target(std::size_t, double) {}
    static void before_collapse(const CollapseMesh&, const PairTable&, Index, Index, const Vector3&) {}
    static void after_collapse(const CollapseMesh&, const PairTable&, Index,
                               std::span<const PairTable::Change>) {}
};

/// Base of metrics that wrap another one: everything but evaluate() is that of the inner metric.
template <CollapseMetric Inner>
class MetricWrapper {
public:
    static constexpr bool has_exact_cost = Inner::has_exact_cost;

    /// \param inner  moved into this object
    explicit MetricWrapper(Inner inner) : inner_(std::move(inner)) {}

    void initialise(const CollapseMesh& mesh, const PairTable& pairs) { inner_.initialise(mesh, pairs); }
    double exact_cost(const CollapseMesh& mesh, const PairTable& pairs, Index pair,
                      const Candidate& candidate) {
        return inner_.exact_cost(mesh, pairs, pair, candidate);
    }
    bool exceeds_limit(const Candidate& candidate) { return inner_.exceeds_limit(candidate); }
    double contraction_cost(const CollapseMesh& mesh, const Contraction& contraction,
                            const Candidate& candidate) {
        return inner_.contraction_cost(mesh, contraction, candidate);
    }
    double weight(Index u, Index v) const { return inner_.weight(u, v); }
    void set_target(std::size_t target_faces, double weight) { inner_.set_target(target_faces, weight); }
    void before_collapse(const CollapseMesh& mesh, const PairTable& pairs, Index survivor, Index removed,
                         const Vector3& p) {
        inner_.before_collapse(mesh, pairs, survivor, removed, p);
    }
    void after_collapse(const CollapseMesh& mesh, const PairTable& pairs, Index survivor,
                        std::span<const PairTable::Change> around) {
        inner_.after_collapse(mesh, pairs, survivor, around);
    }
    Reevaluation reevaluation(const PairTable::Change& change) const { return inner_.reevaluation(change); }

protected:
    Inner inner_;
};

FAQEM_ENGINE_END

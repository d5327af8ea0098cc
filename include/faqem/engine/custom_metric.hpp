#pragma once
/// \file
/// A metric that adds a cost term, a veto or another placement to an existing metric.

#include <cmath>
#include <concepts>
#include <optional>
#include <utility>

#include "faqem/engine/metric/accumulated.hpp"
#include "faqem/engine/metric/collapse_metric.hpp"
#include "faqem/export.hpp"

FAQEM_ENGINE_BEGIN

/// A function that adjusts each collapse candidate of another metric. It returns the candidate unchanged,
/// with another position, or with another cost; or nothing, which forbids the collapse (a veto).
/// \param inner             the adjusted metric
/// \param mesh              the current mesh
/// \param u, v              the vertices of the pair
/// \param allowed_position  never `nowhere`. Unless it is `anywhere`, the position must not be changed
/// \param candidate         of the inner metric: finite position and cost, in engine units
/// \return a cost that is not finite is a veto. The result must depend only on u, v and their one-rings
template <class A, class Inner>
concept Adjustment = requires(const A& adjust, const Inner& inner, const CollapseMesh& mesh, Index u, Index v,
                              AllowedPosition allowed_position, const Candidate& candidate) {
    {
        adjust(inner, mesh, u, v, allowed_position, candidate)
        } -> std::convertible_to<std::optional<Candidate>>;
};

/// A metric whose candidates are adjusted by a function.
/// \tparam Inner   a metric whose evaluate() returns exact costs, such as AccumulatedMetric
/// \tparam Adjust  see Adjustment; called from const functions on the calling thread
template <CollapseMetric Inner, Adjustment<Inner> Adjust>
class CustomMetric : public MetricWrapper<Inner> {
    using MetricWrapper<Inner>::inner_;

public:
    static_assert(!Inner::has_exact_cost, "an adjustment must see exact costs");

    /// \param inner   the metric to adjust; moved into this object
    /// \param adjust  the adjustment; moved into this object
    CustomMetric(Inner inner, Adjust adjust)
        : MetricWrapper<Inner>(std::move(inner)), adjust_(std::move(adjust)) {}

    std::optional<Candidate> evaluate(const CollapseMesh& mesh, const PairTable& pairs, Index pair,
                                      AllowedPosition allowed_position) const {
        std::optional<Candidate> found = inner_.evaluate(mesh, pairs, pair, allowed_position);
        if (found)
            found = adjust_(inner_, mesh, pairs.first(pair), pairs.second(pair), allowed_position, *found);
        if (found && !std::isfinite(found->cost)) return std::nullopt;
        return found;
    }

    /// At least `deferred`: the adjustment may depend on the one-ring of the neighbour, which has changed.
    Reevaluation reevaluation(const PairTable::Change& change) const {
        const Reevaluation inner = inner_.reevaluation(change);
        return inner == Reevaluation::none ? Reevaluation::deferred : inner;
    }

private:
    Adjust adjust_;
};

FAQEM_ENGINE_END

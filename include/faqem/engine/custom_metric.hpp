#pragma once
/// \file
/// A metric with a user's own term, veto or placement on top.

#include <cmath>
#include <concepts>
#include <optional>
#include <span>
#include <utility>

#include "faqem/engine/metric/accumulated.hpp"
#include "faqem/export.hpp"

FAQEM_NAMESPACE_BEGIN
namespace engine {

/// A user's say in each collapse: gets what the metric below found, and gives back the same, another point or
/// another cost (a placement, a term), or nothing (a veto).
///
///     candidate  finite point and cost; engine units
///     freedom    of the pair (u, v), not `nowhere`: unless `anywhere`, the point must not change
///     returns    a cost that is not finite is a veto. It must depend on nothing but u, v and their one-rings
template <class A, class Inner>
concept Adjustment = requires(const A& adjust, const Inner& inner, const CollapseMesh& mesh, Index u, Index v,
                              AllowedPosition allowed_position, const Candidate& candidate) {
    {
        adjust(inner, mesh, u, v, allowed_position, candidate)
        } -> std::convertible_to<std::optional<Candidate>>;
};

/// Another metric, adjusted. \tparam Inner  one whose costs come in one step, such as MemoryMetric
template <CollapseMetric Inner, Adjustment<Inner> Adjust>
requires(!LowerBoundMetric<Inner>) class CustomMetric {
public:
    CustomMetric(Inner inner, Adjust adjust) : inner_(std::move(inner)), adjust_(std::move(adjust)) {}

    void initialise(const CollapseMesh& mesh, const PairTable& pairs,
                    CancellationCheck check_cancelled = {}) {
        engine::initialise(inner_, mesh, pairs, check_cancelled);
    }

    std::optional<Candidate> evaluate(const CollapseMesh& mesh, const PairTable& pairs, Index pair,
                                      AllowedPosition allowed_position) const {
        std::optional<Candidate> found = inner_.evaluate(mesh, pairs, pair, allowed_position);
        if (found)
            found = adjust_(inner_, mesh, pairs.first(pair), pairs.second(pair), allowed_position, *found);
        if (found && !std::isfinite(found->cost)) return std::nullopt;
        return found;
    }

    void before_collapse(const CollapseMesh& mesh, const PairTable& pairs, Index survivor, Index removed,
                         const Vector3& p) {
        inner_.before_collapse(mesh, pairs, survivor, removed, p);
    }

    void after_collapse(const CollapseMesh& mesh, const PairTable& pairs, Index survivor,
                        std::span<const PairTable::Change> around) {
        inner_.after_collapse(mesh, pairs, survivor, around);
    }

    /// At least `lazily`: what the adjustment read around a neighbour has changed.
    Reevaluation reevaluation(const PairTable::Change& change) const {
        const Reevaluation inner = inner_.reevaluation(change);
        return inner == Reevaluation::none ? Reevaluation::deferred : inner;
    }

    void set_target(std::size_t target_faces, double weight) requires TargetDependentMetric<Inner> {
        inner_.set_target(target_faces, weight);
    }

private:
    Inner inner_;
    Adjust adjust_;
};

}  // namespace engine
FAQEM_NAMESPACE_END

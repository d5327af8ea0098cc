#pragma once
/// \file
/// A metric with a user's own term, veto or placement on top.

#include <cmath>
#include <concepts>
#include <optional>
#include <span>
#include <utility>

#include "faqem/export.hpp"
#include "faqem/engine/metric/accumulated.hpp"

FAQEM_NAMESPACE_BEGIN
namespace engine {

/// A user's say in each collapse: gets what the metric below found, and gives back the same, another point or
/// another cost (a placement, a term), or nothing (a veto).
///
///     candidate  finite point and cost; engine units
///     freedom    of the pair (u, v), not `nowhere`: unless `anywhere`, the point must not change
///     returns    a cost that is not finite is a veto. It must depend on nothing but u, v and their one-rings
template <class A, class Inner>
concept Adjustment = requires(const A& adjust, const Inner& inner, const Complex& complex, Index u, Index v,
                              Freedom freedom, const Candidate& candidate) {
    { adjust(inner, complex, u, v, freedom, candidate) } -> std::convertible_to<std::optional<Candidate>>;
};

/// Another metric, adjusted. \tparam Inner  one whose costs come in one step, such as MemoryMetric
template <CollapseMetric Inner, Adjustment<Inner> Adjust>
requires(!RefiningMetric<Inner>) class CustomMetric {
public:
    CustomMetric(Inner inner, Adjust adjust) : inner_(std::move(inner)), adjust_(std::move(adjust)) {}

    void initialise(const Complex& complex, const PairTable& pairs, Poll poll = {}) {
        engine::initialise(inner_, complex, pairs, poll);
    }

    std::optional<Candidate> evaluate(const Complex& complex, const PairTable& pairs, Index pair,
                                      Freedom freedom) const {
        std::optional<Candidate> found = inner_.evaluate(complex, pairs, pair, freedom);
        if (found) found = adjust_(inner_, complex, pairs.first(pair), pairs.second(pair), freedom, *found);
        if (found && !std::isfinite(found->cost)) return std::nullopt;
        return found;
    }

    void collapsing(const Complex& complex, const PairTable& pairs, Index survivor, Index gone,
                    const Vector3& p) {
        inner_.collapsing(complex, pairs, survivor, gone, p);
    }

    void collapsed(const Complex& complex, const PairTable& pairs, Index survivor,
                   std::span<const PairTable::Change> around) {
        inner_.collapsed(complex, pairs, survivor, around);
    }

    /// At least `lazily`: what the adjustment read around a neighbour has changed.
    Staleness staleness(const PairTable::Change& change) const {
        const Staleness inner = inner_.staleness(change);
        return inner == Staleness::none ? Staleness::lazily : inner;
    }

    void aim(std::size_t target_faces, double weight) requires AimingMetric<Inner> {
        inner_.aim(target_faces, weight);
    }

private:
    Inner inner_;
    Adjust adjust_;
};

}  // namespace engine
FAQEM_NAMESPACE_END

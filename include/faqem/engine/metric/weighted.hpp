#pragma once
/// \file
/// A metric with weights of the user's: the same error counts more in one place than in another.

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "faqem/export.hpp"
#include "faqem/engine/metric/accumulated.hpp"

FAQEM_NAMESPACE_BEGIN
namespace engine {

/// Multiplies the costs of another metric by the larger weight of the pair's ends. The new vertex gets the
/// weight that the edge, interpolated between its ends, has nearest to it.
/// \tparam Inner  what an error costs where the weight is 1
template <CollapseMetric Inner>
class ImportanceMetric {
public:
    /// \param weights  one per vertex slot, finite and > 0
    ImportanceMetric(Inner inner, std::vector<double> weights)
        : inner_(std::move(inner)), weights_(std::move(weights)) {}

    void initialise(const Complex& complex, const PairTable& pairs, Poll poll = {}) {
        engine::initialise(inner_, complex, pairs, poll);
    }

    std::optional<Candidate> evaluate(const Complex& complex, const PairTable& pairs, Index pair,
                                      Freedom freedom) const {
        std::optional<Candidate> found = inner_.evaluate(complex, pairs, pair, freedom);
        if (!found) return found;
        found->cost *= weight(pairs.first(pair), pairs.second(pair));
        if (!std::isfinite(found->cost)) return std::nullopt;
        return found;
    }

    double refine(const Complex& complex, const PairTable& pairs, Index u, Index v,
                  const Candidate& candidate) requires RefiningMetric<Inner> {
        const double w = weight(u, v);
        const double cost = w * inner_.refine(complex, pairs, u, v, {candidate.point, candidate.cost / w});
        return std::max(candidate.cost, cost);
    }

    void collapsing(const Complex& complex, const PairTable& pairs, Index survivor, Index gone,
                    const Vector3& p) {
        inner_.collapsing(complex, pairs, survivor, gone, p);
        const Vector3& a = complex.position(survivor);
        const Vector3 edge = complex.position(gone) - a;
        const double square = edge.squaredNorm();
        const double t = square > 0 ? std::clamp((p - a).dot(edge) / square, 0.0, 1.0) : 0.5;
        weights_[survivor] += t * (weights_[gone] - weights_[survivor]);
    }

    void collapsed(const Complex& complex, const PairTable& pairs, Index survivor,
                   std::span<const PairTable::Change> around) {
        inner_.collapsed(complex, pairs, survivor, around);
    }

    Staleness staleness(const PairTable::Change& change) const { return inner_.staleness(change); }

    void aim(std::size_t target_faces, double weight) requires AimingMetric<Inner> {
        inner_.aim(target_faces, weight);
    }

    /// What the costs of the pair (u, v) are multiplied by.
    double weight(Index u, Index v) const { return std::max(weights_[u], weights_[v]); }

private:
    Inner inner_;
    std::vector<double> weights_;
};

}  // namespace engine
FAQEM_NAMESPACE_END

#pragma once
/// \file
/// A metric with vertex weights: the same error costs more in some regions than in others.

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "faqem/engine/metric/collapse_metric.hpp"
#include "faqem/export.hpp"

FAQEM_ENGINE_BEGIN

/// Multiplies the costs of another metric by the larger weight of the pair's vertices. The weight of the
/// new vertex is interpolated linearly between both, at the point of the edge closest to it.
/// \tparam Inner  the metric for weight 1
template <CollapseMetric Inner>
class WeightedMetric : public MetricWrapper<Inner> {
    using MetricWrapper<Inner>::inner_;

public:
    /// \param inner    the metric for weight 1; moved into this object
    /// \param weights  one per vertex slot, finite and > 0
    WeightedMetric(Inner inner, std::vector<double> weights)
        : MetricWrapper<Inner>(std::move(inner)), weights_(std::move(weights)) {}

    std::optional<Candidate> evaluate(const CollapseMesh& mesh, const PairTable& pairs, Index pair,
                                      AllowedPosition allowed_position) const {
        std::optional<Candidate> found = inner_.evaluate(mesh, pairs, pair, allowed_position);
        if (!found) return found;
        found->cost *= weight(pairs.first(pair), pairs.second(pair));
        if (!std::isfinite(found->cost)) return std::nullopt;
        return found;
    }

    double exact_cost(const CollapseMesh& mesh, const PairTable& pairs, Index pair,
                      const Candidate& candidate) {
        if constexpr (Inner::has_exact_cost) {
            const double w = weight(pairs.first(pair), pairs.second(pair));
            const double cost =
                w * inner_.exact_cost(mesh, pairs, pair, {candidate.point, candidate.cost / w});
            return std::max(candidate.cost, cost);
        } else {
            return candidate.cost;
        }
    }

    double contraction_cost(const CollapseMesh& mesh, const Contraction& contraction,
                            const Candidate& candidate) {
        const double w = weight(contraction.vertices()[0], contraction.vertices()[1]);
        return w * inner_.contraction_cost(mesh, contraction, {candidate.point, candidate.cost / w});
    }

    void before_collapse(const CollapseMesh& mesh, const PairTable& pairs, Index survivor, Index removed,
                         const Vector3& p) {
        inner_.before_collapse(mesh, pairs, survivor, removed, p);
        const Vector3& a = mesh.position(survivor);
        const Vector3 edge = mesh.position(removed) - a;
        const double square = edge.squaredNorm();
        const double t = square > 0 ? std::clamp((p - a).dot(edge) / square, 0.0, 1.0) : 0.5;
        weights_[survivor] += t * (weights_[removed] - weights_[survivor]);
    }

    /// Weight of the pair (u, v): the larger one of both vertices.
    double weight(Index u, Index v) const { return std::max(weights_[u], weights_[v]); }

private:
    std::vector<double> weights_;
};

FAQEM_ENGINE_END

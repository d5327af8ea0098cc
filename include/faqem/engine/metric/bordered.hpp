#pragma once
/// \file
/// A metric that keeps planar and straight parts of the border.

#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "faqem/engine/constraints/planar_borders.hpp"
#include "faqem/engine/metric/collapse_metric.hpp"
#include "faqem/export.hpp"

FAQEM_ENGINE_BEGIN

/// Keeps each vertex of a planar or straight part of the border in its plane or on its line, and the corners in
/// which two parts meet. A collapse that merges two corners or two parts is allowed at a high price, so that any
/// target can be reached.
/// \tparam Inner  the metric without borders; its evaluate() takes the flat of the new vertex as last argument
template <CollapseMetric Inner>
class BorderedMetric : public MetricWrapper<Inner> {
    using MetricWrapper<Inner>::inner_;

public:
    /// \param inner   moved into this object
    /// \param flats   borrowed
    /// \param at      one per vertex slot, see PlanarBorders, or empty; borrowed, updated with the mesh
    /// \param weight  cost of a squared distance, >= 0
    BorderedMetric(Inner inner, std::span<const Flat> flats, std::vector<Index>& at, double weight)
        : MetricWrapper<Inner>(std::move(inner)), flats_(flats), at_(&at), weight_(weight) {}

    std::optional<Candidate> evaluate(const CollapseMesh& mesh, const PairTable& pairs, Index pair,
                                      AllowedPosition allowed_position) const {
        const auto inner = [&](AllowedPosition allowed, const Flat* flat) {
            return inner_.evaluate(mesh, pairs, pair, allowed, flat);
        };
        if (at_->empty()) return inner(allowed_position, nullptr);
        constexpr Index corner = PlanarBorders::corner;
        const Index u = pairs.first(pair), v = pairs.second(pair), at_u = (*at_)[u], at_v = (*at_)[v];
        const Index both = PlanarBorders::merged(at_u, at_v);
        if (both == no_index) return inner(allowed_position, nullptr);
        if (both != corner) return inner(allowed_position, &flats_[both]);
        // Along the border, a corner is an end of the part beside it.
        const bool is_beside = (at_u == corner) != (at_v == corner) && pairs.face_count(pair) == 1;
        if (at_u == no_index || at_v == no_index || is_beside) {
            const auto here = at_u == corner ? AllowedPosition::at_first : AllowedPosition::at_second;
            return inner(intersection(allowed_position, here), nullptr);
        }
        std::optional<Candidate> found = inner(allowed_position, nullptr);
        if (found)
            found->cost += corner_factor * weight_ * (mesh.position(u) - mesh.position(v)).squaredNorm();
        return found;
    }

    void set_target(std::size_t target_faces, double weight) {
        inner_.set_target(target_faces, weight);
        weight_ = weight;
    }
    void before_collapse(const CollapseMesh& mesh, const PairTable& pairs, Index survivor, Index removed,
                         const Vector3& p) {
        inner_.before_collapse(mesh, pairs, survivor, removed, p);
        if (!at_->empty()) (*at_)[survivor] = PlanarBorders::merged((*at_)[survivor], (*at_)[removed]);
    }

private:
    /// At the target a face has about the area `weight`. A lost corner then costs as much as a lost component of
    /// one face.
    static constexpr double corner_factor = 100;

    std::span<const Flat> flats_;
    std::vector<Index>* at_;
    double weight_;
};

FAQEM_ENGINE_END

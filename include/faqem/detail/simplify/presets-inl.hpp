#pragma once

#include "faqem/detail/simplify/presets.hpp"
#include "faqem/options.hpp"

FAQEM_DETAIL_BEGIN

using engine::AreaTerm;
using engine::BaseWeight;

/// The settings of a preset without the options.
inline Settings named(Preset preset) {
    using Policy = Settings::QuadricPolicy;
    if (preset == Preset::qem) return {.link = LinkCondition::on};
    // Table 1 of the paper. Its terms have different units, so that their balance depends on the model size. The
    // weights were tuned on Thingi10K, whose models are in millimetres with diagonals near 100.
    if (preset == Preset::paper)
        return {.weights = {.base = BaseWeight::inverse_area,
                            .plane_area = 1,
                            .boundary = 500,
                            .normal = 0.01,
                            .area = 100,
                            .seam = 5000},
                .diagonal = 100,
                .weld_distance = 1e-6};
    // Both terms have the unit of a squared area, so that their balance does not depend on the scale.
    if (preset == Preset::stmw)
        return {.weights = {.base = BaseWeight::area, .area = 1, .area_term = AreaTerm::before_placement}};
    // Memoryless quadrics are computed from the current surface, so that small normal deviations of earlier
    // collapses are not penalised later. The flip test is therefore stricter than that of the paper.
    return {.quadric_policy = preset == Preset::fast ? Policy::memoryless : Policy::tracked,
            .link = LinkCondition::by_size,
            .fit_vertices = preset == Preset::best,
            .min_fold_cosine = -0.9,
            .min_normal_cosine = 0.3};
}

FAQEM_INLINE Settings settings(const Options& options) {
    Settings s = named(options.preset);
    const Weights& w = options.weights;
    if (w.plane_area) {
        s.weights.base = *w.plane_area > 0 ? BaseWeight::inverse_area : BaseWeight::unit;
        s.weights.plane_area = *w.plane_area;
    }
    s.weights.boundary = w.boundary.value_or(s.weights.boundary);
    s.weights.normal = w.normal.value_or(s.weights.normal);
    s.weights.area = w.area.value_or(s.weights.area);
    s.weights.seam = w.uv.value_or(s.weights.seam);
    if (options.topology.link != LinkCondition::as_preset) s.link = options.topology.link;
    // Accumulated costs cannot be compared with the size of a feature.
    if (s.link == LinkCondition::by_size && s.quadric_policy == Settings::QuadricPolicy::memory)
        s.link = LinkCondition::on;
    s.weld = options.topology.weld;
    s.weld_distance = options.topology.weld_distance.value_or(s.weld_distance);
    s.prune = options.topology.prune;
    // Keeps 1 / area finite for degenerate faces.
    s.weights.min_area = 1e-12 * s.diagonal * s.diagonal;
    return s;
}

FAQEM_DETAIL_END

#pragma once

#include "faqem/detail/simplify/presets.hpp"
#include "faqem/export.hpp"
#include "faqem/options.hpp"

FAQEM_NAMESPACE_BEGIN
namespace detail {

using engine::AreaTerm;
using engine::BaseWeight;

// Table 1 of the paper. Its terms have different units, so that their balance depends on the model size. The
// weights were tuned on Thingi10K, whose models are in millimetres with diagonals near 100.
inline Settings paper() {
    Settings s;
    s.weights.base = BaseWeight::inverse_area;
    s.weights.plane_area = 1;
    s.weights.boundary = 500;
    s.weights.normal = 0.01;
    s.weights.area = 100;
    s.weights.seam = 5000;
    s.diagonal = 100;
    s.weld_distance = 1e-6;
    return s;
}

inline Settings qem() {
    Settings s;
    s.link = LinkCondition::on;
    return s;
}

// Both terms have the unit of a squared area, so that their balance does not depend on the scale.
inline Settings stmw() {
    Settings s;
    s.weights.base = BaseWeight::area;
    s.weights.area = 1;
    s.weights.area_term = AreaTerm::before_placement;
    return s;
}

// Memoryless quadrics are computed from the current surface, so that small normal deviations of earlier
// collapses are not penalised later. The flip test is therefore stricter than that of the paper.
inline Settings fast() {
    Settings s;
    s.quadric_policy = Settings::QuadricPolicy::memoryless;
    s.link = LinkCondition::by_size;
    s.min_normal_cosine = 0.3;
    s.min_fold_cosine = -0.9;
    return s;
}

inline Settings balanced() {
    Settings s = fast();
    s.quadric_policy = Settings::QuadricPolicy::tracked;
    return s;
}

inline Settings best() {
    Settings s = balanced();
    s.fit_vertices = true;
    return s;
}

inline Settings named(Preset preset) {
    switch (preset) {
        case Preset::qem:
            return qem();
        case Preset::paper:
            return paper();
        case Preset::stmw:
            return stmw();
        case Preset::fast:
            return fast();
        case Preset::balanced:
            return balanced();
        case Preset::best:
            break;
    }
    return best();
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

}  // namespace detail
FAQEM_NAMESPACE_END

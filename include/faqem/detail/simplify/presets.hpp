#pragma once
/// \file
/// The settings that each preset stands for.

#include "faqem/engine/metric/accumulated.hpp"
#include "faqem/export.hpp"
#include "faqem/option_types.hpp"

FAQEM_DETAIL_BEGIN

/// A preset combined with the weights and rules of the options.
struct Settings {
    /// memory: quadrics are accumulated over the collapses. memoryless: quadrics are computed from the
    /// current surface. tracked: as memoryless, and the distance to the original is part of the cost.
    enum class QuadricPolicy { memory, memoryless, tracked };
    QuadricPolicy quadric_policy = QuadricPolicy::memory;
    engine::CompositeWeights weights = {};
    LinkCondition link = LinkCondition::off;
    bool fit_vertices = false;  ///< vertices are fitted to the original after the last collapse
    /// Fold test: smallest cosine between the normals of adjacent faces; -1: off.
    double min_fold_cosine = -1;
    double min_normal_cosine = 0;  ///< flip test: smallest cosine between old and new normal of a face
    /// Bounding-box diagonal in engine units. It matters for the paper's terms, which have different units.
    double diagonal = 1;
    Weld weld = Weld::by_position;
    double weld_distance = 0;  ///< model units, >= 0
    std::optional<Length> prune = {};
};

/// The settings of a preset with the weights and topology options applied.
/// \pre options are valid
FAQEM_EXPORT Settings settings(const Options& options);

FAQEM_DETAIL_END

#ifdef FAQEM_HEADER_ONLY
#include "faqem/detail/simplify/presets-inl.hpp"
#endif

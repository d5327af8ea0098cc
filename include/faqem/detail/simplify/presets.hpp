#pragma once
/// \file
/// The table of presets: what each name stands for.

#include "faqem/engine/metric/accumulated.hpp"
#include "faqem/export.hpp"
#include "faqem/options.hpp"

FAQEM_NAMESPACE_BEGIN
namespace detail {

/// A preset with the user's weights and rules put in.
struct Settings {
    /// Memory: quadrics are summed up along the collapses. Memoryless: they belong to the surface as it is.
    /// Tracked: memoryless, and the distance to the original is watched.
    enum class QuadricPolicy { memory, memoryless, tracked };
    QuadricPolicy quadric_policy = QuadricPolicy::memory;
    engine::CompositeWeights weights;
    LinkCondition link = LinkCondition::off;
    bool fit_vertices = false;  ///< move the vertices closer to the original in the end
    double min_fold_cosine =
        -1;  ///< edges whose faces have a smaller cosine are folds; -1: as many as may come
    double min_normal_cosine = 0;  ///< flip veto: smallest cosine between old and new normal
    double diagonal = 1;  ///< the model is scaled to this diagonal: the paper's terms have different units
    Weld weld = Weld::by_position;
    double weld_distance = 0;  ///< model units
    std::optional<Length> prune = {};
};

/// \pre options are valid
Settings settings(const Options& options);

}  // namespace detail
FAQEM_NAMESPACE_END

#ifdef FAQEM_HEADER_ONLY
#include "faqem/detail/simplify/presets-inl.hpp"
#endif

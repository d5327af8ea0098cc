#pragma once
/// \file
/// Screen coverage of levels of detail, for save_levels().

#include <vector>

#include "faqem/asset.hpp"
#include "faqem/export.hpp"
#include "faqem/save_levels.hpp"
#include "scene/scene_size.hpp"

namespace faqem::detail {

/// Computes SavedLevel::coverage of a level, by part, for the largest scale of the part.
/// \param source       asset whose bounding boxes are used
/// \param size         scene_size() of `source`
/// \param error        error of the level, in units of the scene; if it is 0 the coverage is infinite
/// \param error_share  fraction of the screen height that the error may cover: 1.0 / 1080 is one of 1080
///                     pixels
/// Complexity: O(vertices).
FAQEM_EXPORT std::vector<double> level_coverage(const Asset& source, const SceneSize& size, double error,
                                                double error_share);

/// Computes SavedLevel::coverage of all levels, with the bounding boxes of the first one.
/// \param errors        of the levels; 0 or NaN for the original
/// \param screen_error  as `error_share`
/// \throws OptionError  `screen_error` is not finite or not above 0
FAQEM_EXPORT void set_coverage(std::vector<SavedLevel>& levels, const std::vector<double>& errors,
                               double screen_error);

}  // namespace faqem::detail

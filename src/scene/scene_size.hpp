#pragma once
/// \file
/// Size of a scene, scales of its parts, and what they cover of a screen, for save_levels().

#include <vector>

#include "faqem/asset.hpp"
#include "faqem/export.hpp"
#include "faqem/option_types.hpp"
#include "faqem/save_levels.hpp"

namespace faqem::detail {

/// Bounds of the scale of a part in the scene: the maxima, over its instances, of the smallest and of the
/// largest singular value of the transform. 1 and 1 if the scene has no instance of the part.
struct PartScale {
    double smallest = 1, largest = 1;
};

/// Size of a scene and scales of its parts.
struct SceneSize {
    std::vector<PartScale> scales;  ///< by part
    double diagonal = 0;  ///< of the bounding box of all instances, without degenerate faces; scene units

    /// Converts a length to units of the scene.
    double operator()(const Length& length) const {
        return length.unit == Length::Unit::model ? length.value : length.value * diagonal;
    }
};

/// Computes the size of a scene and the scales of its parts.
/// \throws InputError if an index is out of range
/// Complexity: O(faces log faces).
FAQEM_EXPORT SceneSize scene_size(const Asset& source);

/// Options for the simplification of one part: Topology::prune is converted to the part's units at its
/// largest scale, and unset if this scale is 0.
/// \param options  for the whole asset
/// \param size     size of the scene
/// \param scale    scale of the part
Options part_options(const Options& options, const SceneSize& size, const PartScale& scale);

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

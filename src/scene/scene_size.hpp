#pragma once
/// \file
/// Size of a scene and scales of its parts.

#include <vector>

#include "faqem/asset.hpp"
#include "faqem/export.hpp"
#include "faqem/option_types.hpp"

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

}  // namespace faqem::detail

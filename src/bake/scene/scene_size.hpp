#pragma once
/// \file
/// How large a scene and its parts are in the scene's units.

#include <vector>

#include "faqem/asset.hpp"
#include "faqem/export.hpp"
#include "faqem/options.hpp"

namespace faqem::detail {

/// By how much the scene shrinks and stretches a part at least and at most, over all its instances; 1 and 1
/// where it does not show the part.
struct PartScale {
    double smallest = 1, largest = 1;
};

/// Sizes of a scene.
struct SceneSize {
    std::vector<PartScale> scales;  ///< by part
    double diagonal = 0;            ///< of the box of all instances' faces with area

    /// In units of the scene.
    double operator()(const Length& length) const {
        return length.unit == Length::Unit::model ? length.value : length.value * diagonal;
    }
};

/// How large the scene is, and how large it shows its parts.
/// \throws InputError  an index is out of range
/// O(faces log faces)
FAQEM_EXPORT SceneSize scene_size(const Asset& source);

/// What a part is simplified with: Topology::prune in the part's own units, at its largest scale; unset where
/// the scene shrinks the part to nothing.
/// \param size  of the scene
/// \param scale  the part's
Options part_options(const Options& options, const SceneSize& size, const PartScale& scale);

}  // namespace faqem::detail

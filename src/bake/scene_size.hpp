#pragma once
/// \file
/// How large a scene and its parts are in the scene's units.

#include <vector>

#include "faqem/asset.hpp"
#include "faqem/options.hpp"

namespace faqem::detail {

/// By how much the scene shrinks and stretches a part at least and at most, over all its instances; 1 and 1
/// where it does not show the part.
struct PartScale {
    double least = 1, most = 1;
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

/// What a part is simplified with: lengths in its own units.
Options part_options(const Options& options, const SceneSize& size, const PartScale& scale);

/// \throws InputError  an index is out of range
/// O(faces log faces)
SceneSize scene_size(const Asset& source);

}  // namespace faqem::detail

#pragma once
/// \file
/// How large a level may be seen, for save_levels().

#include <vector>

#include "bake/scene/scene_size.hpp"
#include "faqem/asset.hpp"
#include "faqem/export.hpp"

namespace faqem::detail {

/// SavedLevel::coverage of a level: by part, at the largest that the scene shows it.
/// \param source       whose boxes count
/// \param size         of its scene
/// \param error        of the level, in units of the scene; 0: as large as one likes (infinity)
/// \param error_share  of the screen's height that the error may cover: 1 / 1080 is a pixel of 1080
/// O(vertices)
FAQEM_EXPORT std::vector<double> level_coverage(const Asset& source, const SceneSize& size, double error,
                                                double error_share);

}  // namespace faqem::detail

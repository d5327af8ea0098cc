#pragma once
/// \file
/// Detection of animated and deformable scenes.

#include "faqem/asset.hpp"
#include "faqem/export.hpp"

namespace faqem::detail {

/// Whether the scene has animations, or parts with skins or morph targets. O(parts)
FAQEM_EXPORT bool is_dynamic(const Asset& asset);

}  // namespace faqem::detail

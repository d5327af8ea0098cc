#pragma once
/// \file
/// Options::max_error for a scene.

#include "faqem/bake.hpp"

namespace faqem::detail {

/// simplify_parts() with max_error: searches over the face count of the whole asset, one call of
/// simplify_parts() for each try. \pre options are valid
SmallParts simplify_parts_within(const Asset& source, const Options& options);

}  // namespace faqem::detail

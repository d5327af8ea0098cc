#pragma once
/// \file
/// Parts that keep their vertices or UVs keep their materials, and the images of these.

#include <cstdint>
#include <span>

#include "bake/keep/kept_uvs.hpp"
#include "bake/texture/bake_job.hpp"

namespace faqem::detail {

/// Replaces the empty parts that baking leaves for BakeJob::skipped: by those of the source or by those that keep
/// their UVs. Adds their materials and images, and reports untouched parts. The images of materials that are only on
/// parts that keep their UVs are listed to be encoded again, see add_kept_images(); not if the job is late.
/// \param untouched  by part: whether it is that of the source
void add_kept_parts(BakeJob& job, std::span<const std::uint8_t> untouched, KeptUvs kept);

}  // namespace faqem::detail

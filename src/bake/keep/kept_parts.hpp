#pragma once
/// \file
/// Parts that keep their vertices or UVs keep their materials, and the images of these.

#include <cstdint>
#include <span>
#include <vector>

#include "bake/keep/kept_images.hpp"
#include "bake/parts/corners.hpp"
#include "faqem/bake.hpp"

namespace faqem::detail {

/// Replaces the empty parts that baking leaves for BakePart::is_kept, by those of the source or by those that keep their
/// UVs. Adds their materials, those of their variants, and images, and reports untouched parts.
/// \param untouched      by part: whether it is that of the source
/// \param with_uvs       has the other kept parts
/// \param has_materials  whether the result has all materials and images of the source
/// \return all kept parts
std::vector<KeptPart> add_kept_parts(const Asset& source, std::span<const BakePart> parts,
                                     std::span<const std::uint8_t> untouched, Asset with_uvs,
                                     bool has_materials, SimplifiedAsset& result);

}  // namespace faqem::detail

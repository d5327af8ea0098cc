#pragma once
/// \file
/// Parts that keep their vertices or UVs, and their materials and images.

#include <cstdint>
#include <span>
#include <vector>

#include "bake/keep/kept_images.hpp"
#include "bake/parts/corners.hpp"
#include "faqem/bake.hpp"

namespace faqem::detail {

/// By part of the source: whether it is kept as it is (BakeOptions::untouched). Such a part has as many faces
/// as its target allows, apart from duplicates and faces without area, and no vertex has moved.
/// \param simplified  matches the source
/// Complexity: O(faces).
std::vector<std::uint8_t> find_untouched_parts(const Asset& source, const SimplifiedParts& simplified,
                                               const BakeOptions& bake);

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

#pragma once
/// \file
/// What a glTF document refers to by the UVs of its meshes, beside their own materials.

#include <cstdint>
#include <vector>

#include "asset/gltf/json.hpp"
#include "faqem/asset.hpp"
#include "faqem/export.hpp"

namespace faqem::detail {

/// The materials that the variants of a part's mesh show (KHR_materials_variants): indices into Asset::materials, each
/// once, ascending, without those that the asset does not have.
/// Complexity: O(variants * materials).
FAQEM_EXPORT std::vector<Index> variant_materials(const Asset& asset, const Part& part);

/// By material of a document: nonzero if an animation moves one of its textures (KHR_animation_pointer).
/// Complexity: O(animation channels * materials).
FAQEM_EXPORT std::vector<std::uint8_t> materials_with_moving_textures(const Json& document);

/// By part: nonzero if something would lose its meaning with new UVs and images: material variants, or an animation of a
/// texture transform (KHR_animation_pointer) of one of its materials.
/// Complexity: O(faces + variants * materials + animation channels).
FAQEM_EXPORT std::vector<std::uint8_t> parts_that_need_uvs(const Asset& asset);

}  // namespace faqem::detail

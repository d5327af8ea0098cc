#pragma once
/// \file
/// Conversion of materials of an OBJ material library to those of an asset.

#include "asset/formats/mtl.hpp"
#include "asset/formats/referenced_images.hpp"
#include "faqem/asset.hpp"

namespace faqem::detail {

/// Adds a material and its images to an asset.
///
/// - An image that is missing or outside the folder is a warning, and the material has no such texture.
/// - map_d in an image of its own becomes the alpha of the base colour texture, which is encoded as PNG; one
///   that is white everywhere has no effect, and one that would hide everything neither, with a warning.
/// - bump is a normal map if is_normal_map(), with -bm as its scale, and otherwise a height map, of which a
///   normal map is made: white is -bm / 64 of the texture's side above black. Without pixels that can be
///   decoded it is left out with a warning.
/// - map_Pr and map_Pm become one texture and replace the factors. If both are the same image, which is not
///   grey, roughness is in green and metal in blue, as in glTF.
/// \param asset   receives materials and warnings
/// \param images  of the asset
/// \return index into Asset::materials
Index add_mtl_material(Asset& asset, ReferencedImages& images, const MtlMaterial& material);

}  // namespace faqem::detail

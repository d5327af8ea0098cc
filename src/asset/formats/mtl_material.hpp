#pragma once
/// \file
/// Conversion of materials of an OBJ material library to those of an asset.

#include "asset/formats/mtl.hpp"
#include "asset/formats/referenced_images.hpp"
#include "faqem/asset.hpp"

namespace faqem::detail {

/// Adds materials and their images to an asset.
///
/// - An image that is missing or outside the folder is a warning, and the material has no such texture.
/// - map_d in an image of its own becomes the alpha of the base colour texture, which is encoded as PNG; one
///   that is white everywhere has no effect, and one that would hide everything neither, with a warning.
/// - bump is a normal map if is_normal_map(), with -bm as its scale, and otherwise a height map, of which a
///   normal map is made: white is -bm / 64 of the texture's side above black. Without pixels that can be
///   decoded it is left out with a warning.
/// - map_Pr and map_Pm become one texture and replace the factors. If both are the same image, which is not
///   grey, roughness is in green and metal in blue, as in glTF.
class MtlMaterials {
public:
    /// \param asset   receives materials and warnings; must outlive this
    /// \param images  of the asset; must outlive this
    MtlMaterials(Asset& asset, ReferencedImages& images) : asset_(asset), images_(images) {}

    /// \return index into Asset::materials
    Index add(const MtlMaterial& material);

private:
    void set_base_color(Material& to, const MtlMaterial& from);
    void set_alpha(Material& to, const MtlMaterial& from, ReferencedImage* color, ReferencedImage& alpha);
    void set_normals(Material& to, const MtlMaterial& from);
    void set_bump(Material& to, const MtlMaterial& from, ReferencedImage& image);
    void set_roughness_metallic(Material& to, const MtlMaterial& from);
    ReferencedImage* read(const MtlMaterial& material, const MtlTexture& texture);
    void warn(const MtlMaterial& material, const std::string& what);

    Asset& asset_;
    ReferencedImages& images_;
};

}  // namespace faqem::detail

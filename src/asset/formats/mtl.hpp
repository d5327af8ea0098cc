#pragma once
/// \file
/// OBJ material libraries.

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "faqem/asset.hpp"
#include "faqem/export.hpp"

namespace faqem::detail {

/// A texture statement (`map_Kd` ...) as written.
struct MtlTexture {
    std::string file;                       ///< as written; empty: none
    Vec2f offset = {0, 0}, scale = {1, 1};  ///< -o and -s, v pointing up
    Wrap wrap = Wrap::repeat;               ///< -clamp
};

/// A material of a library. Texture files are relative to the folder of the library.
struct MtlMaterial {
    std::string name;
    std::filesystem::path folder;  ///< of the library, relative to the OBJ file
    Material values;               ///< all but the textures
    MtlTexture color, alpha, emissive, normal;
};

/// Parses a library. Its conventions become those of Material: Kd and Ke are display values (sRGB) and are
/// made linear; Kd 0 0 0 with a map_Kd means white, as several exporters write it (warning); d, or 1 - Tr, is
/// the alpha of the base colour and makes it blend; Pr and Pm are roughness and metallic; without them
/// metallic is 0 and roughness (2 / (Ns + 2))^(1/4), 1 without Ns. map_Kd, map_Ke, norm, and a map_d of the
/// same image as map_Kd are textures; -o, -s and -clamp are used, the other options skipped. Ka, map_Ka, Ks,
/// Ni, Tf, illum and sharpness have no place in the material and are skipped; other statements are skipped
/// with a counted warning. Source of the Ns formula: Karis, "Specular BRDF reference", 2013, with alpha =
/// roughness^2.
/// \param name  for messages
/// \throws InputError  a number is not one, or a statement comes before the first newmtl
FAQEM_EXPORT std::vector<MtlMaterial> read_mtl(std::span<const std::uint8_t> text, const std::string& name,
                                               std::vector<std::string>& warnings);

/// Adds a material and the images it uses to the asset. An image already there is shared. An image that is
/// missing or lies outside the folder is a warning: the material keeps its colour.
/// \param folder  of the OBJ file, in which everything must lie
/// \return index into asset.materials
Index add_material(Asset& asset, const MtlMaterial& material, const std::filesystem::path& folder);

}  // namespace faqem::detail

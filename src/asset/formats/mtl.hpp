#pragma once
/// \file
/// The material libraries of OBJ files (MTL files): their names and content, and conversion of their materials to those
/// of an asset.

#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "asset/image/combine.hpp"
#include "asset/io/file_finder.hpp"
#include "asset/scene/messages.hpp"
#include "faqem/asset.hpp"

namespace faqem::detail {

/// A texture statement (`map_Kd` ...) as written.
struct MtlTexture {
    std::string file;                                  ///< as written; empty: no texture
    Vec2f offset = {0, 0}, scale = {1, 1};             ///< -o and -s, v pointing up
    Wrap wrap = Wrap::repeat;                          ///< -clamp
    float multiplier = 1;                              ///< -bm
    ScalarChannel channel = ScalarChannel::automatic;  ///< -imfchan; `z` is read as luminance
};

/// A material of a library. Texture files are relative to the folder of the library.
struct MtlMaterial {
    std::filesystem::path folder;  ///< folder of the library, relative to the folder of the OBJ file
    Material values;               ///< everything except the textures
    MtlTexture color, alpha, emissive, normal;
    MtlTexture bump;                 ///< a normal map or a height map: only its image tells
    MtlTexture roughness, metallic;  ///< if set, they replace the factors
};

/// Parses a material library and converts its values to the conventions of Material.
///
/// - Kd and Ke are sRGB values and are converted to linear. Kd 0 0 0 with a map_Kd is read as white, with a
///   warning, since several exporters write it so.
/// - d, or 1 - Tr, is the alpha of the base colour; below 1, the alpha mode is blend. 0 is read as 1, with a
///   warning: programs for photogrammetry write Tr 1, and others d 0, for opaque materials.
/// - Pr is the roughness; without it, roughness = (2 / (Ns + 2))^(1/4), or 1 without Ns. The formula follows
///   Karis, "Specular BRDF reference", 2013, with alpha = roughness^2.
/// - Pm is the metallic factor; the default is 0.
/// - map_Kd, map_Ke, map_d, map_Pr, map_Pm, norm, and bump or map_Bump are textures. map_Ka is ignored beside a
///   map_Kd, and otherwise read as one, with a warning. Of the options, -o, -s, -clamp, -bm and -imfchan are
///   used; the others are ignored. Options may follow the file name.
/// - Ka, Ks, Ni, Tf, Km, illum and sharpness have no equivalent in Material and are ignored, as are the other
///   options. Other statements, and statements before the first newmtl, are ignored with a counted warning.
/// - Keywords may have any letter case.
/// \param text      borrowed
/// \param name      path of the library, for messages
/// \param warnings  receives the warnings
/// \param ignored   receives the statements and options without an equivalent
/// \return the materials in the order of the file
/// \throws InputError  with the line, if a number is invalid
std::vector<MtlMaterial> read_mtl(std::span<const std::uint8_t> text, const std::string& name,
                                  std::vector<std::string>& warnings, IgnoredStatements& ignored);

/// Returns the texture statements of a library without their keywords: map_* of any kind, bump, disp, decal,
/// refl and norm, in any case, also those that read_mtl() ignores. A statement has options and a file name.
/// Libraries that read_mtl() rejects are accepted.
/// \param text  borrowed
/// \param name  path of the library
std::vector<std::string> texture_statements(std::span<const std::uint8_t> text, const std::string& name);

/// Returns the file names in an mtllib statement. The whole statement is one name if such a file exists;
/// otherwise it is split after each `.mtl`.
/// \param statement  without its keyword
/// \param folder     folder of the OBJ file
std::vector<std::string> library_names(const std::string& statement, const std::filesystem::path& folder);

/// Finds a library that an OBJ file names. If it is missing, the only library in the folder stands in for it, unless that
/// has the name of another OBJ file there.
/// \param model  path of the OBJ file
/// \throws InputError  there is none: the error of FileFinder::find()
FoundFile find_library(const std::string& name, const std::filesystem::path& model, FileFinder& finder);

/// Reads all material libraries. If a name is defined repeatedly, the last definition is used. A library that is
/// missing, or found under another name, is a warning.
/// \param statements  mtllib statements without their keyword
/// \param model       path of the OBJ file
/// \param warnings    receives the warnings
/// \param ignored     as for read_mtl()
/// \return the materials by name
/// \throws InputError  as read_mtl()
std::map<std::string, MtlMaterial> read_libraries(const std::vector<std::string>& statements,
                                                  const std::filesystem::path& model, FileFinder& finder,
                                                  std::vector<std::string>& warnings,
                                                  IgnoredStatements& ignored);

class ReferencedImages;

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

#pragma once
/// \file
/// The content of a file of polygons (PLY, OFF) as it is stored, and its conversion to an asset.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "asset/scene/triangulate.hpp"
#include "faqem/asset.hpp"

namespace faqem::detail {

/// The faces of a file, and what they store beside their vertices. Arrays are empty if the file does not have them.
struct PolygonFaces {
    Polygons polygons;
    std::vector<Vec2f> uvs;             ///< by corner, v pointing down
    std::vector<std::uint8_t> has_uvs;  ///< by face: whether it has coordinates
    std::vector<double> textures;       ///< by face: number of the texture
    std::vector<Vec4f> colors;          ///< by face, linear
};

/// The content of a file.
struct PolygonContent {
    Part part;  ///< positions and attributes of the vertices
    PolygonFaces faces;
    Polygons strips;                          ///< triangles of strips
    std::vector<std::string> not_understood;  ///< as Asset::not_understood
};

/// Converts the content of a file to an asset of one part.
///
/// - Vertices whose corners differ in texture coordinates or face colour are repeated after all others.
/// - Each texture file becomes a material, if faces with coordinates refer to it; without numbers they refer to
///   the first. A face with a number below 0 has no texture, and one with a number that no file has neither,
///   with a warning.
/// - Colours are those of vertices, else those of faces. Faces with a texture have none: programs store the
///   colours of the texture again, and they would be multiplied. A warning says so.
/// \param texture_files  as named, in the folder of the model or below it
/// \param file           path of the model
/// \param warnings       of the reader; moved to the asset
/// \throws InputError  there are no faces, or more elements than indices
Asset polygon_asset(PolygonContent content, const std::vector<std::string>& texture_files,
                    const std::filesystem::path& file, std::vector<std::string> warnings);

}  // namespace faqem::detail

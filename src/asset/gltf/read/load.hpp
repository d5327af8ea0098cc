#pragma once
/// \file
/// Loading of a glTF file to a validated document, and its conversion to parts and materials.

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "asset/gltf/source_document.hpp"

namespace faqem::detail {

/// A loaded document, before it is converted to an Asset.
struct LoadedGltf {
    std::string file;                        ///< path for messages
    std::shared_ptr<SourceDocument> source;  ///< has the buffers and images; materials are still empty
    std::vector<std::string> warnings;
};

/// Parses and validates the JSON of a file. Members that are null are left out, as if they were absent.
/// \param file  path for messages
/// \throws InputError, UnsupportedError  as read_gltf()
Json parse_gltf(std::string_view json, const std::string& file);

/// Loads and validates a glTF file, with its buffers and images, and decompresses it.
/// \param bytes  the whole file, borrowed
/// \param file   path for messages; buffers and images are searched in its folder
/// \throws ReadError, InputError, UnsupportedError  as read_gltf()
LoadedGltf load_gltf(std::span<const std::uint8_t> bytes, const std::filesystem::path& file);

/// Joins the triangle primitives of a mesh to one part. Points and lines remain in the source document only.
/// \param loaded         the document; warnings are added to it
/// \param mesh           index of the mesh
/// \param dropped_faces  increased by the number of faces left out because of a non-finite position
/// \throws InputError  if an index is out of range or there are too many vertices
Part read_part(LoadedGltf& loaded, Index mesh, std::uint64_t& dropped_faces);

/// Sets Asset::normal_bits and uv_bits to their defaults if vertices of the document are integers.
/// \param loaded  the document
/// \param asset   has the parts
void read_vertex_bits(const LoadedGltf& loaded, Asset& asset);

/// Reads all materials. TextureRef::image is an index into the images of the document.
/// \param loaded  the document; warnings are added to it
std::vector<Material> read_materials(LoadedGltf& loaded);

}  // namespace faqem::detail

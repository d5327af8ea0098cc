#pragma once
/// \file
/// State shared by the functions that write glTF. Objects of the source document are copied to the output
/// when they are first needed, so that the output has no unused objects.

#include <deque>
#include <map>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "asset/gltf/source_document.hpp"
#include "asset/gltf/write/buffer_builder.hpp"
#include "asset/gltf/write/draco_encoder.hpp"
#include "asset/gltf/write/mesh_grid.hpp"

namespace faqem::detail {

/// Vertices and corners of a primitive. An array is empty if the primitive does not have the attribute.
struct PrimitiveData {
    std::vector<Index> vertices;  ///< used vertices of the part; ascending with FileOrder::given
    std::vector<Index> corners;   ///< indices into `vertices`, three per triangle
    std::vector<Vec3f> positions, normals;
    std::vector<Vec4f> tangents, colors, weights;
    std::vector<std::array<std::uint16_t, 4>> joints;
};

/// The output document under construction, and maps from source and asset objects to output objects.
struct GltfWriter {
    const Asset& asset;
    const SourceDocument& source;  ///< empty if the asset has no source document
    Json out;                      ///< the output document
    Vec3 origin = {0, 0, 0};       ///< subtracted from all positions; translation of the nodes of new meshes
    GltfBufferBuilder binary = GltfBufferBuilder();
    std::vector<std::string> warnings = {};

    std::map<Index, Index> accessors = {};         ///< source accessor to output accessor
    std::map<Index, Index> asset_materials = {};   ///< asset material to output material
    std::map<Index, Index> source_materials = {};  ///< source material, copied unchanged, to output material
    /// Source texture and the asset image that it has instead of its own, or no_index, to output texture.
    std::map<std::pair<Index, Index>, Index> source_textures = {};
    std::map<Index, Index> source_samplers = {};
    std::map<Index, Index> source_images = {};
    std::map<Index, Index> asset_images = {};  ///< asset image without an equal source image to output image
    std::map<std::tuple<Index, Wrap, Wrap, Filter>, Index> textures = {};
    std::map<std::tuple<Wrap, Wrap, Filter>, Index> samplers = {};
    std::vector<const Image*> images = {};    ///< the output images, borrowed
    std::deque<Image> converted_images = {};  ///< images of kinds that glTF does not have, as PNG
    /// Per asset image: a source image with equal bytes, or no_index.
    std::vector<Index> source_image_of = {};
    /// Per source image, after write_numbered_objects(): the asset image that is written instead, or no_index.
    std::vector<Index> replaced_images = {};
    std::vector<Index> mesh_map = {};  ///< source mesh to output mesh; no_index if it was left out
    std::vector<MeshGrid> grids = {};  ///< by output mesh
    /// Receives the attributes of a primitive instead of `binary`, while it is not null.
    std::vector<DracoValues>* draco = nullptr;
    bool needs_quantization = false;  ///< a primitive needs KHR_mesh_quantization
    /// By part: the source mesh whose primitives give extras and extensions; empty: Part::source.
    std::span<const Index> sources = {};
};

/// Returns the output object of a key, which make() writes on first use. While it does, the object is no_index.
template <class Key, class Make>
Index once(std::map<Key, Index>& written, const Key& key, const Make& make) {
    const auto [entry, is_new] = written.try_emplace(key, no_index);
    if (is_new) entry->second = make();
    return entry->second;
}

/// The top-level array `key` of the source document, or null.
const Json& source_array(const GltfWriter& writer, const char* key);

/// Appends an element to the top-level array `key` of the output. Returns its index.
Index append(GltfWriter& writer, const char* key, Json value);

/// Copies a source accessor with its data on first use. Sparse accessors become dense.
/// \return the output accessor
Index copy_accessor(GltfWriter& writer, Index accessor, AccessorUse use);

/// Copies a source texture on first use, with its sampler, extras and the images of extensions.
/// \param image  image of the asset that it has instead of these; no_index: none
/// \return the output texture
Index copy_texture(GltfWriter& writer, Index texture, Index image = no_index);

/// Creates the output texture for a texture reference of the asset. Equal textures are shared.
Index make_texture(GltfWriter& writer, const TextureRef& ref);

/// Copies a source image on first use. Returns the output image.
Index copy_image(GltfWriter& writer, Index image);

/// Computes GltfWriter::source_image_of.
void find_source_images(GltfWriter& writer);

/// Writes an asset material, or for no_index the default one, on first use. Returns the output material.
Index write_material(GltfWriter& writer, Index material);

/// Writes a source material that is used by a copied primitive or a material variant, on first use.
/// \return the output material
Index write_source_material(GltfWriter& writer, Index material);

/// Writes all source images, textures and materials in their order, if an extension names them by number. Images that
/// the asset has instead of those of the source get their numbers.
void write_numbered_objects(GltfWriter& writer);

/// Chooses an origin for the positions of all parts, because the precision of floats, which glTF stores, is
/// low far away from 0. The origin is common to all parts, so that positions they share stay equal. Each
/// coordinate is 0 if the bounding box is close enough to 0 on that axis, otherwise a multiple of a power of
/// two of about the size of the bounding box.
Vec3 local_origin(const std::vector<Part>& parts);

/// Gathers the vertices and corners of some faces of a part, in the order of Part::file_order. Zero normals are replaced by the area-weighted
/// mean of the adjacent face normals.
/// \param faces    indices of triangles of the part
/// \param origin   subtracted from the positions
/// \param scratch  one no_index per vertex of the part; restored on return
/// \throws WriteError  if a position exceeds the range of float
PrimitiveData gather_primitive(const Part& part, const std::vector<Index>& faces, const Vec3& origin,
                               std::vector<Index>& scratch);

/// The members that the output primitive of a part with the given asset material keeps from the source:
/// extras and extensions of the corresponding triangle primitives, if these agree. Extensions that do not fit
/// the new vertices or textures are left out with a warning.
/// \param data  vertices and corners of the output primitive
Json carried_primitive_members(GltfWriter& writer, const Part& part, Index material,
                               const PrimitiveData& data);

/// Adds a warning about a mesh.
void warn_mesh(GltfWriter& writer, const std::string& name, const std::string& what);

/// Writes the materials of the variants of a primitive, and replaces their indices.
void remap_variants(GltfWriter& writer, Json& primitive);

/// The source mesh whose primitives give extras and extensions to those of a part of the asset; no_index: none.
Index source_mesh(const GltfWriter& writer, const Part& part);

/// Adds EXT_mesh_manifold to the extensions of a mesh if the source mesh has one primitive and its vertices and triangles
/// are those of the output primitive.
void keep_manifold(GltfWriter& writer, const Part& part, const PrimitiveData& data, const Json& primitive,
                   Json& extensions);

/// Appends the primitives of a part: one per material, in the order of first use.
/// \param grid             of the positions
/// \param mesh_extensions  receives extensions of the mesh that fit it if the primitive is the only one
void write_part(GltfWriter& writer, const Part& part, const MeshGrid& grid, Json& primitives,
                Json& mesh_extensions);

/// Writes all meshes and sets GltfWriter::mesh_map.
/// \param new_meshes  receives the output meshes of parts without a source mesh
void write_meshes(GltfWriter& writer, std::vector<Index>& new_meshes);

/// Number of morph targets of an output mesh: the most of its primitives; 0 for no_index.
Index morph_target_count(const GltfWriter& writer, Index mesh);

/// Writes nodes, skins and animations, and remaps the references of extensions. place_grids() comes afterwards.
/// \param new_meshes  output meshes that get new nodes
void write_scene(GltfWriter& writer, const std::vector<Index>& new_meshes);

/// Replaces the buffer views and textures of EXT_structural_metadata of the document; leaves the extension out with a
/// warning if it refers to others than the document has.
/// \pre all accessors are added
void remap_structural_metadata(GltfWriter& writer);

/// Writes extensionsUsed and extensionsRequired according to the extensions in the output.
void write_extension_lists(GltfWriter& writer);

}  // namespace faqem::detail

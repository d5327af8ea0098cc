#pragma once
/// \file
/// State shared by the rooms that write glTF. What the output needs is copied from the source when it is
/// first asked for, so that nothing unused gets in.

#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "asset/gltf/binary.hpp"
#include "asset/source_document.hpp"

namespace faqem::detail {

struct GltfWriter {
    const Asset& asset;
    const SourceDocument& source;  ///< an empty one where the asset has none
    Json out;                      ///< the document under construction
    Vec3 origin = {0, 0, 0};       ///< of all positions; the nodes of new meshes put it back
    GltfBufferBuilder binary = {};
    std::vector<std::string> warnings = {};

    std::map<Index, Index> accessors = {};         ///< source accessor to output accessor
    std::map<Index, Index> asset_materials = {};   ///< asset material to output material
    std::map<Index, Index> source_materials = {};  ///< copied as they were
    std::map<Index, Index> source_textures = {};
    std::map<Index, Index> source_samplers = {};
    std::map<Index, Index> source_images = {};
    std::map<Index, Index> asset_images = {};  ///< those that are not among the source's
    std::map<std::tuple<Index, Wrap, Wrap, Filter>, Index> textures = {};
    std::map<std::tuple<Wrap, Wrap, Filter>, Index> samplers = {};
    std::vector<const Image*> images = {};  ///< by output image
    std::vector<Index> source_image_of =
        {};                            ///< per asset image: the source image of equal bytes, or no_index
    std::vector<Index> mesh_map = {};  ///< source mesh to output mesh, no_index: left out
    bool needs_quantization = false;   ///< a primitive that is passed through needs KHR_mesh_quantization
};

/// The source's array `key`, or null.
const Json& source_array(const GltfWriter& writer, const char* key);

/// Appends to the output's array `key`. \return the new element's index
Index append(GltfWriter& writer, const char* key, Json value);

/// Copies an accessor of the source with its data, once. Sparse ones become plain.
Index copy_accessor(GltfWriter& writer, Index accessor, AccessorUse use);

/// Output texture for a texture of the source, sampler, extras and alternatives included.
Index copy_texture(GltfWriter& writer, Index texture);

/// Output texture for a reference of the asset.
Index make_texture(GltfWriter& writer, const TextureRef& ref);

/// Output image for an image of the source.
Index copy_image(GltfWriter& writer, Index image);

/// Fills source_image_of.
void find_source_images(GltfWriter& writer);

/// Output material for a material of the asset.
Index write_material(GltfWriter& writer, Index material);

/// Output material for a material of the source that some primitive or variant still uses.
Index write_source_material(GltfWriter& writer, Index material);

/// Extras and extensions for the primitive of a part that has the given asset material: those of the source's
/// triangle primitives it stems from, as far as they agree.
Json primitive_base(GltfWriter& writer, const Part& part, Index material);

/// Appends the primitives of a part, one per material in order of first use.
void write_part(GltfWriter& writer, const Part& part, Json& primitives);

/// Writes all meshes and fills mesh_map; `new_meshes` gets those of parts without a source.
void write_meshes(GltfWriter& writer, std::vector<Index>& new_meshes);

/// Nodes, skins, animations and what extensions refer to.
void write_scene(GltfWriter& writer, const std::vector<Index>& new_meshes);

/// extensionsUsed and extensionsRequired, from what the output really holds.
void write_extension_lists(GltfWriter& writer);

}  // namespace faqem::detail

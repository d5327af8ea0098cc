#pragma once
/// \file
/// Textured scenes: what is loaded from a file and saved to one. No type of a file library appears here.

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "faqem/export.hpp"
#include "faqem/mesh.hpp"

namespace faqem {

/// An image as its file holds it; decode() makes pixels of it.
struct Image {
    std::string name;
    std::string mime_type;  ///< image/png, image/jpeg, ... found from the bytes, not from the name
    std::vector<std::uint8_t> encoded;  ///< the file's bytes
    std::string uri;  ///< relative path in the asset's folder where it came from one, else empty
};

/// Pixels, 8 bits per channel, RGBA, row 0 at the top. Colours are sRGB encoded as in the file.
struct Pixels {
    std::uint32_t width = 0, height = 0;
    std::vector<std::uint8_t> rgba;  ///< width * height * 4
    bool has_alpha = false;          ///< false: every alpha is 255
};

enum class Wrap { repeat, mirror, clamp };
enum class Filter { linear, nearest };

/// Use of an image by a material.
struct TextureRef {
    Index image = no_index;    ///< into Asset::images; no_index: no texture
    std::uint32_t uv_set = 0;  ///< into Part::uvs
    Wrap wrap_u = Wrap::repeat, wrap_v = Wrap::repeat;
    Filter filter = Filter::linear;
    /// KHR_texture_transform: uv' = offset + R(rotation) * (scale * uv), v pointing down as in glTF.
    Vec2f offset = {0, 0}, scale = {1, 1};
    float rotation = 0;  ///< radians

    explicit operator bool() const { return image != no_index; }
    bool operator==(const TextureRef&) const = default;
};

enum class AlphaMode { opaque, mask, blend };

/// A texture of a material extension that faqem knows to bake: docs/baking.md names them.
struct ExtensionTexture {
    std::string extension, name;  ///< as in glTF, e.g. KHR_materials_clearcoat and clearcoatNormalTexture
    TextureRef texture;
    float normal_scale = 1;  ///< of normal maps; otherwise not used
};

/// A glTF 2.0 metallic-roughness material. OBJ's Kd, map_Kd and d are translated to it.
struct Material {
    std::string name;
    Vec4f base_color = {1, 1, 1, 1};  ///< linear, times the texture and the vertex colour
    TextureRef base_color_texture;
    float metallic = 1, roughness = 1;
    TextureRef metallic_roughness_texture;  ///< roughness in G, metallic in B
    TextureRef normal_texture;
    float normal_scale = 1;
    TextureRef occlusion_texture;  ///< in R
    float occlusion_strength = 1;
    Vec3f emissive = {0, 0, 0};
    TextureRef emissive_texture;
    AlphaMode alpha_mode = AlphaMode::opaque;
    float alpha_cutoff = 0.5f;
    bool double_sided = false;
    bool unlit = false;
    /// Each name of an extension once; their factors live in the source document.
    std::vector<ExtensionTexture> extension_textures;
    /// Names of extensions other than KHR_materials_unlit and KHR_texture_transform, sorted.
    std::vector<std::string> extensions;
    /// Material of the source document whose extras and extensions go along when saved; no_index: none.
    Index source = no_index;
    /// The UVs were made anew: textures of the source that are not named above no longer fit and are left out.
    bool rebaked = false;
};

/// Change of positions (and normals) of one morph target; empty or one per vertex.
struct MorphTarget {
    std::vector<Vec3f> positions, normals;
};

/// One mesh of a scene: all its primitives in one pair of arrays. Vertices that differ in any attribute are
/// separate vertices, as in glTF; the engine welds them by position.
struct Part {
    std::string name;
    std::vector<Vec3> positions;          ///< V
    std::vector<Triangle> triangles;      ///< F
    std::vector<Index> face_material;     ///< F indices into Asset::materials, no_index: the default material
    std::vector<Vec3f> normals;           ///< empty or V; zero where the file gave none
    std::vector<Vec4f> tangents;          ///< empty or V
    std::vector<std::vector<Vec2f>> uvs;  ///< sets of V each, v pointing down as in glTF
    std::vector<Vec4f> colors;            ///< empty or V, linear RGBA
    std::vector<std::array<std::uint16_t, 4>> joints;  ///< empty or V
    std::vector<Vec4f> weights;                        ///< empty or V
    std::vector<MorphTarget> morph_targets;
    Index source = no_index;  ///< mesh of the source document; its name, extras, points and lines go along
};

/// What a format's reader keeps for its writer (a glTF document: scene graph, cameras, animations, extras).
struct SourceDocument;

/// A scene. Its nodes and everything else that is not a mesh, material or image live in `source`, untouched.
struct Asset {
    std::vector<Part> parts;
    std::vector<Material> materials;
    std::vector<Image> images;
    std::shared_ptr<const SourceDocument> source;  ///< null where the format has no scene
    std::vector<std::string> warnings;             ///< what load() repaired or left out
};

/// One part placed in the scene.
struct Instance {
    Index part = no_index;
    std::array<double, 16> transform = {};  ///< column-major, part to world
};

/// Where the parts are, in the order of the scene's nodes. Without a scene graph: every part once, at home.
FAQEM_EXPORT std::vector<Instance> instances(const Asset& asset);

/// Loads .glb, .gltf, .obj, .ply, .stl or .off, chosen by content where it tells and by name where not. Files
/// it refers to must lie in its folder or below.
/// \throws ReadError, InputError, UnsupportedError
FAQEM_EXPORT Asset load(const std::filesystem::path& file);

/// What save() may do to a file that exists.
enum class Overwrite { no, yes };

/// Saves as .glb, .gltf (+ .bin + images), .obj (+ .mtl + images), .ply or .stl, chosen by name.
/// Each file is complete or not there at all: written beside the old one and renamed.
/// \throws WriteError  on any failure, or when the file exists and overwrite is no
/// \throws UnsupportedError  unknown name ending
/// \return what the format could not hold, one sentence each (STL has no colours ...)
FAQEM_EXPORT std::vector<std::string> save(const Asset& asset, const std::filesystem::path& file,
                                           Overwrite overwrite = Overwrite::no);

/// Decodes PNG or JPEG. At most 16384 x 16384 and 1 GiB; checked before anything is allocated.
/// \throws InputError     damaged
/// \throws UnsupportedError  another format (KTX2, WebP ...)
FAQEM_EXPORT Pixels decode(const Image& image);

/// Encodes as PNG; without the alpha channel where has_alpha is false.
FAQEM_EXPORT Image encode_png(const Pixels& pixels, const std::string& name);

/// What an image is for: data and normals must not have their colours thinned out.
enum class Content { color, data };

/// Encodes as JPEG; alpha is left out. \param quality  in [1, 100]
FAQEM_EXPORT Image encode_jpeg(const Pixels& pixels, const std::string& name, std::uint32_t quality,
                               Content content);

}  // namespace faqem

#pragma once
/// \file
/// Textured scenes (assets): loading, saving, and their data structures. Needs only the standard library.

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "faqem/export.hpp"
#include "faqem/mesh.hpp"
#include "faqem/option_types.hpp"

namespace faqem {

/// An encoded image, as stored in a file. decode() returns its pixels.
struct Image {
    std::string name;
    std::string mime_type;  ///< "image/png", "image/jpeg" ...: determined from the bytes, if recognised
    std::vector<std::uint8_t> encoded;  ///< content of the image file
    std::string uri;  ///< path relative to the directory of the asset; empty if the image is embedded
};

/// Decoded pixels: RGBA, 8 bits per channel, top row first. Colours are sRGB encoded, as in the file.
struct Pixels {
    std::uint32_t width = 0, height = 0;
    std::vector<std::uint8_t> rgba;  ///< width * height * 4
    bool has_alpha = false;          ///< false: every alpha value is 255
};

enum class Wrap { repeat, mirror, clamp };
enum class Filter { linear, nearest };

/// Reference from a material to an image, with sampler settings and texture transform.
struct TextureRef {
    Index image = no_index;    ///< index into Asset::images; no_index: no texture
    std::uint32_t uv_set = 0;  ///< index into Part::uvs
    Wrap wrap_u = Wrap::repeat, wrap_v = Wrap::repeat;
    Filter filter = Filter::linear;
    /// KHR_texture_transform: uv' = offset + R(rotation) * (scale * uv), with v pointing down as in glTF.
    Vec2f offset = {0, 0}, scale = {1, 1};
    float rotation = 0;  ///< radians

    explicit operator bool() const { return image != no_index; }
    bool operator==(const TextureRef&) const = default;
};

enum class AlphaMode { opaque, mask, blend };

/// A texture of a material extension that the baker supports (listed in docs/baking.md).
struct ExtensionTexture {
    std::string extension, name;  ///< as in glTF, e.g. KHR_materials_clearcoat and clearcoatNormalTexture
    TextureRef texture;
    float normal_scale = 1;  ///< scale of a normal map; unused for other textures

    bool operator==(const ExtensionTexture&) const = default;
};

/// A glTF 2.0 metallic-roughness material. OBJ's Kd, map_Kd and d are converted to it.
struct Material {
    std::string name;
    Vec4f base_color = {1, 1, 1, 1};  ///< linear factor, multiplied by the texture and the vertex colour
    TextureRef base_color_texture;
    float metallic = 1, roughness = 1;
    TextureRef metallic_roughness_texture;  ///< roughness in G, metallic in B
    TextureRef normal_texture;
    float normal_scale = 1;
    TextureRef occlusion_texture;  ///< occlusion in R
    float occlusion_strength = 1;
    Vec3f emissive = {0, 0, 0};
    TextureRef emissive_texture;
    AlphaMode alpha_mode = AlphaMode::opaque;
    float alpha_cutoff = 0.5f;
    bool double_sided = false;
    bool unlit = false;
    /// Each texture name of an extension at most once. The factors remain in the source document.
    std::vector<ExtensionTexture> extension_textures;
    /// Names of extensions other than KHR_materials_unlit and KHR_texture_transform, sorted.
    std::vector<std::string> extensions;
    /// Material of the source document whose extras and extensions are written too; no_index: none.
    Index source = no_index;
    /// The material has new UVs: textures of the source material that are not listed above do not match them
    /// and are not written.
    bool rebaked = false;

    bool operator==(const Material&) const = default;
};

/// Displacements of one morph target. Each array is empty or has one entry per vertex.
struct MorphTarget {
    std::vector<Vec3f> positions, normals;
};

/// A vertex attribute of an application, such as the numbers of features: in glTF one whose name begins with an
/// underscore.
struct CustomAttribute {
    std::string name;                           ///< with the underscore
    std::vector<std::array<double, 4>> values;  ///< V; components that the attribute does not have are 0
    std::uint32_t components = 1;               ///< 1 to 4
    std::uint32_t component_type = 5126;        ///< how glTF stores them: 5120 to 5123, 5125 or 5126 (float)
    bool normalized = false;  ///< whether integers stand for [0, 1] or [-1, 1], as in `values`
};

/// Order of the faces and vertices of a part in a glTF file. Other formats are written in the given order.
enum class FileOrder {
    given,    ///< that of the arrays; faces are grouped by material
    for_gpu,  ///< faces that share vertices follow each other, and vertices are in the order of their first use
};

/// One mesh of a scene, with all its primitives in one set of arrays. Below, V is the number of vertices and
/// F the number of faces. Vertices that differ in any attribute are separate, as in glTF; simplification
/// welds them by position.
struct Part {
    std::string name;
    std::vector<Vec3> positions;      ///< V
    std::vector<Triangle> triangles;  ///< F, indices < V
    std::vector<Index>
        face_material;  ///< F, indices into Asset::materials; no_index: the default one, in glTF metal
    std::vector<Vec3f> normals;   ///< empty or V; a zero vector if the file has no normal for a vertex
    std::vector<Vec4f> tangents;  ///< empty or V
    std::vector<std::vector<Vec2f>> uvs;  ///< UV sets of V entries each, v pointing down as in glTF
    std::vector<Vec4f> colors;            ///< empty or V, linear RGBA
    std::vector<std::array<std::uint16_t, 4>> joints;  ///< empty or V
    std::vector<Vec4f> weights;                        ///< joint weights, empty or V
    std::vector<MorphTarget> morph_targets;
    /// The objects that a file divides the part into. They are simplified as one mesh, so that edges which they share
    /// stay closed; save() writes a mesh or object for each of them in formats that have these.
    std::vector<Index> face_object;  ///< empty or F, indices into object_names; no_index: the part itself
    std::vector<std::string> object_names;  ///< names of the objects
    /// Empty, or by object: the part of the asset that bake() gives its faces to. simplify() makes such objects of meshes
    /// that share boundary edges.
    std::vector<Index> object_parts;
    /// The groups that a file names (`g` of OBJ), which divide neither meshes nor primitives: OBJ files keep them, glTF
    /// files only the names of each primitive.
    std::vector<Index> face_group;         ///< empty or F, indices into group_names; no_index: none
    std::vector<std::string> group_names;  ///< names of the groups; one may consist of several, as in `g a b`
    /// Mesh of the source document whose name, extras, points and lines are written too; no_index: none.
    Index source = no_index;
    /// bake() copies integers and feature ids (`_BATCHID`, `_FEATURE_ID_n`) from a vertex, and interpolates floats.
    std::vector<CustomAttribute> custom_attributes;
    /// If not 0, save() rounds the positions in glTF files to multiples of this distance, in units of the part, and
    /// stores integers (KHR_mesh_quantization), or floats with Compression::draco. Finite and >= 0.
    double position_spacing = 0;
    /// bake() sets FileOrder::for_gpu for parts that lost faces. Their arrays are in the order of the history.
    FileOrder file_order = FileOrder::given;
};

/// How a file stores coordinates. Their values do not tell: whole metres far from the origin are floats, too.
struct StoredPrecision {
    enum class Type {
        unknown,
        float32,
        float64,
        decimal,  ///< text
    };
    Type type = Type::unknown;
    /// Of `decimal`: the most significant digits of a coordinate, and the most decimals.
    std::uint32_t digits = 0, decimals = 0;
};

/// What an OBJ file without normals says about them by one smoothing group for all faces.
enum class Smoothing { unknown, off, on };

/// Data that a format's reader preserves for its writer (for glTF: scene graph, cameras, animations, extras).
struct SourceDocument;

/// A scene. Its nodes, and everything else that is not a mesh, material or image, are kept unchanged in
/// `source`.
struct Asset {
    std::vector<Part> parts;
    std::vector<Material> materials;
    std::vector<Image> images;
    std::shared_ptr<const SourceDocument> source;  ///< null if the format has no scene graph
    /// The format of the file that load() has read or, of a result, the one that it was made for (Options::format).
    ModelFormat format = ModelFormat::automatic;
    /// Size of the file that load() has read and of the files that it refers to, bytes; 0: there is none.
    std::uint64_t file_bytes = 0;
    /// How the file that load() has read stores positions. Results for other formats than glTF are rounded to it, and save()
    /// stores doubles in PLY files if it is `float64`.
    StoredPrecision precision = {};
    /// Unless `unknown`, Part::normals of a loaded file follow from it. Results that need no normals have it instead.
    Smoothing smoothing = Smoothing::unknown;
    /// Geometry compression of a glTF file: of the file that was read, and of the one that save() writes.
    Compression compression = Compression::none;
    /// 0, or in [8, 16]: glTF files have integers instead of floats for normals and tangents of all parts, but with
    /// Compression::draco floats. Where they are compressed, those of parts that lost faces are rounded to these bits.
    std::uint32_t normal_bits = 0;
    std::uint32_t uv_bits = 0;          ///< the same for texture coordinates
    std::vector<std::string> warnings;  ///< what load() repaired or left out
    /// Statements that load() ignored because they have no meaning for an asset, and extensions that it keeps without
    /// knowing them, one line for each kind. These are no repairs: `faqem info` lists them, `--strict` accepts them.
    std::vector<std::string> not_understood;
};

/// One occurrence of a part in the scene.
struct Instance {
    Index part = no_index;                  ///< index into Asset::parts
    std::array<double, 16> transform = {};  ///< column-major 4 x 4 matrix from part to world space
};

/// Returns all instances, in the order of the scene's nodes. Without a scene graph, every part has one
/// instance with the identity transform.
FAQEM_EXPORT std::vector<Instance> instances(const Asset& asset);

/// Loads a .glb, .gltf, .vrm, .obj, .ply, .stl or .off file. The format is determined by the content if it has a
/// signature, else by the file extension.
/// \param file  a regular file of at most 16 GiB; files it refers to must be in its directory or below
/// \return the scene; Asset::warnings lists repairs and omissions
/// \throws ReadError  the file is missing or cannot be read
/// \throws InputError  the content is damaged or inconsistent
/// \throws UnsupportedError  the format, or a feature that the file requires, is not supported
/// Complexity: O(size of the file and the files it refers to).
FAQEM_EXPORT Asset load(const std::filesystem::path& file);

/// Whether save() may replace an existing file.
enum class Overwrite { no, yes };

/// Saves a scene as .glb, .gltf (+ .bin + images), .vrm, .obj (+ .mtl + images), .ply or .stl, by file extension.
/// All files are replaced, or none: they are written under temporary names and then renamed, while signals are
/// held in the calling thread. If the process is killed meanwhile, load() rejects the files until the next
/// save() to their directory completes or restores them (docs/assets.md, "Writing").
/// \return what the format cannot store (e.g. colours in STL), one sentence each, and if a result was made for another
///     format (Asset::format)
/// \throws WriteError  a file cannot be written, or it exists and `overwrite` is Overwrite::no
/// \throws UnsupportedError  unknown file extension
/// Complexity: O(size of the asset).
FAQEM_EXPORT std::vector<std::string> save(const Asset& asset, const std::filesystem::path& file,
                                           Overwrite overwrite = Overwrite::no);

/// Returns the bytes of the .glb file that save() writes.
/// \param losses  null, or receives what the format cannot store
/// \throws WriteError  the file would be larger than 4 GiB, or a position is beyond the range of float
/// Complexity: O(size of the asset).
FAQEM_EXPORT std::vector<std::uint8_t> to_glb(const Asset& asset, std::vector<std::string>* losses = nullptr);

/// Reads the bytes of a .glb file, or of a .gltf file that refers to no others, as load().
/// \param bytes  read only during the call. A buffer in another file is an error; an image in one is left out
/// \throws InputError, UnsupportedError  as load()
/// Complexity: O(bytes).
FAQEM_EXPORT Asset from_glb(std::span<const std::uint8_t> bytes);

/// Decodes a PNG, JPEG or WebP image or, by OpenImageIO in a plugin, a BMP, TIFF or GIF, or a TGA whose media type is
/// image/x-tga or image/tga; by Basis Universal in another plugin a KTX2 of one picture in ETC1S or UASTC. Of several
/// pictures the first is decoded. The limits, 16384 x 16384 pixels and 1 GiB, are checked before memory is allocated.
/// \throws InputError  the image is damaged or too large
/// \throws UnsupportedError  the image has another format (DDS ...), or KTX2 without its plugin
/// \throws Error  the plugin cannot be loaded
FAQEM_EXPORT Pixels decode(const Image& image);

/// Encodes pixels as PNG, without an alpha channel if Pixels::has_alpha is false.
/// \param name  Image::name of the result
/// \throws InputError  the number of pixels differs from width * height
/// \throws WriteError  encoding failed
FAQEM_EXPORT Image encode_png(const Pixels& pixels, const std::string& name);

/// Content of an image. encode_jpeg() subsamples the chroma of `color` below quality 90, never that of `data`
/// (normals, roughness ...).
enum class Content { color, data };

/// Encodes pixels as JPEG, without alpha.
/// \param name     Image::name of the result
/// \param quality  in [1, 100]
/// \param content  determines chroma subsampling
/// \throws InputError  the number of pixels differs from width * height
/// \throws WriteError  encoding failed
FAQEM_EXPORT Image encode_jpeg(const Pixels& pixels, const std::string& name, std::uint32_t quality,
                               Content content);

/// How encode_webp() compresses: `lossy` subsamples the chroma, `near_lossless` changes single values by a few
/// units and loses colours under an alpha of 0, `lossless` keeps all values.
enum class WebpMode { lossy, near_lossless, lossless };

/// Options of encode_webp().
struct WebpOptions {
    WebpMode mode = WebpMode::lossy;
    /// `lossy`: the quality, in [0, 100]. `near_lossless`: how little is changed, in [0, 100], 100 for nothing.
    /// Without effect for `lossless`.
    int level = 85;
    /// From 0 (fast) to 6 (small).
    int effort = 4;
};

/// Encodes pixels as WebP. Alpha is lossless; it is left out if Pixels::has_alpha is false or all of it is 255.
/// \param name  Image::name of the result
/// \throws InputError   the number of pixels differs from width * height
/// \throws OptionError  an option is out of range
/// \throws WriteError   a side is longer than 16383 pixels, or the format cannot hold as many bytes
FAQEM_EXPORT Image encode_webp(const Pixels& pixels, const std::string& name, const WebpOptions& options);

}  // namespace faqem

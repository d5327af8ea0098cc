#pragma once
/// \file
/// Types of the values of options, for code that does not need Options itself.

#include <array>
#include <cstdint>
#include <optional>

#include "faqem/export.hpp"

FAQEM_NAMESPACE_BEGIN

struct Options;

/// Target face count, see ratio() and faces().
struct Target {
    enum class Kind {
        unset,  ///< determined by Options::max_error; if that is unset too, `value` is a ratio
        ratio,  ///< `value` is a share of the input's faces
        faces,  ///< `value` is a number of faces
    };
    Kind kind = Kind::unset;
    double value = 0.1;
};

/// Target as a share of the input's faces, in (0, 1]. The result has at most max(4, floor(r * faces)) faces.
constexpr Target ratio(double r) { return {Target::Kind::ratio, r}; }

/// Target as a number of faces, >= 1. The result has at most max(4, n) faces.
constexpr Target faces(std::uint64_t n) { return {Target::Kind::faces, static_cast<double>(n)}; }

/// A distance or a size, see model_units() and of_diagonal().
struct Length {
    enum class Unit {
        model,     ///< model units; for an asset, scene units
        diagonal,  ///< diagonal of the bounding box of the original mesh; for an asset, of the scene
    };
    double value = 0;
    Unit unit = Unit::model;
};

/// Maximum two-sided Hausdorff distance between result and original, as measured by hausdorff().
using MaxError = Length;

/// A length in model units, finite and > 0.
constexpr Length model_units(double length) { return {length, Length::Unit::model}; }

/// A length as a share of the bounding-box diagonal, finite and > 0.
constexpr Length of_diagonal(double share) { return {share, Length::Unit::diagonal}; }

/// A named combination of metric, weights and legality rules; details in docs/method.md.
enum class Preset {
    qem,    ///< Garland and Heckbert 1997: accumulated plane quadrics, link condition
    paper,  ///< FA-QEM (arXiv 2605.14029): inverse-area quadrics, boundary, normal and area terms
    stmw,   ///< Liu et al. 2024 (arXiv 2409.15458), as far as published: area-weighted quadrics, area term
    fast,   ///< memoryless area-weighted quadrics (Lindstrom and Turk 1998), boundary planes; ignores Weights
    balanced,  ///< as `fast`; the increase of the tracked distance to the original adds to the cost
    best,      ///< as `balanced`; then vertices are fitted to the original and edges flipped
};

/// All presets, in the order of the enumeration.
inline constexpr std::array<Preset, 6> all_presets = {Preset::qem,  Preset::paper,    Preset::stmw,
                                                      Preset::fast, Preset::balanced, Preset::best};

/// Weights of the cost terms, finite and >= 0. Unset weights are those of the preset. Equation numbers, and
/// the values of Preset::paper, are those of FA-QEM (arXiv 2605.14029).
struct Weights {
    std::optional<double> area = {};      ///< boundary area term of Lindstrom and Turk (eq. 11); paper: 100
    std::optional<double> boundary = {};  ///< curvature-scaled boundary planes (eq. 6-9); paper: 500
    std::optional<double> normal = {};    ///< tangent plane at the vertex (eq. 10); paper: 0.01
    std::optional<double> uv = {};        ///< factor on quadrics at preserved UV seams; paper: 5000
    /// Inverse-area weight of planes (eq. 5), 0: unweighted; paper: 1.
    std::optional<double> plane_area = {};
};

/// When the link condition (Dey et al. 1999), which preserves the topology of a manifold surface, is
/// enforced.
enum class LinkCondition {
    as_preset,
    off,
    /// Enforced on manifold neighbourhoods, but lifted for a pair when other collapses cost more than a
    /// violation at a pair of its length could: handles smaller than the error are removed. Only for
    /// memoryless presets (fast, balanced, best); otherwise as `on`.
    by_size,
    on,      ///< enforced on manifold neighbourhoods, lifted only if the target cannot be reached otherwise
    strict,  ///< always enforced; pairs with a non-manifold vertex are not collapsed
};

/// Whether vertices with equal or close positions are merged before simplification.
enum class Weld { by_position, none };

/// Whether boundary vertices may move.
enum class Boundary { free, locked };

/// How boundaries between faces of different groups (for an asset: materials) are treated.
enum class GroupBoundaries {
    free,       ///< without effect; for an asset, as `preferred`
    preferred,  ///< preserved as by `preserved` while the target can be reached, and then only part of the costs
    preserved,  ///< preserved as surface boundaries are, never torn or merged, even if the target is missed
};

/// Whether nearby boundary vertices of different components may be collapsed (FA-QEM, supplementary
/// material).
enum class VirtualEdges { off, on };

/// How the target of a scene is distributed to its meshes; assets only.
enum class Budget {
    scene,  ///< by error: meshes whose simplification causes larger errors keep more faces
    mesh,   ///< in proportion to the face count of each mesh
};

/// Whether errors on hidden surface count less; assets only. See docs/method.md.
enum class Visibility {
    automatic,  ///< in textured scenes surface deep inside counts a tenth, see docs/method.md
    ignored,
    weighted,  ///< costs are weighted by the visibility of the surface from outside the scene, at least 1/50
};

/// Whether optional data, such as the collapse history, is recorded.
enum class Recording { off, on };

/// How the colours of the simplified model are stored.
enum class Bake {
    automatic,     ///< `keep`, `atlas` or `per_triangle`: chosen by mesh and page, see docs/baking.md
    atlas,         ///< a new texture atlas of UV charts with adjacent triangles
    per_triangle,  ///< a new texture atlas with separate triangles (FA-QEM, Sec. 3.2.3)
    vertex,        ///< vertex colours
    keep,          ///< the UVs and images of the source, preserved by the collapses
    none,          ///< geometry and material factors only; textures are dropped
};

/// Tests whether a kind of baking makes a new texture atlas.
constexpr bool makes_atlas(Bake kind) {
    return kind == Bake::automatic || kind == Bake::atlas || kind == Bake::per_triangle;
}

/// Formats of the model files that save() writes. What a result cannot be stored with is not made for it: an atlas for PLY,
/// colours for STL. See docs/assets.md, "Results for a format".
enum class ModelFormat {
    automatic,  ///< that of the file from which the source was loaded; `glb` if there is none or it is only read
    glb,
    gltf,
    obj,
    ply,
    stl,
};

/// Whether the files of a textured result may be larger than those of its source; see docs/assets.md, "Size of results".
enum class LargerFiles {
    avoided,  ///< new images give something up until they are not
    allowed,
};

/// Vertex normals of the result.
enum class Normals {
    /// In OBJ and PLY as `transfer` if the source has normals, where vertices are only split if those of the source are,
    /// and else only beside a normal map; in glTF `transfer`; for STL, which has none, `flat` or `none`.
    automatic,
    transfer,  ///< normals of the original at the mapped points, fitted to it over the faces
    smooth,    ///< normals of the result's faces, averaged up to BakeOptions::crease_angle
    flat,      ///< normals of the result's faces, not averaged
    none,  ///< no normals, so that faces are shown flat, and no new normal map; not with an atlas that is asked for
};

/// What bake() does with untouched parts: those of which the simplification changed nothing, except that it
/// dropped duplicate faces and faces without area.
enum class UntouchedParts {
    /// They are kept unless another bake option that would change them differs from its default: for
    /// Bake::automatic texture_size, texel_density, normal_map, image_format (ImageFormat::source changes
    /// nothing), image_quality, correspondence, normals, crease_angle; for Bake::keep the last two. For other
    /// kinds, and in levels with a shared texture, they are baked.
    automatic,
    kept,   ///< they have the arrays, materials and image bytes of the source, whatever the other options
    baked,  ///< they are baked like the other parts
};

/// Encoding of baked images. Images with alpha are PNG or WebP.
enum class ImageFormat {
    /// The smallest that is within BakeOptions::image_quality, possibly with fewer texels: PNG or JPEG, and WebP if
    /// the source has WebP images.
    automatic,
    png,
    jpeg,         ///< with BakeOptions::jpeg_quality
    source,       ///< JPEG if all images that a channel is baked from are JPEG, else PNG
    webp,         ///< as `automatic`, but WebP for colours, and for other data where it is smaller
    png_or_jpeg,  ///< as `automatic`, but never WebP
};

/// Tests whether BakeOptions::image_quality determines the encoding.
constexpr bool has_image_quality(ImageFormat format) {
    return format == ImageFormat::automatic || format == ImageFormat::webp ||
           format == ImageFormat::png_or_jpeg;
}

/// Compression of the geometry in glTF files.
enum class Compression {
    source,  ///< that of the source: `meshopt`, `draco` or `none`
    none,
    /// EXT_meshopt_compression, which viewers must know. Normals and tangents are rounded to multiples of 2^-11, UVs
    /// to 2^-15; positions and all else are exact.
    meshopt,
    /// KHR_draco_mesh_compression, which viewers must know. Vertices are rounded as by Quantize::on, unless
    /// Quantize::off is set.
    draco,
};

/// Whether vertices in glTF files are integers, which viewers must know (KHR_mesh_quantization).
enum class Quantize {
    source,  ///< meshes that have integer positions in the source keep their grid
    off,     ///< floats
    on,      ///< all meshes, with the bits of QuantizeOptions
};

/// Whether a new atlas has a normal map. Bake::keep preserves those of the source, the other kinds have none.
enum class NormalMap {
    /// If the source has one, or if it has other textures and normals differ by more than 3.5 degrees on average
    /// by area.
    automatic,
    on,  ///< for every lit material; made from the geometry if the source has no normal map
    off,
};

FAQEM_NAMESPACE_END

#pragma once
/// \file
/// One options struct for every door. All members have defaults; use designated initialisers.

#include <array>
#include <cstdint>
#include <optional>

#include "faqem/export.hpp"
#include "faqem/progress.hpp"

FAQEM_NAMESPACE_BEGIN

/// How many faces are wanted. See ratio() and faces().
struct Target {
    enum class Kind {
        unset,  ///< as few as Options::max_error allows; without that, `value` as a ratio
        ratio,
        faces,
    };
    Kind kind = Kind::unset;
    double value = 0.1;
};

/// A share of the input's faces, in (0, 1]. The result has at most max(4, floor(r * faces)) faces.
constexpr Target ratio(double r) { return {Target::Kind::ratio, r}; }

/// A number of faces, >= 1. The result has at most max(4, n) faces.
constexpr Target faces(std::uint64_t n) { return {Target::Kind::faces, static_cast<double>(n)}; }

/// A distance or a size. See model_units() and of_diagonal().
struct Length {
    enum class Unit {
        model,     ///< of an asset, the scene's
        diagonal,  ///< of the original's bounding box; of an asset, the whole scene's
    };
    double value = 0;
    Unit unit = Unit::model;
};

/// How far result and original may be from each other: no point of either is farther from the other, as
/// hausdorff() measures it.
using MaxError = Length;

/// A length in model units, finite and > 0.
constexpr Length model_units(double length) { return {length, Length::Unit::model}; }

/// A length as a share of the bounding box's diagonal, finite and > 0: 0.001 is a thousandth of it.
constexpr Length of_diagonal(double share) { return {share, Length::Unit::diagonal}; }

/// A named choice of metric, weights and rules.
enum class Preset {
    qem,       ///< Garland and Heckbert 1997: plane quadrics, link condition
    paper,     ///< FA-QEM as written: inverse-area base, curvature boundary, normal and area terms
    stmw,      ///< Liu et al. 2024 as far as it is public: area-weighted quadrics, boundary-edge area term
    fast,      ///< area-weighted planes without memory, planes that hold open edges; the weights do not apply
    balanced,  ///< as fast, and what a collapse adds to the largest distance from the original counts too
    best,      ///< as balanced, and in the end vertices are moved closer to the original
};

/// Every preset, in the order of the tables.
inline constexpr std::array<Preset, 6> all_presets = {Preset::qem,  Preset::paper,    Preset::stmw,
                                                      Preset::fast, Preset::balanced, Preset::best};

/// Weights of the terms; what is not set comes from the preset. All must be finite and >= 0.
struct Weights {
    std::optional<double> area = {};      ///< Lindstrom-Turk boundary area cost (paper eq. 11); paper: 100
    std::optional<double> boundary = {};  ///< curvature-scaled boundary planes (paper eq. 6-9); paper: 500
    std::optional<double> normal = {};    ///< tangent plane at the vertex (paper eq. 10); paper: 0.01
    std::optional<double> uv = {};        ///< factor on quadrics at UV seams, where UVs are kept; paper: 5000
    /// Inverse-area base weight (paper eq. 5), 0: unweighted; paper: 1.
    std::optional<double> plane_area = {};
};

/// The link condition keeps the topology of a manifold surface (Dey et al. 1999).
enum class LinkCondition {
    as_preset,
    off,
    /// Kept where the surface is manifold, until collapses elsewhere cost more than what it protects could: a
    /// handle that is smaller than the error goes. Presets without memory only; elsewhere as `on`.
    by_size,
    on,      ///< kept where the surface is manifold, until nothing else is left to reach the target
    strict,  ///< kept always; pairs at non-manifold vertices are not collapsed
};

/// Whether vertices at one place are one vertex.
enum class Weld { by_position, none };

/// Whether vertices on open borders may move.
enum class Boundary { free, locked };

/// Whether the curves between faces of different groups (of an asset: materials) may move.
enum class GroupBoundaries {
    free,
    kept,  ///< held in place as open borders are, and never torn or joined, even if the target is missed
};

/// Collapses between open borders of parts that do not touch (paper, supplementary).
enum class VirtualEdges { off, on };

/// What may happen to the connectivity.
struct Topology {
    LinkCondition link = LinkCondition::as_preset;
    Boundary boundary = Boundary::free;
    GroupBoundaries group_boundaries = GroupBoundaries::free;
    /// Files split vertices at UV and normal seams: without welding, every seam would be an open border.
    Weld weld = Weld::by_position;
    /// Vertices at most this far apart (model units) become one. Unset: the preset's (paper 1e-6, else
    /// exact).
    std::optional<double> weld_distance = {};
    VirtualEdges virtual_edges = VirtualEdges::off;
    /// Largest gap a virtual edge may span, as a share of the bounding-box diagonal, in (0, 1].
    double virtual_edge_distance = 0.01;
    /// Connected components whose bounding box has a smaller diagonal are deleted before anything else; of an
    /// asset, those smaller in all places of the scene. The largest of each mesh stays, and so do those with
    /// locked vertices. max_error does not count what they were.
    std::optional<Length> prune = {};
};

/// How the target of a scene is spread over its meshes; used by the asset door only.
enum class Budget {
    scene,  ///< by error: where faces show more, more are kept
    mesh,   ///< in proportion to each mesh's faces
};

/// Whether what is hidden from outside counts less; used by the asset door only. See docs/method.md.
enum class Visibility {
    ignored,
    weighted,  ///< errors count by how much of the surface around them can be seen from outside the scene
};

/// Whether the collapse history is kept. Off costs nothing.
enum class Recording { off, on };

/// Where the colours of the small model go.
enum class Bake {
    automatic,     ///< `atlas` or `per_triangle`, page by page: see docs/baking.md
    atlas,         ///< a new atlas of charts: neighbouring triangles lie together
    per_triangle,  ///< a new atlas, every triangle on its own (paper, Sec. 3.2.3)
    vertex,        ///< vertex colours
    keep,          ///< the source's UVs and images, carried through the collapses
    none,          ///< geometry only: factors stay, textures go
};

/// Does it lay the small mesh out on new images?
constexpr bool makes_atlas(Bake kind) {
    return kind == Bake::automatic || kind == Bake::atlas || kind == Bake::per_triangle;
}

/// How a point of the small surface finds its place on the original.
enum class Mapping {
    projection,  ///< successive projection through the collapse history (after Liu et al. 2024)
    lineage,     ///< the paper's heuristic: the closer of the two parents, again and again
    closest,     ///< the closest point of the original, whatever side or sheet it is on: for comparison
};

/// Vertex normals of the result.
enum class Normals {
    transfer,  ///< the original's, through the map
    smooth,    ///< those of the result's own faces, averaged up to the crease angle
    flat,      ///< those of the result's own faces, one by one
    none,      ///< left out, with Bake::none only: for what reads nothing but geometry
};

/// How baked images are encoded. Images with alpha are PNG in any case.
enum class ImageFormat {
    png,
    jpeg,    ///< with BakeOptions::jpeg_quality
    source,  ///< JPEG where all the images that a channel is baked from are JPEG, else PNG
};

/// Whether a new atlas has a normal map. With Bake::keep the source's maps stay; elsewhere there is none.
enum class NormalMap {
    automatic,  ///< where the source has one, or where its normals differ by more than 5 degrees on average
    on,         ///< for every lit material: without a map of the source, made from its geometry
    off,
};

/// Appearance of the result; used by the asset door only.
struct BakeOptions {
    Bake kind = Bake::automatic;
    /// Largest side of a baked image in texels, a power of two in [64, 16384].
    std::uint32_t texture_size = 2048;
    /// Texels per length of the surface, times those of the source, in [0.125, 8]; texture_size is the limit.
    /// Unset: 1, and up to 1.41 on small pages, where more texels cost little and less is lost to sampling anew.
    std::optional<double> texel_density = {};
    NormalMap normal_map = NormalMap::automatic;
    Mapping mapping = Mapping::projection;
    /// Samples per texel and axis, in [1, 8]: 2 means 2 x 2.
    std::uint32_t samples = 2;
    Normals normals = Normals::transfer;
    /// Angle in degrees between normals above which a vertex is split, in [0, 180]. Not used by
    /// Normals::flat.
    double crease_angle = 40;
    ImageFormat image_format = ImageFormat::png;
    std::uint32_t jpeg_quality = 90;  ///< in [1, 100]
    /// Whether SimplifiedAsset::correspondence is filled.
    Recording correspondence = Recording::off;
};

/// Everything that can be asked of simplify().
struct Options {
    Target target = {};
    Budget budget = Budget::scene;
    Visibility visibility = Visibility::ignored;
    /// Without a target: the result is the smallest mesh found within this distance. With one: the target is
    /// run, and Report::max_error tells whether it is within. What counts is the proven bound, not the value.
    std::optional<MaxError> max_error = {};
    Preset preset = Preset::balanced;
    Weights weights = {};
    Topology topology = {};
    Recording history = Recording::off;
    BakeOptions bake = {};
    /// Threads to use at most; 0: all there are. The result does not depend on it.
    std::uint32_t threads = 0;
    /// Called now and then; may cancel. May be empty.
    Progress progress = {};
};

/// Checks every range stated above.
/// \throws OptionError naming the member
FAQEM_EXPORT void validate(const Options& options);

FAQEM_NAMESPACE_END

#ifdef FAQEM_HEADER_ONLY
#include "faqem/detail/simplify/options-inl.hpp"
#endif

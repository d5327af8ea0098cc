#pragma once
/// \file
/// Options of all entry points. All members have defaults; use designated initialisers.

#include <cstdint>
#include <optional>

#include "faqem/export.hpp"
#include "faqem/option_types.hpp"
#include "faqem/progress.hpp"

FAQEM_NAMESPACE_BEGIN

/// Options for the connectivity of the mesh.
struct Topology {
    LinkCondition link = LinkCondition::as_preset;
    Boundary boundary = Boundary::free;
    GroupBoundaries group_boundaries = GroupBoundaries::free;
    /// Files duplicate vertices at UV and normal seams: without welding, every seam would be a boundary.
    Weld weld = Weld::by_position;
    /// Maximum distance between welded vertices, model units, finite and >= 0. Unset: 1e-6 for `paper`, 0 for all
    /// others, and for assets also those that differ by the rounding of their file (docs/assets.md, "Rounding").
    std::optional<double> weld_distance = {};
    VirtualEdges virtual_edges = VirtualEdges::off;
    /// Maximum length of a virtual edge, as a share of the bounding-box diagonal, in (0, 1].
    double virtual_edge_distance = 0.01;
    /// Connected components whose bounding box has a smaller diagonal are deleted first; for an asset, at the
    /// largest scale of their instances. Finite and > 0. The largest component of each mesh, and components
    /// with a locked vertex, are kept. max_error is measured from the mesh without the deleted components.
    std::optional<Length> prune = {};
};

/// Appearance of the result; assets only. See docs/baking.md.
struct BakeOptions {
    Bake kind = Bake::automatic;
    /// Maximum side of a baked image in texels, a power of two in [64, 16384].
    std::uint32_t texture_size = 2048;
    /// Texels per length of a new texture, relative to the source, in [0.125, 8]; texture_size is the limit.
    /// Unset: 1, rising to 1.41 on small pages, which lose most by resampling.
    std::optional<double> texel_density = {};
    NormalMap normal_map = NormalMap::automatic;
    /// Samples per texel along each axis, in [1, 8]: 2 means 2 x 2.
    std::uint32_t samples = 2;
    Normals normals = Normals::automatic;
    /// Angle between normals, in degrees, above which a vertex is split, in [0, 180]. Ignored by
    /// Normals::flat.
    double crease_angle = 40;
    ImageFormat image_format = ImageFormat::automatic;
    /// Least PSNR of colours in a baked image of a format with has_image_quality(), in dB, in [20, 80]; of other data 4 dB
    /// less, down to 30, of normals between, by roughness. 40 allows errors of 1% of the range of values, or 2 degrees
    /// of a normal. Measured against the image before it is encoded. Unset: 40. If Bake::automatic has compared pictures
    /// of the model, a value in [38, 44], so that the error of images is small beside that of the geometry where both are
    /// seen.
    std::optional<double> image_quality = {};
    std::uint32_t jpeg_quality = 90;  ///< in [1, 100]
    UntouchedParts untouched = UntouchedParts::automatic;
    /// Whether to record SimplifiedAsset::correspondence; needs a new atlas.
    Recording correspondence = Recording::off;
};

/// Rounding of vertices in glTF files, see docs/assets.md, "Quantisation".
struct QuantizeOptions {
    Quantize kind = Quantize::source;
    /// Positions are rounded to a grid that all meshes of a scene, and all levels of detail, have in common. Its
    /// spacing is the diagonal of the scene divided by 2 to this power, rounded up to a power of two. In [8, 16].
    /// Unset: 14, or what Options::max_bytes chooses.
    std::optional<std::uint32_t> position_bits = {};
    std::uint32_t normal_bits =
        10;  ///< of the two octahedral coordinates of compressed normals and tangents; [8, 16]
    std::uint32_t uv_bits = 13;  ///< of compressed texture coordinates from 0 to 1, in [8, 16]
};

/// Options of simplify() and of all other entry points.
struct Options {
    Target target = {};
    Budget budget = Budget::scene;
    Visibility visibility = Visibility::automatic;
    /// Without a target, the result is the smallest mesh found within this distance of the original. With a
    /// target, one run is made and measured. In both cases the upper bound of the distance decides, see
    /// Report::max_error.
    std::optional<MaxError> max_error = {};
    /// Time for simplification and baking in seconds of wall-clock time, finite and > 0; unset: unlimited. When it
    /// is over, the collapses stop (StopReason::reached_time_limit), and a bake that is not finished keeps the
    /// images of the source instead; see docs/reference.md, "Time limit". The result then depends on the machine. Must be
    /// unset for levels of detail.
    std::optional<double> max_seconds = {};
    Preset preset = Preset::balanced;
    Weights weights = {};
    Topology topology = {};
    Recording history = Recording::off;           ///< whether to record the collapse history; free if off
    ModelFormat format = ModelFormat::automatic;  ///< that the result of an asset will be saved in
    LargerFiles larger = LargerFiles::avoided;    ///< for assets that were loaded from files
    /// Maximum total size of the files of an asset result, bytes. Without a target, faces and images are chosen for the
    /// best picture, otherwise images are reduced, and then faces; see docs/assets.md, "Size of results". max_error must
    /// be unset.
    std::optional<std::uint64_t> max_bytes = {};
    BakeOptions bake = {};
    Compression compress = Compression::source;  ///< of the glTF file that the result is saved to
    QuantizeOptions quantize = {};               ///< of the glTF file that the result is saved to
    /// Maximum number of threads; 0: all. The result does not depend on it.
    std::uint32_t threads = 0;
    /// Called at intervals, may cancel the run. May be empty.
    Progress progress = {};
};

/// Checks the ranges and combinations stated above.
/// \throws OptionError  names the option
FAQEM_EXPORT void validate(const Options& options);

FAQEM_NAMESPACE_END

#ifdef FAQEM_HEADER_ONLY
#include "faqem/detail/options/option_table-inl.hpp"
#endif

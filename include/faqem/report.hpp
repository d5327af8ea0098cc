#pragma once
/// \file
/// Reports of runs: counts, stop reason, warnings and times. Everything that is dropped is reported.

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "faqem/export.hpp"
#include "faqem/mesh.hpp"
#include "faqem/option_types.hpp"

FAQEM_NAMESPACE_BEGIN

/// Why the collapse loop ended.
enum class StopReason {
    reached_target,      ///< the face count is at most the target
    no_legal_collapse,   ///< all rungs of the starvation ladder were tried, and no collapse is legal
    reached_max_error,   ///< no smaller mesh within Options::max_error was found
    cancelled,           ///< the progress callback returned Continue::cancel
    reached_time_limit,  ///< Options::max_seconds was over before the target was reached
};

/// Why a collapse was rejected.
enum class Refusal {
    flip,         ///< a face would flip
    degenerate,   ///< a face would have zero area
    link,         ///< the link condition would be violated
    fold,         ///< the faces at an edge would face away from each other
    locked,       ///< both vertices are locked, or a locked one would move
    seam,         ///< a preserved UV seam would be torn
    group,        ///< a preserved boundary between groups would be damaged
    zero_length,  ///< the pair is shorter than 1e-8 of the diagonal and of the edges around it
    last_faces,   ///< no face, or none with a non-zero area, would be left
};
inline constexpr std::size_t refusal_kinds = 9;

/// Rungs of the starvation ladder: what is relaxed, in this order, if no collapse is legal above the target.
/// With LinkCondition::by_size the link condition and the rule against folds are lifted for single pairs;
/// `without_link` and `fold` then count the collapses that violate them.
enum class Rung {
    reseed,           ///< all pairs are re-evaluated
    duplicate_faces,  ///< faces with the corners and winding of another face are deleted
    tiny_components,  ///< connected components below 2% of the diagonal and of the area are deleted, smallest first
    group_boundaries,  ///< GroupBoundaries::preferred only adds to the costs
    without_link,      ///< the link condition is lifted
    fold,              ///< folds are allowed
    flip_zero,         ///< the cosine between old and new face normal may be as low as 0
    flip_half,         ///< the cosine between old and new face normal may be as low as -0.5
    flip_any,          ///< faces may flip
    any_component,     ///< connected components are deleted, smallest first, never the largest
};
inline constexpr std::size_t rung_kinds = 10;

/// Wall-clock seconds of the phases. `simplify` is the whole run from input to output arrays, including
/// `weld`.
struct PhaseSeconds {
    double load = 0, weld = 0, simplify = 0, map = 0, bake = 0, save = 0, total = 0;
};

/// Measured two-sided Hausdorff distance between result and original, for Options::max_error. Distances are
/// in model units; for an asset, in scene units. Rounding of positions is included, except to float in glTF files and of
/// scenes whose instances have transforms.
struct MeasuredError {
    double allowed = 0;      ///< Options::max_error
    double value = 0;        ///< lower bound of the distance
    double bound = 0;        ///< upper bound of the distance; infinity if nothing is left of a mesh
    std::uint64_t runs = 0;  ///< number of runs from the original

    bool within() const { return bound <= allowed; }
};

/// Rounding of positions to a grid, for Options::quantize.
struct PositionRounding {
    double spacing = 0;    ///< of the grid, in scene units; of several grids, the largest
    double max_error = 0;  ///< largest distance by which a vertex of the result moves, scene units
};

/// A connected component of the input that has no face in the result, or became much smaller, although it was visible.
struct RemovedComponent {
    /// Components with at most this share of the area are not listed.
    static constexpr double min_share = 0.005;

    std::string part;                 ///< of an asset: name of its part, as in warnings; empty for a mesh
    std::uint64_t faces = 0;          ///< in the input, over all instances
    double area_share = 0;            ///< share of the area of the input, in [0, 1]
    Vec3 box_min = {}, box_max = {};  ///< axis-aligned bounding box, model units; for an asset, scene units
};

/// One page of a new atlas: the images of one material of the result.
struct BakedPage {
    std::string material;                 ///< name of the material; may be empty
    Bake kind = Bake::atlas;              ///< `atlas` or `per_triangle`
    std::uint32_t width = 0, height = 0;  ///< texels
    std::uint64_t faces = 0;              ///< triangles on the page
    std::uint64_t charts = 0;             ///< number of charts, or of cells for `per_triangle`
    /// Triangles that became charts of their own because the work limit of their region was reached.
    std::uint64_t faces_outside_charts = 0;
    double fill = 0;     ///< share of the texels that show a triangle, gutters included
    double density = 0;  ///< texels per length relative to the source, as root mean squares over the surface
    double stretch = 1;  ///< area-weighted mean; 1: none
    std::array<std::uint64_t, 3> samples = {};  ///< number of samples by MapStep
    std::uint64_t uncertain_texels = 0;         ///< texels with a sample not found by MapStep::history
};

/// An image of the result.
struct ResultImage {
    std::string name;                     ///< may be empty
    std::string mime_type;                ///< for example image/jpeg; empty if the format is unknown
    std::uint32_t width = 0, height = 0;  ///< texels; 0 if the header cannot be read
    std::uint64_t bytes = 0;              ///< encoded
    bool is_of_source = false;            ///< an image of the source has the same bytes
};

/// A buffer view of the result.
struct ResultView {
    /// What it stores, for example "POSITION" or "indices"; several are separated by commas.
    std::string content;
    std::uint64_t bytes = 0;  ///< as stored, possibly compressed
};

/// What of a target bake_onto() could not show, and how far it is from its source.
struct TargetCoverage {
    /// Share of the texels with a triangle that have no point of the source; they have the colours of those around.
    double missing_texels = 0;
    double largest_distance = 0;               ///< between a texel and its point of the source, scene units
    std::vector<std::string> unmatched_parts;  ///< parts of the target without any point of the source
};

/// A result that was made and compared with others for Options::max_bytes.
struct ComparedResult {
    Bake kind = Bake::keep;  ///< `keep`: with the UVs of the source
    std::uint64_t faces = 0;
    std::uint64_t bytes = 0;       ///< of all files
    std::uint32_t image_side = 0;  ///< longest side of the images, texels; 0: none was encoded again
    std::optional<std::uint32_t> position_bits;  ///< QuantizeOptions::position_bits; empty: not chosen
    double psnr = 0;                             ///< of rendered pictures, dB
};

/// What holds the bytes of a result that has more than `max_share` of those of its source.
struct LittleSaved {
    static constexpr double max_share = 0.8;

    /// Sizes in all files of the result: vertices and faces; images; animations of glTF; its JSON and other data.
    std::uint64_t geometry = 0, images = 0, animation = 0, other = 0;
    std::string reason;                ///< why the largest of these have so many bytes, for people
    std::vector<std::string> options;  ///< names of options that make them fewer, as in faqem_options_set()
};

/// Summary of one run. Counts are sums if several meshes were simplified.
struct Report {
    Preset preset = Preset::balanced;
    std::uint64_t faces_in = 0, faces_out = 0;
    /// Input vertices before welding; output vertices before they are split at UV and normal seams.
    std::uint64_t vertices_in = 0, vertices_out = 0;
    /// Of an asset: vertices that the seams add to those; 0 if every vertex has one set of values.
    std::uint64_t vertices_split = 0;
    std::uint64_t target_faces = 0;  ///< equal to faces_out after a search by Options::max_error
    StopReason stop = StopReason::reached_target;
    std::uint64_t collapses = 0;
    std::array<std::uint64_t, refusal_kinds> refusals = {};  ///< number of rejected pairs, by Refusal
    std::array<std::uint64_t, rung_kinds> rungs = {};        ///< how often each rung was taken, by Rung
    /// Faces with two equal corners after welding, duplicates, and faces of zero area in the result.
    std::uint64_t faces_dropped = 0;
    std::uint64_t components_collapsed = 0;  ///< connected components whose last faces were collapsed
    std::uint64_t components_deleted = 0;    ///< connected components deleted by the ladder
    std::uint64_t components_pruned = 0;     ///< connected components deleted by Topology::prune
    std::uint64_t faces_pruned = 0;          ///< faces of the pruned components
    std::uint64_t vertices_hidden = 0;       ///< input vertices whose costs are lower because they are hidden
    std::uint64_t vertices_fitted = 0;       ///< vertices moved by the final fitting, or to separate layers
    std::uint64_t edges_flipped = 0;         ///< edges flipped by the final fitting of Preset::best
    std::uint64_t virtual_edges = 0;         ///< virtual edges added
    std::vector<RemovedComponent> removed_components;  ///< visible ones, the largest first
    /// Visible ones that became shorter by more than a fifth of their longest side, the largest first.
    std::vector<RemovedComponent> shrunk_components;
    std::optional<MeasuredError> max_error = {};  ///< if Options::max_error is set and the run was completed
    std::optional<PositionRounding> position_rounding = {};  ///< of an asset, if its positions are rounded
    std::vector<BakedPage> pages;  ///< pages of a new atlas; only of materials with images
    /// Of an asset: names of the parts that bake() left as they are (BakeOptions::untouched), as in warnings.
    std::vector<std::string> untouched_parts;
    /// Of an asset: names of the parts for which bake() with Bake::automatic kept the UVs of the source.
    std::vector<std::string> kept_uvs;
    std::optional<TargetCoverage> coverage = {};  ///< set by bake_onto()
    std::vector<std::string> warnings;
    std::vector<ResultImage> images;  ///< of the result, in the order of Asset::images
    /// Buffer views of a glTF file without those of images. Set by simplify() of a file.
    std::vector<ResultView> buffer_views;
    /// What was given up so that the result has no more bytes than the input, also in a warning.
    std::vector<std::string> given_up;
    /// For Options::max_bytes without a face target: the results that were compared, in the order in which they were made.
    std::vector<ComparedResult> compared_results;
    /// Total size of the files of the model before and after, without those of history and correspondence; 0: unknown.
    /// `bytes_out` is set by simplify() of a file.
    std::uint64_t bytes_in = 0, bytes_out = 0;
    std::optional<LittleSaved> little_saved = {};  ///< set by simplify() of a file
    PhaseSeconds seconds;
};

/// Returns the name of an enumerator, as used in reports: equal to its C++ identifier.
FAQEM_EXPORT std::string_view name(Preset preset);
FAQEM_EXPORT std::string_view name(StopReason reason);
FAQEM_EXPORT std::string_view name(Refusal refusal);
FAQEM_EXPORT std::string_view name(Rung rung);

/// Returns the preset with the given name().
/// \throws OptionError  unknown name; the message lists all names
FAQEM_EXPORT Preset preset_named(std::string_view text);

FAQEM_NAMESPACE_END

#ifdef FAQEM_HEADER_ONLY
#include "faqem/detail/simplify/report-inl.hpp"
#endif

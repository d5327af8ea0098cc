#pragma once
/// \file
/// What happened: counts, reasons, times. Nothing is dropped in silence; it is in here.

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "faqem/export.hpp"
#include "faqem/options.hpp"

FAQEM_NAMESPACE_BEGIN

/// Why the collapses ended.
enum class StopReason {
    reached_target,     ///< the face count is at or below the target
    no_legal_collapse,  ///< every rung of the ladder was tried and nothing may be collapsed any more
    reached_max_error,  ///< the smallest mesh that was found within Options::max_error
    cancelled,          ///< the progress callback said so
};

/// Why a collapse was refused.
enum class Refusal {
    flip,         ///< a face would turn over
    degenerate,   ///< a face would lose its area
    link,         ///< the link condition would be violated
    fold,         ///< the surface would fold: two faces at an edge would look away from each other
    locked,       ///< both ends are locked, or the new point would move a locked one
    seam,         ///< a kept UV seam would be torn
    group,        ///< a kept border between groups would be damaged
    zero_length,  ///< the pair is shorter than 1e-8 of the diagonal
    last_faces,   ///< nothing at all would be left, or nothing with an area
};
inline constexpr std::size_t refusal_kinds = 9;

/// Steps taken when no collapse was legal above the target, in this order. With LinkCondition::by_size the
/// link condition is lifted pair by pair, and so is the rule against folds; each collapse against one counts.
enum class Rung {
    reseed,           ///< all pairs evaluated anew
    duplicate_faces,  ///< faces deleted that lie on others, with the same corners and winding
    tiny_components,  ///< whole tiny components deleted
    without_link,     ///< link condition lifted
    fold,             ///< folds allowed
    flip_zero,        ///< flips allowed down to dot = 0, where the preset asks for more
    flip_half,        ///< flips allowed down to dot = -0.5
    flip_any,         ///< flips allowed
    any_component,    ///< whole components deleted, smallest first
};
inline constexpr std::size_t rung_kinds = 9;

/// Wall-clock seconds of the phases. `simplify` runs from flat arrays to flat arrays and includes `weld`.
struct PhaseSeconds {
    double load = 0, weld = 0, simplify = 0, map = 0, bake = 0, save = 0, total = 0;
};

/// What the result's distance from the original was measured to be, for Options::max_error. In model units;
/// of an asset in those of the scene. Positions are as in the result, before a file or a mesh rounds them.
struct MeasuredError {
    double allowed = 0;      ///< max_error
    double value = 0;        ///< of a point that was found
    double bound = 0;        ///< no point is farther; infinity where nothing is left of a part
    std::uint64_t runs = 0;  ///< made from the original, with several targets

    bool within() const { return bound <= allowed; }
};

/// One page of a new atlas: the images of one material of the result.
struct BakedPage {
    std::string material;                 ///< its name; may be empty
    Bake kind = Bake::atlas;              ///< or `per_triangle`
    std::uint32_t width = 0, height = 0;  ///< texels
    std::uint64_t faces = 0;
    std::uint64_t charts = 0;  ///< pieces: charts; of `per_triangle`, cells
    std::uint64_t faces_outside_charts =
        0;               ///< that could not be laid into a chart within the bound on the work
    double fill = 0;     ///< share of the page's texels that show a triangle, margins included
    double density = 0;  ///< texels per length over the source's; both root mean squares over the surface
    double stretch = 1;  ///< mean over the area; 1: none
    /// By MapStep: how many samples found their place on the original how.
    std::array<std::uint64_t, 3> samples = {};
    std::uint64_t uncertain_texels = 0;  ///< with a sample that was found other than by MapStep::history
};

/// The result's passport. Counts are sums where several meshes were simplified.
struct Report {
    Preset preset = Preset::balanced;
    std::uint64_t faces_in = 0, faces_out = 0;
    std::uint64_t vertices_in = 0, vertices_out = 0;
    std::uint64_t target_faces = 0;
    StopReason stop = StopReason::reached_target;
    std::uint64_t collapses = 0;
    std::array<std::uint64_t, refusal_kinds> refusals = {};  ///< by Refusal: how often a pair was turned down
    std::array<std::uint64_t, rung_kinds> rungs = {};        ///< by Rung: how often taken
    /// Faces without area, before or after, or with two equal corners, and doubles.
    std::uint64_t faces_dropped = 0;
    std::uint64_t components_deleted = 0;
    std::uint64_t components_pruned = 0;  ///< deleted at the start, as Topology::prune says
    std::uint64_t faces_pruned = 0;       ///< faces of these
    std::uint64_t vertices_hidden = 0;    ///< of the input, that nothing outside sees (Options::visibility)
    std::uint64_t vertices_fitted = 0;    ///< moved in the end to come closer to the original (preset best)
    std::uint64_t edges_flipped = 0;      ///< in the end, for the same reason (preset best)
    std::uint64_t virtual_edges = 0;
    std::optional<MeasuredError> max_error = {};  ///< unless Options::max_error is unset, or it was cancelled
    std::vector<BakedPage> pages;                 ///< of a new atlas; materials without images have none
    std::vector<std::string> warnings;
    PhaseSeconds seconds;
};

FAQEM_EXPORT std::string_view name(Preset preset);
FAQEM_EXPORT std::string_view name(StopReason reason);
FAQEM_EXPORT std::string_view name(Refusal refusal);
FAQEM_EXPORT std::string_view name(Rung rung);

/// Finds a preset by the name that name() gives. \throws OptionError if there is none
FAQEM_EXPORT Preset preset_named(std::string_view text);

FAQEM_NAMESPACE_END

#ifdef FAQEM_HEADER_ONLY
#include "faqem/detail/simplify/report-inl.hpp"
#endif

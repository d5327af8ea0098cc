#pragma once
/// \file
/// `--max-bytes` without a face target: the face count and the images that give the best pictures for the bytes.

#include <cstdint>
#include <optional>

#include "cli/budget/byte_budget.hpp"
#include "faqem/bake.hpp"

namespace faqem::cli {

/// Whether the options leave the face count to best_picture_within_bytes(): no target is set, and the kind of baking
/// is Bake::automatic, without options that are about a new atlas or the collapses, or Bake::keep, vertex or none.
bool leaves_faces_to_budget(const Options& options);

/// Whether a run calls best_picture_within_bytes().
enum class PictureSearch { no, yes };

/// Whether a run with a budget searches for the best picture. \param max_bytes  the budget, if there is one
inline PictureSearch picture_search(const Options& options, std::optional<std::uint64_t> max_bytes) {
    return max_bytes && leaves_faces_to_budget(options) ? PictureSearch::yes : PictureSearch::no;
}

/// Simplifies with the UVs of the source (Bake::automatic and Bake::keep) or as BakeOptions::kind says, so that
/// pictures of the result are as near to those of the source as the bytes allow:
/// 1. One run gives results with 100% to 4.5% of the faces. Each is saved, for its bytes, and rendered with the images
///    of the source, for its error. If the source has no normals, they are left out where that looks better.
///    Where new grids of positions are used, and QuantizeOptions::position_bits is unset, 13 to 16 bits are tried.
/// 2. ImageTrials has the bytes and errors of the images.
/// 3. Errors of faces, images and rounding are assumed to add up, see budget_choices().
/// 4. The two most promising choices are made, saved and rendered; the better one is returned. Report::budget_points
///    has these, budget_trials those of 1 and 2.
/// Images stay as they are with Bake::keep and ImageFormat::source. BakeOptions::texture_size limits their sides, and
/// BakeOptions::image_quality is ignored.
/// \param options  leaves_faces_to_budget() must be true
/// \return nothing if no choice fits, or Options::max_seconds was over before one was complete. If the progress
///     callback cancels, the report has StopReason::cancelled
/// \throws whatever simplify() and save() throw
/// Complexity: two to six simplifications, about 20 encodings of each image with fewer texels than it has, and 40
/// renderings from six sides.
std::optional<SimplifiedAsset> best_picture_within_bytes(const Asset& source, const Options& options,
                                                         const ByteBudget& budget);

}  // namespace faqem::cli

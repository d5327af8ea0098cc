#pragma once
/// \file
/// Options::max_bytes without a face target: the face count and the images that give the best pictures for the bytes.

#include <optional>

#include "faqem/bake.hpp"
#include "faqem/engine/util/run_context.hpp"

namespace faqem::detail {

/// Whether a run searches for the best picture: Options::max_bytes is set, no target is, and the kind of baking is
/// Bake::automatic, without options that are about a new atlas or the collapses, or Bake::keep, vertex or none.
/// \param options  resolved_options()
bool searches_best_picture(const Options& options);

/// Simplifies with the UVs of the source (Bake::automatic and Bake::keep) or as BakeOptions::kind says, so that
/// pictures of the result are as near to those of the source as the bytes allow:
/// 1. One run gives results with 100% to 4.5% of the faces. Each is saved, for its bytes, and rendered with the images
///    of the source, for its error. If the source has no normals, they are left out where that looks better.
///    Where new grids of positions are used, and QuantizeOptions::position_bits is unset, 13 to 16 bits are tried.
/// 2. ImageTrials has the bytes and errors of the images.
/// 3. Errors of faces, images and rounding are assumed to add up, see result_choices().
/// 4. The two most promising choices are made, saved and rendered; the better one is returned. Report::compared_results
///    has both.
/// Images stay as they are with Bake::keep and ImageFormat::source. BakeOptions::texture_size limits their sides, and
/// BakeOptions::image_quality is ignored.
/// \param options  resolved, searches_best_picture() must be true
/// \return nothing if no choice fits, or Options::max_seconds was over before one was complete
/// \throws whatever simplify() and save() throw, and engine::Cancelled
/// Complexity: two to six simplifications, about 20 encodings of each image with fewer texels than it has, and 40
/// renderings from six sides.
std::optional<SimplifiedAsset> best_picture_within_bytes(const Asset& source, const Options& options,
                                                         const engine::RunContext& context);

}  // namespace faqem::detail

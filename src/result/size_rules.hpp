#pragma once
/// \file
/// The rules about the bytes of a result: no more than the files of its source, and Options::max_bytes.

#include "faqem/bake.hpp"
#include "faqem/engine/util/run_context.hpp"

namespace faqem::detail {

/// Calls bake_unencoded() and encode_images(). If the result has new images and more bytes than the files of the source
/// (Asset::file_bytes), and Options::larger is LargerFiles::avoided, it gives something up, until it has not:
/// 1. the normal map, if the source has none and BakeOptions::normal_map is automatic;
/// 2. either the size and quality of the images, unless BakeOptions::image_quality is set: fit_images();
///    or the new texture, if the parts were simplified with their UVs, too (SimplifiedParts::with_uvs): then the result has
///    the UVs and images of the source. What fits is taken and, of two that fit, the one with the better pictures.
/// Untouched parts stay as they are. A warning and
/// Report::given_up say what was given up, and another warning if the result is larger nevertheless.
/// \throws whatever bake() throws
/// Complexity: that of bake() and, if the result is larger, of encoding its images about ten times.
SimplifiedAsset bake_no_larger(const Asset& source, const SimplifiedParts& simplified, const Options& options,
                               const engine::RunContext& context);

/// Bakes. If the result exceeds Options::max_bytes, it gives up what bake_no_larger() does, also images of a quality that
/// was asked for. A warning has the sizes.
/// \param options  max_bytes is set
/// \return a result within the limit
/// \throws ByteLimitError  even the smallest images exceed the limit; the message has the size of the result with them
/// \throws whatever bake() throws
/// Complexity: that of bake() and fit_images().
SimplifiedAsset bake_within_bytes(const Asset& source, const SimplifiedParts& simplified,
                                  const Options& options, const engine::RunContext& context);

/// Simplifies and bakes within Options::max_bytes: best_picture_within_bytes() where the options leave the face count
/// open. Otherwise a result that fits is not changed, and one that does not gives up, as in bake_within_bytes(),
/// 1. the new normal map;
/// 2. images, if the face count was asked for, or the geometry takes at most half of the bytes beside animations, or what
///    existing images leave if none is baked;
/// 3. faces, until the geometry does, and then images again.
/// If anything was reduced, the report has a warning with the sizes; its target is the one that was asked for.
/// \param options  max_bytes is set; target and texture size are upper limits
/// \return as bake_within_bytes()
/// \throws ByteLimitError  no result fits
/// \throws TimeLimitError  Options::max_seconds was over before a result fitted
/// \throws whatever simplify() throws
/// Complexity: at most 12 calls of simplify(), those of the searches aside.
SimplifiedAsset simplify_within_bytes(const Asset& source, const Options& options,
                                      const engine::RunContext& context);

}  // namespace faqem::detail

#pragma once
/// \file
/// Options::max_bytes: results whose files have at most a number of bytes.

#include "faqem/bake.hpp"
#include "faqem/engine/util/run_context.hpp"

namespace faqem::detail {

/// Bakes. If the result exceeds Options::max_bytes, its images are fitted (fit_images()), and a warning has the number of
/// bytes before.
/// \param options  max_bytes is set
/// \return a result within the limit. If the progress callback cancels, the report has StopReason::cancelled
/// \throws ByteLimitError  even the smallest images exceed the limit; the message has the size of the result with them
/// \throws whatever bake() throws
/// Complexity: that of bake() and fit_images().
SimplifiedAsset bake_within_bytes(const Asset& source, const SimplifiedParts& simplified,
                                  const Options& options, const engine::RunContext& context);

/// Simplifies and bakes within Options::max_bytes: best_picture_within_bytes() where the options leave the face count
/// open. Otherwise a result that fits is not changed, and one that does not gets
/// 1. fewer faces, until the geometry takes at most half of the bytes, or what existing images leave if none is baked;
/// 2. fitted images (fit_images());
/// 3. fewer faces, if the smallest images do not fit.
/// If anything was reduced, the report has a warning with the sizes.
/// \param options  max_bytes is set; target and texture size are upper limits
/// \return as bake_within_bytes()
/// \throws ByteLimitError  no result fits
/// \throws TimeLimitError  Options::max_seconds was over before a result fitted
/// \throws whatever simplify() throws
/// Complexity: at most 12 calls of simplify(), those of the searches aside.
SimplifiedAsset simplify_within_bytes(const Asset& source, const Options& options,
                                      const engine::RunContext& context);

}  // namespace faqem::detail

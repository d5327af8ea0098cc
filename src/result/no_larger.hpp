#pragma once
/// \file
/// The rule that a textured result has no more bytes than the files of its source.

#include "faqem/bake.hpp"
#include "faqem/engine/util/run_context.hpp"

namespace faqem::detail {

/// Calls bake_unencoded() and encode_images(). If the result has new images and more bytes than the files of the source (Asset::file_bytes), and
/// Options::larger is LargerFiles::avoided, it gives something up, until it has not:
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

}  // namespace faqem::detail

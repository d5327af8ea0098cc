#pragma once
/// \file
/// Images of a result within a number of bytes; its faces stay.

#include <cstdint>

#include "bake/scene/unencoded_result.hpp"
#include "faqem/options.hpp"
#include "result/model_size.hpp"

namespace faqem::detail {

/// Gives the pending images of a result the sizes and encodings that give the best pictures for the bytes. Faces,
/// positions and UVs stay.
/// \param result   has pending images; afterwards these are encoded, and none is pending. If the progress callback
///                 cancels, its report has StopReason::cancelled
/// \param options  resolved; BakeOptions::image_quality is ignored
/// \param bytes    of all files
/// \return the size of the result. It is above `bytes` if even the smallest images do not fit; the result has these
/// \throws TimeLimitError  Options::max_seconds was over before images were chosen
/// Complexity: about ten encodings of each image, and renderings of six views.
ModelSize fit_images(UnencodedResult& result, const Options& options, const RunContext& context,
                     std::uint64_t bytes);

}  // namespace faqem::detail

#pragma once
/// \file
/// `--max-bytes` with a face count that stays: `faqem lod` and `truncate`.

#include "cli/budget/byte_budget.hpp"
#include "faqem/bake.hpp"

namespace faqem::cli {

/// Calls bake(). If the result exceeds the budget, its images get the sizes and encodings that give the best pictures
/// for the bytes, and a warning has the number of bytes before. Faces, positions and UVs stay.
/// \param options  as for bake(); BakeOptions::image_quality is chosen if the result exceeds the budget
/// \return a result within the budget. If the progress callback cancels, the report has StopReason::cancelled
/// \throws BudgetError  even the smallest images exceed the budget; the message has the size of the result with them
/// \throws whatever bake() and model_bytes() throw
/// Complexity: that of bake(), and about ten encodings of each image, and renderings of six views.
SimplifiedAsset bake_within_bytes(const Asset& source, const SimplifiedParts& simplified,
                                  const Options& options, const ByteBudget& budget);

}  // namespace faqem::cli

#pragma once
/// \file
/// `--max-bytes` with a face count that stays: `faqem lod` and `truncate`.

#include "cli/budget/byte_budget.hpp"
#include "cli/budget/picture_error.hpp"
#include "faqem/bake.hpp"

namespace faqem::cli {

/// Calls bake(). If the result exceeds the budget, its images get the sizes and qualities that give the best pictures for
/// the bytes, and a warning has the number of bytes before. Faces, positions and UVs stay.
/// \param options  as for bake(); BakeOptions::image_quality is chosen if the result exceeds the budget
/// \param meter    of the source
/// \return a result within the budget. If the progress callback cancels, the report has StopReason::cancelled
/// \throws BudgetError  even the smallest images exceed the budget; the message has the size of the result with them
/// \throws whatever bake() and model_bytes() throw
/// Complexity: that of bake(), and about 20 encodings and renderings of six views.
SimplifiedAsset bake_within_bytes(const Asset& source, const SimplifiedParts& simplified,
                                  const Options& options, const ByteBudget& budget,
                                  const PictureMeter& meter);

}  // namespace faqem::cli

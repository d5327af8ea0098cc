#pragma once
/// \file
/// What users call, as parts of a call that has a context.

#include "faqem/bake.hpp"
#include "faqem/engine/util/run_context.hpp"

namespace faqem::detail {

/// bake() of assets.
SimplifiedAsset bake(const Asset& source, const SimplifiedParts& simplified, const Options& options,
                     const engine::RunContext& context);

/// simplify() of assets.
SimplifiedAsset simplify(const Asset& source, const Options& options, const engine::RunContext& context);

}  // namespace faqem::detail

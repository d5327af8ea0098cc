#pragma once
/// \file
/// Surfaces that lie close to others, such as decals, linings and clothes.

#include <span>

#include "faqem/asset.hpp"
#include "faqem/engine/util/run_context.hpp"
#include "faqem/simplify.hpp"

namespace faqem::detail {

/// Whether layers are separated: with the presets that limit distances, unless those to the source must not change, and in
/// scenes of at most a million faces, for which a few hundred bytes per face are needed.
bool separates_layers(const Asset& source, const Options& options);

/// Moves vertices of results so that each connected component of the scene is on the side of its neighbours where it was
/// in the source. Parts are simplified one by one, so that near surfaces may cross: their faces differ, and the distance
/// between them is less than the error. Faces that are beside one other component, and parallel to it, move out to the
/// source. Crossings deeper than a share of the height of the face stay.
/// \param source   the parts are where their first instances are; those without one are left out
/// \param results  one per part, before mapping; positions change, and reports count them as fitted
/// \param context  the result does not depend on the number of threads
/// \throws whatever the check of `context` throws
/// Complexity: O(n log n) in the faces of the source and of the results, typically
void separate_layers(const Asset& source, std::span<SimplifyResult> results,
                     const engine::RunContext& context);

}  // namespace faqem::detail

#pragma once
/// \file
/// Vertex fitting of a finished result (preset best).

#include <vector>

#include "faqem/detail/base/parallel.hpp"
#include "faqem/detail/simplify/engine_run.hpp"
#include "faqem/simplify.hpp"

FAQEM_NAMESPACE_BEGIN
namespace detail {

/// Moves the vertices of a result closer to the original and flips edges where that reduces the distance.
/// Locked vertices, seams and group curves stay; with attributes no edge is flipped, since that would change
/// the attributes of the corners. Fills the report's and the history's records of it.
/// \param state              has the initial surface
/// \param prepared           converts to model units
/// \param min_normal_cosine  between a face's normal before and after
/// \param input              of the engine that made the result
/// \param slots              vertex of `input` for each vertex of the result
/// \param result             changed in place
/// \throws whatever the check of `context` throws
/// Complexity: O(n log n) per iteration
void fit_result(const RunState& state, const PreprocessedMesh& prepared, double min_normal_cosine,
                const EngineInput& input, const std::vector<Index>& slots, const RunContext& context,
                SimplifyResult& result);

}  // namespace detail
FAQEM_NAMESPACE_END

#ifdef FAQEM_HEADER_ONLY
#include "faqem/detail/simplify/result_fitting-inl.hpp"
#endif

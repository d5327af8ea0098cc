#pragma once
/// \file
/// Memoryless simplification in rounds over shifted cells, before one engine simplifies the rest.

#include "faqem/detail/base/parallel.hpp"
#include "faqem/detail/rounds/block_steps.hpp"
#include "faqem/export.hpp"
#include "faqem/option_types.hpp"

FAQEM_NAMESPACE_BEGIN
namespace detail {

/// Finds collapses for the whole surface in parallel.
///
/// In each round the surface is divided into the cells of a grid that is shifted at random. Each cell collapses its
/// cheapest edges, if all faces around them are in the cell. Border vertices and those at which the surface is
/// not a manifold with consistent windings do not move.
/// \param input    the surface
/// \param target   number of faces of the result; rounds keep a quarter more at least
/// \param patches  whether patch_faces and patch_begin are filled
/// \param context  reports Phase::simplify; the result does not depend on the number of threads
/// \return no steps if there are at most two blocks, if less than a quarter of the faces could be removed, or if
///     vertices that cannot move would be a large part of the result
/// \throws whatever the progress callback throws
/// Complexity: O(n) time, distributed over the threads; O(n) memory
BlockSteps simplify_in_rounds(const BlockInput& input, std::size_t target, Recording patches,
                              const RunContext& context);

}  // namespace detail
FAQEM_NAMESPACE_END

#ifdef FAQEM_HEADER_ONLY
#include "faqem/detail/rounds/rounds-inl.hpp"
#endif

#pragma once
/// \file
/// Parallel decimation of large surfaces in blocks, before one engine simplifies the rest.

#include <span>

#include "faqem/detail/base/parallel.hpp"
#include "faqem/detail/rounds/block_steps.hpp"
#include "faqem/detail/simplify/compaction.hpp"
#include "faqem/engine/loop_options.hpp"
#include "faqem/engine/tracking/original_surface.hpp"
#include "faqem/export.hpp"
#include "faqem/option_types.hpp"

FAQEM_NAMESPACE_BEGIN
namespace detail {

inline constexpr std::size_t max_vertices_per_block = 1 << 15;

/// Number of vertices per block. The number of blocks is a multiple of four, so that two or four threads
/// finish at the same time. More blocks would leave more faces between blocks, which cannot be simplified;
/// fewer need more memory.
/// \param vertices  number of vertices of the surface
/// \param few       surfaces with at most this number of vertices are a single block
std::size_t vertices_per_block(std::size_t vertices, std::size_t few = max_vertices_per_block);

/// Factor on the share of faces that is kept inside the blocks. It is above 1 because the interior of the
/// blocks should not become coarser than the final result: faces between blocks are still dense and are
/// collapsed first afterwards.
inline constexpr double spare_share = 1.08;

/// Loop options for the engine of one block.
/// \param loop     options for the whole surface
/// \param faces    number of faces of the block
/// \param between  number of these that have a corner in another block
/// \param share    share of the other faces that the whole surface keeps
engine::LoopOptions block_options(const engine::LoopOptions& loop, std::size_t faces, std::size_t between,
                                  double share);

/// The parts of the surface whose distance to the original is tracked.
enum class Watched { borders, borders_and_surface };

/// Data for distance tracking in blocks. References its arguments.
struct BlockTracking {
    const engine::OriginalSurface& original;
    std::span<const Index>
        vertex_map;  ///< one per vertex of `original`: the vertex slot it was merged into, or no_index
    Watched watched = Watched::borders_and_surface;
};

/// Finds collapses for all blocks in parallel.
///
/// A block is a range of vertices and the faces with a corner in it. Faces with corners in two blocks, and
/// their vertices, are not changed. Each block is simplified farther than necessary; then the collapses with
/// the highest costs are discarded in all blocks, so that the whole surface keeps the requested number of
/// faces and all blocks are simplified up to the same cost.
/// \param input     the surface
/// \param loop      options for the whole surface; `progress` is not used
/// \param least     number of faces that are kept at least; the interior of the blocks keeps the share
///                  spare_share * least / faces
/// \param tracking  null: the memoryless metric is used; otherwise the tracked metric
/// \param patches   whether patch_faces and patch_begin are filled
/// \param context   reports Phase::simplify; the result does not depend on the number of threads
/// \return no steps if there are at most two blocks, or if less than a quarter of the faces could be removed
/// \throws whatever the progress callback throws
/// Complexity: O(n log n) time, distributed over the threads; O(n) memory
BlockSteps simplify_in_blocks(const BlockInput& input, const engine::LoopOptions& loop, std::size_t least,
                              const BlockTracking* tracking, Recording patches, const RunContext& context);

/// Applies the steps and compacts the result.
/// Complexity: O(n)
CompactedMesh apply_steps(const BlockInput& input, std::span<const BlockStep> steps);

}  // namespace detail
FAQEM_NAMESPACE_END

#ifdef FAQEM_HEADER_ONLY
#include "faqem/detail/simplify/block_decimation-inl.hpp"
#endif

#pragma once
/// \file
/// Large surfaces: blocks of them are simplified side by side, as far as that is the same as simplifying the
/// whole.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "faqem/detail/base/parallel.hpp"
#include "faqem/detail/simplify/compaction.hpp"
#include "faqem/engine/loop.hpp"
#include "faqem/engine/tracking/original_surface.hpp"
#include "faqem/engine/util/cancellation.hpp"
#include "faqem/export.hpp"
#include "faqem/options.hpp"

FAQEM_NAMESPACE_BEGIN
namespace detail {

/// A collapse in a block, in slots of the whole.
struct BlockStep {
    Index survivor, gone;
    engine::Vector3 to;
};

/// What can be done in blocks.
struct BlockSteps {
    /// In the order in which they may be done.
    std::vector<BlockStep> steps;
    /// Where asked for: the faces with one of the two vertices, and where those of each step begin.
    std::vector<Index> patch_faces;
    std::vector<std::size_t> patch_begin;
    /// What the engines of the blocks counted, what they did beyond these steps included; but no pairs
    /// between locked vertices.
    std::array<std::uint64_t, refusal_kinds> refusals = {};
    std::array<std::uint64_t, rung_kinds> rungs = {};
    bool is_cancelled = false;
};

inline constexpr std::size_t max_vertices_per_block = 1 << 15;

/// The size of blocks for so many vertices: all of them where they are few, else a part of four, eight,
/// twelve ... alike, so that two or four threads end together. More blocks would leave more faces between
/// them, which wait; fewer take more memory.
/// \param few  up to which they are not cut
std::size_t vertices_per_block(std::size_t vertices, std::size_t few = max_vertices_per_block);

/// What is left inside of the blocks, over the share of all faces that is wanted. It should be no coarser
/// than the result: the faces that did not take part are denser, and will go first.
inline constexpr double spare_share = 1.15;

/// What the engine of a block is told.
/// \param faces, between  of the block: all, and those that have a corner elsewhere
/// \param share           of the others that will stay
engine::LoopOptions block_options(const engine::LoopOptions& loop, std::size_t faces, std::size_t between,
                                  double share);

/// What is watched for its distance to the original.
enum class Watched { borders, borders_and_surface };

/// What the blocks need for it.
struct BlockTracking {
    const engine::OriginalSurface& original;
    std::span<const Index>
        vertex_map;  ///< vertex of the input that each original one has gone into, or no_index
    Watched watched = Watched::borders_and_surface;
};

/// A surface without attributes, groups or virtual pairs. Borrows. Vertices that are near should have numbers
/// that are near.
struct BlockInput {
    std::span<const engine::Vector3> positions;
    std::span<const Triangle> triangles;   ///< of different corners
    std::span<const std::uint8_t> locked;  ///< one per vertex
    std::size_t per_block;                 ///< vertices

    std::size_t block_of(Index v) const { return v / per_block; }
    bool is_between_blocks(const Triangle& t) const {
        return block_of(t[0]) != block_of(t[1]) || block_of(t[0]) != block_of(t[2]);
    }
};

/// Finds the collapses that an engine would do first.
///
/// A block is a range of vertices, and the faces with a corner in it. Faces with corners in two blocks stay,
/// and so do their vertices. Each block is simplified farther than needed; then what was done at the highest
/// costs is given up everywhere, so that the whole keeps as many faces as wanted, and no block is worn more
/// than another.
/// \param loop     as for the whole; progress is called on this thread, with the share of this function
/// \param least    faces to keep, at least: of what is dense between the blocks, a share only
/// \param tracking null: with the memoryless metric
/// \param patches  whether to collect the faces of each step
/// \param workers  the result does not depend on how many
/// \return no steps for a surface of one or two blocks, or where little would be gained
/// O(n) on each thread, for all their vertices
BlockSteps simplify_in_blocks(const BlockInput& input, const engine::LoopOptions& loop, std::size_t least,
                              const BlockTracking* tracking, Recording patches, Workers workers);

/// Does the steps.
/// \throws what the poll throws.
/// O(n)
CompactedMesh apply_steps(const BlockInput& input, std::span<const BlockStep> steps,
                          engine::CancellationCheck check_cancelled = {});

}  // namespace detail
FAQEM_NAMESPACE_END

#ifdef FAQEM_HEADER_ONLY
#include "faqem/detail/simplify/block_decimation-inl.hpp"
#endif

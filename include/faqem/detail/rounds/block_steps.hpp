#pragma once
/// \file
/// What parts of a surface are simplified from, and what they give: a list of collapses.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "faqem/engine/constraints/planar_borders.hpp"
#include "faqem/engine/mesh/vector.hpp"
#include "faqem/export.hpp"
#include "faqem/report.hpp"

FAQEM_NAMESPACE_BEGIN
namespace detail {

/// A collapse in a block: `survivor` and `gone` (vertex slots of the whole surface) merge into `survivor` at
/// `to`.
struct BlockStep {
    Index survivor, gone;
    engine::Vector3 to;
};

/// The collapses found in all blocks.
struct BlockSteps {
    /// In an order in which they can be applied.
    std::vector<BlockStep> steps;
    /// If requested: face slots with one of the two vertices of a step, just before it.
    std::vector<Index> patch_faces;
    /// If requested, one per step: the index of its first face in patch_faces.
    std::vector<std::size_t> patch_begin;
    /// Sums over the engines of the blocks, including collapses that were discarded. Pairs of locked vertices
    /// are not counted.
    std::array<std::uint64_t, refusal_kinds> refusals = {};
    std::array<std::uint64_t, rung_kinds> rungs = {};
    std::uint64_t collapses = 0;  ///< number of steps, including those that were not recorded
    bool is_cancelled = false;
};

/// The remaining vertices and faces after some collapses, numbered consecutively.
struct CompactedMesh {
    std::vector<Index> vertices, faces;  ///< the old slot of each new vertex and face, ascending
    /// One per old vertex slot: the new vertex that it was merged into, or no_index. Rounds leave no_index also for merged
    /// vertices, unless RoundInput::merges is on.
    std::vector<Index> vertex_map;
    std::vector<Index> source_slots;         ///< one per new vertex: old slot with its position, or no_index
    std::vector<engine::Vector3> positions;  ///< one per new vertex
    std::vector<Triangle> triangles;         ///< one per new face, of new vertices
    std::uint64_t isolated_slots = 0;  ///< old slots that were not merged into others and have no face left
};

/// A surface without attributes, groups or virtual edges. References its arguments. Vertices that are close
/// in space should have close indices, because blocks are ranges of indices.
struct BlockInput {
    std::span<const engine::Vector3> positions;      ///< one per vertex slot, engine units
    std::span<const Triangle> triangles;             ///< each with three different corners
    std::span<const std::uint8_t> locked;            ///< one per vertex; nonzero: must not move
    std::size_t per_block;                           ///< vertices per block
    std::span<const std::uint8_t> closed = {};       ///< empty, or one per vertex: see LoopOptions::closed
    const engine::PlanarBorders* borders = nullptr;  ///< of this surface; null: none

    std::size_t block_count() const { return (positions.size() + per_block - 1) / per_block; }
    std::size_t block_of(Index v) const { return v / per_block; }
    bool is_between_blocks(const Triangle& t) const {
        return block_of(t[0]) != block_of(t[1]) || block_of(t[0]) != block_of(t[2]);
    }
};

}  // namespace detail
FAQEM_NAMESPACE_END

#pragma once
/// \file
/// The collapses that rounds find, and the surface that is left.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "faqem/engine/mesh/vector.hpp"
#include "faqem/export.hpp"
#include "faqem/report.hpp"

FAQEM_DETAIL_BEGIN

/// A collapse: `survivor` and `gone` (vertex slots of the surface) merge into `survivor` at `to`.
struct RoundStep {
    Index survivor, gone;
    engine::Vector3 to;
};

/// The collapses of all rounds, or of one cell in one round.
struct RoundSteps {
    /// In an order in which they can be applied.
    std::vector<RoundStep> steps;
    /// If requested: face slots with one of the two vertices of a step, just before it.
    std::vector<Index> patch_faces;
    /// If requested, one per step: the index of its first face in patch_faces.
    std::vector<std::size_t> patch_begin;
    std::array<std::uint64_t, refusal_kinds> refusals = {};  ///< by Refusal
    std::uint64_t collapses = 0;  ///< number of steps, including those that were not recorded
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
    std::vector<Index> bound_faces;          ///< if rounds tracked distances: see TrackedVertices::faces
};

FAQEM_DETAIL_END

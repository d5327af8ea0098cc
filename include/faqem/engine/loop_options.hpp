#pragma once
/// \file
/// Options and result of the collapse loop.

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>

#include "faqem/engine/constraints/legality.hpp"
#include "faqem/engine/mesh/vector.hpp"
#include "faqem/engine/util/run_context.hpp"
#include "faqem/export.hpp"
#include "faqem/progress.hpp"
#include "faqem/report.hpp"

FAQEM_ENGINE_BEGIN

/// What the loop does if no legal collapse is left above the target.
enum class Ladder {
    on,      ///< evaluates all pairs again, then relaxes one rule after the other
    reseed,  ///< evaluates all pairs again
    off,     ///< stops
};

/// Options of one run of the collapse loop.
struct LoopOptions {
    std::size_t target_faces = 4;  ///< the loop stops at this face count or below
    Rules rules = {};              ///< legality rules at the start; the ladder relaxes them
    Ladder ladder = Ladder::on;
    /// Empty, or one per vertex: nonzero if its component is closed (see closed_vertices() of detail), and stays so:
    /// no edge gets more than two faces, and no two faces get the same corners. Referenced by run() only.
    std::span<const std::uint8_t> closed = {};
    /// Cost of a squared distance that the metric does not measure, >= 0; 0: not counted. It applies to the
    /// distance from a boundary loop that vanishes or appears to the nearest other one, and, doubled, to
    /// the squared length of a pair whose collapse folds the surface.
    double distance_weight = 0;
    /// The rung `tiny_components` may delete components whose bounding box diagonal is at most this. Engine
    /// units, >= 0.
    double tiny_component_diagonal = 0;
    /// Called on the calling thread after every few thousand operations with the fraction of faces removed,
    /// in [0, 1]; may be empty. If it cancels or throws, the mesh stays consistent.
    std::function<Continue(double)> progress = {};
    /// The loop stops at this time. It is checked with `progress`, and the mesh stays consistent.
    RunContext::Deadline deadline = RunContext::no_deadline;
};

/// Result of the collapse loop; totals over all calls of one engine.
struct LoopResult {
    StopReason stop = StopReason::reached_target;
    std::uint64_t collapses = 0;                             ///< number of collapses
    std::array<std::uint64_t, refusal_kinds> refusals = {};  ///< by Refusal: how often a collapse was refused
    std::array<std::uint64_t, rung_kinds> rungs = {};        ///< by Rung: how often the rung was taken
    std::uint64_t components_collapsed = 0;  ///< connected components whose last faces were collapsed
    std::uint64_t components_deleted = 0;    ///< connected components deleted by the ladder
};

FAQEM_ENGINE_END

#pragma once
/// \file
/// A simplification run with one or more face counts as targets.

#include <algorithm>
#include <cmath>
#include <compare>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "faqem/compare.hpp"
#include "faqem/engine/util/run_context.hpp"
#include "faqem/export.hpp"
#include "faqem/option_types.hpp"
#include "faqem/simplify.hpp"

FAQEM_DETAIL_BEGIN

/// Smallest target of simplify(); lower targets are raised to it.
inline constexpr std::uint64_t min_target_faces = 4;

/// Number of faces that a target requests, at most 1e18. min_target_faces is not applied.
/// \param target  valid; Target::Kind::unset counts as a ratio
/// \param faces   number of faces of the mesh
inline std::uint64_t target_face_count(const Target& target, double faces) {
    // The factor prevents rounding errors from losing a face in floor(): 0.1 * 30 must give 3.
    const double wanted =
        target.kind == Target::Kind::faces ? target.value : target.value * faces * (1 + 1e-15);
    return static_cast<std::uint64_t>(std::floor(std::min(wanted, 1e18)));
}

/// Whether a surface is closed, and handles hold more than a sixth of its faces: genus g needs over 4 g faces.
inline bool is_held_by_handles(const MeshView& mesh) {
    const MeshInfo found = info(mesh);
    return found.boundary_edges == 0 &&
           12 * (2 * std::int64_t(found.components) - found.euler) > std::int64_t(found.faces);
}

/// A place that is too far: a face of the result and a face of the original, of which one is far from the other surface
/// and the other one is nearest to it; no_index: another mesh than the original is simplified.
struct FarFaces {
    Index result, original;
    auto operator<=>(const FarFaces&) const = default;
};
/// Finds the places of a result that are too far.
using FindFarFaces = std::function<std::vector<FarFaces>(const TriangleMesh&)>;

/// Collapses until every further collapse would exceed a distance, as far as distances of points show; then undoes the
/// last collapses at places that are too far.
/// \param allowed  the distance, model units
/// \param far      called with results, until it returns none; best: without the fitting of vertices if it returns any
/// \param options  as for run_to_targets(), with preset fast, balanced or best
/// \return nothing if places are too far around which nothing was collapsed, or if the result is_held_by_handles(), of
///         which none vanishes here
/// \throws Cancelled, otherwise as run_to_targets(), and whatever `far` throws
/// Complexity: O(n log n), and the calls of `far`
FAQEM_EXPORT std::optional<SimplifyResult> run_within(const MeshView& mesh, double allowed,
                                                      const FindFarFaces& far, const Options& options,
                                                      const engine::RunContext& context);

/// Simplifies to each target in turn, continuing from the mesh of the previous target. Vertex fitting and
/// edge flips of a result (preset best) are not passed on to the next target. The counts in a report are
/// totals since the original; the times are those of the one target.
/// \param mesh     see simplify(); read only during the call
/// \param targets  face counts, not empty, in descending order
/// \param options  must be valid; `target`, `max_error` and what is in `context` are ignored
/// \return one result per target. If the run is cancelled, the last result has StopReason::cancelled and the
///         results of the following targets are missing.
/// \throws InputError  as simplify()
/// \throws whatever the progress callback throws
/// Complexity: O(n log n) for all targets together
FAQEM_EXPORT std::vector<SimplifyResult> run_to_targets(const MeshView& mesh,
                                                        std::span<const std::uint64_t> targets,
                                                        const Options& options,
                                                        const engine::RunContext& context);

FAQEM_DETAIL_END

#ifdef FAQEM_HEADER_ONLY
#include "faqem/detail/simplify/run-inl.hpp"
#endif

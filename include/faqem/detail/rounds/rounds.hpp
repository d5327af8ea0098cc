#pragma once
/// \file
/// Memoryless simplification in rounds over shifted cells, before one engine simplifies the rest.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "faqem/detail/rounds/links.hpp"
#include "faqem/detail/rounds/round_steps.hpp"
#include "faqem/engine/constraints/planar_borders.hpp"
#include "faqem/engine/tracking/original_surface.hpp"
#include "faqem/export.hpp"
#include "faqem/option_types.hpp"

FAQEM_DETAIL_BEGIN

/// Distances that rounds track, as engine::TrackedMetric does. References its arguments.
struct RoundTracking {
    const engine::OriginalSurface* original;
    std::span<const Index>
        vertex_map;     ///< one per vertex of `original`: the slot it was merged into, or no_index
    std::size_t start;  ///< the surface is tracked when it has at most this number of faces
    double weight;      ///< the cost of a squared distance; engine units squared
};

/// A surface without attributes, weights or virtual edges. References arrays that rounds release, unless they decline.
struct RoundInput {
    std::vector<engine::Vector3>& positions;         ///< one per vertex slot, engine units
    std::vector<Triangle>& triangles;                ///< each with three different corners
    std::vector<Links>& links;                       ///< see link_corners(); empty: not yet known
    std::span<const std::uint8_t> locked;            ///< one per vertex; nonzero: must not move
    std::span<const Index> groups = {};              ///< empty, or one per face: their boundaries do not move
    const engine::PlanarBorders* borders = nullptr;  ///< of this surface; null: none
    Recording merges =
        Recording::off;  ///< whether CompactedMesh::vertex_map has merged vertices; required for tracking
    const RoundTracking* tracking = nullptr;
};

/// Surfaces with fewer vertices are left to the engine, and so are the last faces: the order of costs in a cell is coarse,
/// and few collapses are left to correct it.
inline constexpr std::size_t min_vertices_of_rounds = 4096, min_faces_after_rounds = 3000;

/// The number of faces that rounds leave to the engine, which takes the rest exactly in the order of its costs, and
/// collapses what rounds refuse: up to twice the target if they are few.
/// \param spare  least number of faces above the target
inline std::size_t faces_after_rounds(std::size_t target, std::size_t spare) {
    return std::max(target + spare, std::clamp(2 * target, min_faces_after_rounds, std::size_t{6250}));
}

/// Simplifies the whole surface in parallel.
///
/// In each round the surface is divided into the cells of a grid that is shifted at random. Each cell collapses its
/// cheapest edges, if all faces around them are in the cell. Vertices do not move on a border or between groups, at folds,
/// at faces too narrow for single precision, and where the surface is not an orientable manifold. Windings may be mixed,
/// and stay as they are.
/// \param input    the surface
/// \param least    number of faces that are kept at least; so are 8 for each vertex that does not move for the reasons
///     above
/// \param patches  whether steps are recorded, with patch_faces and patch_begin
/// \param context  reports Phase::simplify; the result does not depend on the number of threads
/// \param found    the number of collapses, refusals, and the steps
/// \return the surface after the steps; none if less than a quarter of the faces could be removed
/// \throws engine::Cancelled  if the progress callback cancels; also whatever it throws
/// Complexity: O(n) time, distributed over the threads; O(n) memory
std::optional<CompactedMesh> simplify_in_rounds(const RoundInput& input, std::size_t least, Recording patches,
                                                const RunContext& context, RoundSteps& found);

FAQEM_DETAIL_END

#ifdef FAQEM_HEADER_ONLY
#include "faqem/detail/rounds/rounds-inl.hpp"
#endif

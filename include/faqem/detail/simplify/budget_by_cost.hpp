#pragma once
/// \file
/// Distributes a face budget over several meshes by the cost of their collapses.

#include <cstdint>
#include <span>
#include <vector>

#include "faqem/engine/util/run_context.hpp"
#include "faqem/export.hpp"
#include "faqem/mesh.hpp"
#include "faqem/option_types.hpp"
#include "faqem/report.hpp"

FAQEM_DETAIL_BEGIN

/// Cost of each collapse when one mesh is simplified as far as possible.
struct CostCurve {
    struct Step {
        std::uint64_t faces;  ///< number of faces before the collapse
        /// Largest cost of this and all earlier collapses, an area times a squared distance, on the mesh
        /// scaled to a bounding-box diagonal of 1. Infinite once whole components have been deleted.
        double cost;
    };
    std::vector<Step> steps;      ///< face counts descend, costs ascend
    std::uint64_t min_faces = 0;  ///< number of faces after the last step
    double diagonal = 0;          ///< bounding-box diagonal of the mesh, model units
    /// The curve is incomplete if this is `cancelled` or `reached_time_limit`.
    StopReason stop = StopReason::no_legal_collapse;
};

/// A collapse is flat if it moves the surface by less than this share of the mesh's diagonal (root mean square over the
/// faces at the vertex). Positions rounded to 16 bits lie this close to a plane.
inline constexpr double flat_distance = 3e-5;

/// Simplifies a copy of the mesh with preset fast as far as its locks and seams permit, and records the
/// costs. Defined in run-inl.hpp.
/// \param mesh     see simplify(); read only during the call
/// \param options  of the run; preset, weights, target, max_error and history are ignored, and what is in `context`
/// \throws OptionError, InputError  as simplify()
/// \throws whatever the progress callback throws
/// Complexity: O(n log n)
FAQEM_EXPORT CostCurve cost_curve(const MeshView& mesh, const Options& options,
                                  const engine::RunContext& context);

/// Whether a mesh can be simplified to a number of faces by flat collapses alone.
FAQEM_EXPORT bool is_flat_down_to(const CostCurve& curve, std::uint64_t faces);

/// Computes how many faces each mesh keeps so that the total is at most `face_budget`. The cheapest collapses
/// of all meshes are taken first, without those that would reduce a mesh below its floor and that are not flat: these
/// follow if the others are not enough.
/// \param curves       one per mesh
/// \param weights      one per mesh, > 0: factor on costs in model units (an area times a squared distance)
/// \param face_budget  total number of faces
/// \param floors       face count per mesh below which only flat collapses are taken; empty: none
/// \return face count per mesh. The sum exceeds `face_budget` only if no curve permits fewer faces.
/// Complexity: O(n log n) in the number of steps of all curves
FAQEM_EXPORT std::vector<std::uint64_t> distribute_face_budget(std::span<const CostCurve> curves,
                                                               std::span<const double> weights,
                                                               std::uint64_t face_budget,
                                                               std::span<const std::uint64_t> floors = {});

FAQEM_DETAIL_END

#ifdef FAQEM_HEADER_ONLY
#include "faqem/detail/simplify/budget_by_cost-inl.hpp"
#endif

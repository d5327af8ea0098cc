#pragma once
/// \file
/// What the faces of a mesh are worth: how a face budget is spread over several meshes.

#include <cstdint>
#include <span>
#include <vector>

#include "faqem/export.hpp"
#include "faqem/mesh.hpp"
#include "faqem/options.hpp"

FAQEM_NAMESPACE_BEGIN
namespace detail {

/// The way of one mesh from all its faces to the fewest, and what each step costs.
struct CostCurve {
    struct Step {
        std::uint64_t faces;  ///< there are before the step
        /// Largest cost of a collapse so far, on a model of diagonal 1: an area times a squared distance.
        double cost;
    };
    std::vector<Step> steps;      ///< faces descend, costs ascend
    std::uint64_t min_faces = 0;  ///< faces after the last step
    double diagonal = 0;          ///< of the mesh, model units
    bool is_complete = true;      ///< false: the progress callback cancelled
};

/// Collapses a copy of the mesh as far as its locks and seams let it, with preset fast. Weights, target and
/// history of the options do not count. Defined in simplify.cpp: it is the first half of a run.
/// \throws as simplify()
/// O(n log n)
FAQEM_EXPORT CostCurve cost_curve(const MeshView& mesh, const Options& options);

/// How many faces each mesh keeps so that all have `face_budget` at most, the dearest being kept.
/// \param curves   of the meshes
/// \param weights  how much a squared distance times an area in model units counts, per mesh, > 0
/// \return per mesh; their sum is above `face_budget` only where no curve goes lower.
/// O(n log n)
FAQEM_EXPORT std::vector<std::uint64_t> distribute_face_budget(std::span<const CostCurve> curves,
                                                               std::span<const double> weights,
                                                               std::uint64_t face_budget);

}  // namespace detail
FAQEM_NAMESPACE_END

#ifdef FAQEM_HEADER_ONLY
#include "faqem/detail/simplify/budget_by_cost-inl.hpp"
#endif

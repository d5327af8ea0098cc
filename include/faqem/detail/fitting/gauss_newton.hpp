#pragma once
/// \file
/// Gauss-Newton step for fitting a mesh to correspondences.

#include <cstdint>
#include <span>
#include <vector>

#include "faqem/detail/base/parallel.hpp"
#include "faqem/detail/base/vector.hpp"
#include "faqem/detail/geometry/surface_samples.hpp"
#include "faqem/export.hpp"
#include "faqem/mesh.hpp"

FAQEM_DETAIL_BEGIN

/// A point of the mesh and its corresponding point on another surface.
struct Correspondence {
    SurfaceSample sample;                ///< the point of the mesh
    Vector3 residual = Vector3::Zero();  ///< vector from the point to the corresponding point
    Vector3 normal = Vector3::Zero();    ///< unit normal, for the point-to-plane distance
};

/// Computes one damped Gauss-Newton step that decreases the distances of the correspondences. The squared
/// distance is nine tenths point-to-plane and one tenth point-to-point, and is weighted by a power of the
/// current distance d. The damping keeps vertices in position that the correspondences hardly determine. The
/// system is solved by preconditioned conjugate gradients.
/// \param triangles        triangles with no_index corners are ignored
/// \param correspondences  samples on these triangles
/// \param fixed            one per vertex; nonzero: the vertex does not move
/// \param power            p >= 0: the step decreases the sum of d^(2 + p)
/// \param context          the result does not depend on the number of threads
/// \return one step per vertex, in the units of the residuals; not finite if the system cannot be solved
/// O(correspondences + faces) per iteration, at most 60 iterations
std::vector<Vector3> gauss_newton_step(std::span<const Triangle> triangles,
                                       std::span<const Correspondence> correspondences,
                                       std::span<const std::uint8_t> fixed, double power,
                                       const RunContext& context);

FAQEM_DETAIL_END

#ifdef FAQEM_HEADER_ONLY
#include "faqem/detail/fitting/gauss_newton-inl.hpp"
#endif

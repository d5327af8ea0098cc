#pragma once
/// \file
/// One Gauss-Newton step of fitting a mesh to correspondences at its points.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "faqem/detail/base/parallel.hpp"
#include "faqem/detail/geometry/surface_samples.hpp"
#include "faqem/engine/mesh/vector.hpp"
#include "faqem/export.hpp"
#include "faqem/mesh.hpp"

FAQEM_NAMESPACE_BEGIN
namespace detail {

/// A point of the mesh, and where another surface wants it.
struct Correspondence {
    SurfaceSample sample;
    engine::Vector3 residual = engine::Vector3::Zero();  ///< from the point to its counterpart
    engine::Vector3 normal = engine::Vector3::Zero();  ///< unit: the residual along it is most of what counts
};

/// The step of each vertex that would bring the points closest to their counterparts, if the surfaces were
/// their tangent planes: nine tenths point to plane, one tenth point to point, weighted by their distance d
/// to a power. Damped, so that what the correspondences say little about stays.
/// \param triangles  a triangle with no_index corners is none
/// \param fixed      one per vertex: nonzero stays
/// \param power      p: what gets smaller is the sum of d^(2 + p); >= 0
/// \param workers    the result does not depend on how many
/// \return one step per vertex; not finite where the system cannot be solved
/// O(correspondences + faces), and at most 60 steps of conjugate gradients
std::vector<engine::Vector3> gauss_newton_step(std::span<const Triangle> triangles,
                                               std::span<const Correspondence> correspondences,
                                               std::span<const std::uint8_t> fixed, double power,
                                               Workers workers);

}  // namespace detail
FAQEM_NAMESPACE_END

#ifdef FAQEM_HEADER_ONLY
#include "faqem/detail/fitting/gauss_newton-inl.hpp"
#endif

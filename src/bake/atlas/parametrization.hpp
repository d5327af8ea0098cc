#pragma once
/// \file
/// Parametrization of connected faces: a map from the surface to the plane.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "bake/atlas/chart.hpp"

namespace faqem::detail {

/// Result of parametrize().
struct Parametrization {
    enum class Outcome {
        valid,
        flipped,  ///< some triangles are flipped or degenerate: `flipped_faces`
        /// No triangle is flipped, but some overlap or has_boundary_clearance() is false; or there is no
        /// result because of too many faces, the work limit, or a linear system that could not be solved.
        overlapping,
    };
    Outcome outcome = Outcome::overlapping;
    Chart chart;                       ///< set if the outcome is `valid`
    std::vector<Index> flipped_faces;  ///< indices of faces, ascending; set if the outcome is `flipped`
};

/// Work units that one flattening costs for every face.
inline constexpr std::uint64_t parametrization_work_per_face = 256;

/// Sets of more faces are not parametrized in one piece: the time between two cancellation checks grows with
/// the number of faces to the power 1.5, and is 25 ms for this many.
inline constexpr std::size_t max_faces_per_chart = 8192;

/// Parametrizes connected faces with low distortion.
/// The initial map is the projection along the mean normal if it flips no triangle, otherwise a least squares
/// conformal map (Lévy et al. 2002). It is followed by up to 10 iterations of as-rigid-as-possible
/// parametrization (Liu et al. 2008), of which the one with the least stretch and no flipped triangle is
/// taken. A single face is always valid and mapped isometrically. A triangle whose height is less than a
/// thousandth of its longest edge is given that height. More than `max_faces_per_chart` faces are not tried.
/// \param all    all faces of the page
/// \param faces  indices into `all`, ascending, connected over PageTriangle::adjacent
/// \param work   as in have_disjoint_interiors(); the flattening itself counts as
///               `parametrization_work_per_face` comparisons per face
/// Complexity: O(n^1.5) expected.
Parametrization parametrize(std::span<const PageTriangle> all, std::vector<Index> faces, std::uint64_t& work);

}  // namespace faqem::detail

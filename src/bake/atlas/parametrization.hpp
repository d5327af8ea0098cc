#pragma once
/// \file
/// From faces on a surface to flat ones.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "bake/atlas/chart.hpp"
#include "faqem/engine/util/cancellation.hpp"

namespace faqem::detail {

/// What came of an attempt to lay faces flat.
struct Parametrization {
    enum class Outcome {
        valid,
        flipped,  ///< some triangles would lie on their backs: `flipped_faces`
        /// All turn the right way, but some lie on others, or has_boundary_clearance() does not hold, or it could
        /// not be told.
        overlapping,
    };
    Outcome outcome = Outcome::overlapping;
    Chart chart;                       ///< of `valid` only
    std::vector<Index> flipped_faces;  ///< faces, ascending
};

inline constexpr std::uint64_t parametrization_work_per_face = 256;

/// More faces are not laid flat in one piece: the time between two questions to the poll grows with them to
/// the power 1.5, and that for so many is 25 ms.
inline constexpr std::size_t max_faces_per_chart = 8192;

/// Lays connected faces flat with little stretch. Begins with the projection along their mean normal if that
/// turns none over, else with a least squares conformal map (Lévy et al. 2002), and goes on with rounds of
/// as-rigid-as-possible parametrisation (Liu et al. 2008), of which the best is taken. One face alone is
/// always flat, and exact. Faces with less height than a thousandth of their longest side get that much. More
/// than `max_faces_per_chart` are not tried: the outcome is `overlapping`.
/// \param all    of the page
/// \param faces  into `all`, ascending, connected over `adjacent`
/// \param work   as in have_disjoint_interiors(); a flattening itself counts as `parametrization_work_per_face` comparisons a face
/// \throws what the poll throws; solving a system of all vertices is one operation
/// O(n^1.5) expected
Parametrization parametrize(std::span<const ChartFace> all, std::vector<Index> faces, std::uint64_t& work,
                            engine::CancellationCheck check_cancelled = {});

}  // namespace faqem::detail

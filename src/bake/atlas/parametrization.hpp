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
struct Flattening {
    enum class Outcome {
        flat,
        turned,    ///< some triangles would lie on their backs: `turned`
        /// All turn the right way, but some lie on others, or outline_is_clear() does not hold, or it could
        /// not be told.
        overlaps,
    };
    Outcome outcome = Outcome::overlaps;
    Chart chart;                ///< of `flat` only
    std::vector<Index> turned;  ///< faces, ascending
};

inline constexpr std::uint64_t flatten_work = 256;

/// More faces are not laid flat in one piece: the time between two questions to the poll grows with them to
/// the power 1.5, and that for so many is 25 ms.
inline constexpr std::size_t most_faces_per_chart = 8192;

/// Lays connected faces flat with little stretch. Begins with the projection along their mean normal if that
/// turns none over, else with a least squares conformal map (Lévy et al. 2002), and goes on with rounds of
/// as-rigid-as-possible parametrisation (Liu et al. 2008), of which the best is taken. One face alone is
/// always flat, and exact. Faces with less height than a thousandth of their longest side get that much. More
/// than `most_faces_per_chart` are not tried: the outcome is `overlaps`.
/// \param all    of the page
/// \param faces  into `all`, ascending, connected over `across`
/// \param work   as in apart(); a flattening itself counts as `flatten_work` comparisons a face
/// \throws what the poll throws; solving a system of all vertices is one operation
/// O(n^1.5) expected
Flattening flatten(std::span<const ChartFace> all, std::vector<Index> faces, std::uint64_t& work,
                   engine::Poll poll = {});

}  // namespace faqem::detail

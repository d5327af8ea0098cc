#pragma once
/// \file
/// A mesh with the distance to another one at so many of its points that one can colour it.

#include <cstdint>
#include <vector>

#include "faqem/asset.hpp"

namespace faqem::cli {

/// Model units.
struct ErrorSurface {
    std::vector<Vec3> positions;
    std::vector<Triangle> triangles;
    std::vector<double> distances;  ///< per vertex, to the closest point of the other mesh
};

/// The corners of a large face lie on the other mesh more often than not: what is between them shows only
/// where the face is cut.
/// \param spacing  > 0: faces are cut into alike ones until no edge is longer, or they are a million more
/// \param threads  0: all; the result does not depend on it
/// \throws InputError  `to` has no face with area
/// Complexity: O((vertices + faces + cuts) log faces of `to`) typically.
ErrorSurface error_surface(const Part& mesh, const Part& to, double spacing, std::uint32_t threads = 0);

/// The smallest distance that at least a share of the vertices of both are within; 0 where there are none.
/// \param share  in [0, 1]
double distance_quantile(const ErrorSurface& a, const ErrorSurface& b, double share);

}  // namespace faqem::cli

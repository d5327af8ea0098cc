#pragma once
/// \file
/// Distances between meshes at the vertices of a subdivided mesh, for heat maps.

#include <cstdint>
#include <vector>

#include "faqem/asset.hpp"

namespace faqem::cli {

/// A mesh with a distance per vertex. Positions and distances are in model units.
struct ErrorSurface {
    Part part;                      ///< without materials
    std::vector<double> distances;  ///< per vertex, to the closest point of the other mesh
};

/// Subdivides a mesh and computes the distance of each vertex to another mesh. Subdivision is necessary
/// because the corners of a large face often lie on the other mesh even if its interior does not. Typical
/// complexity: O((vertices + faces + added faces) log(faces of `to`)).
/// \param mesh     mesh to subdivide
/// \param to       mesh to which distances are measured
/// \param spacing  maximum edge length, > 0, model units; increased to add at most a million faces
/// \param threads  maximum number of threads, 0: all; the result does not depend on it
/// \throws InputError  `to` has no face with non-zero area
ErrorSurface error_surface(const Part& mesh, const Part& to, double spacing, std::uint32_t threads = 0);

/// Returns a quantile of the distances of all vertices of both surfaces; 0 if there are no vertices.
/// \param share  in [0, 1]; 1 gives the maximum
double distance_quantile(const ErrorSurface& a, const ErrorSurface& b, double share);

}  // namespace faqem::cli

#pragma once
/// \file
/// Heat maps: distances between meshes at the vertices of a subdivided mesh, and a perceptually uniform colour map from
/// dark blue to yellow.

#include <array>
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

/// Samples of the colour map viridis (van der Walt and Smith, public domain) at multiples of 1/8. sRGB, 0 to
/// 255.
inline constexpr std::array<std::array<std::uint8_t, 3>, 9> heat_ramp = {{{68, 1, 84},
                                                                          {71, 45, 123},
                                                                          {59, 82, 139},
                                                                          {44, 114, 142},
                                                                          {33, 144, 140},
                                                                          {39, 173, 129},
                                                                          {93, 200, 99},
                                                                          {170, 220, 50},
                                                                          {253, 231, 37}}};

/// Returns the interpolated colour at a position of the colour map.
/// \param share  position in [0, 1]; clamped, NaN is treated as 0
/// \return linear RGBA
Vec4f heat_color(double share);

}  // namespace faqem::cli

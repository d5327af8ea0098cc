#pragma once
/// \file
/// Normals of the small mesh, taken from the original through the map.

#include "bake/corners.hpp"

namespace faqem::detail {

/// Per corner of the small mesh.
struct CornerNormals {
    std::vector<Vec3f> normals;   ///< unit length, on the front side of their face
    std::vector<Index> clusters;  ///< corners of one vertex that share a normal have the same number
};

/// A corner's normal is the original's (its face's, where it has none) a little inside the small face.
/// Corners of one vertex whose normals differ by at most the crease angle get their mean, weighted by corner
/// angles. A normal that would look away from its face gives way to the face's. \param crease_degrees  in [0,
/// 180] O(corners), for bounded numbers of creases per vertex
CornerNormals transfer_normals(const SmallPart& part, double crease_degrees, std::uint32_t threads);

}  // namespace faqem::detail

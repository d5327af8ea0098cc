#pragma once
/// \file
/// Normals of the small mesh.

#include "bake/corners.hpp"

namespace faqem::detail {

/// Per corner of the small mesh.
struct CornerNormals {
    std::vector<Vec3f> normals;   ///< unit length, on the front side of their face
    std::vector<Index> clusters;  ///< corners of one vertex that share a normal have the same number
};

/// As BakeOptions::normals says. Normals::transfer: a corner's normal is the original's (its face's, where it
/// has none) a little inside the small face. Normals::smooth: the small face's own.
/// Corners of one vertex whose normals differ by at most the crease angle get their mean, weighted by corner
/// angles. A normal that would look away from its face gives way to the face's. Normals::flat clusters as
/// Normals::smooth does. O(corners), for bounded numbers of creases per vertex
CornerNormals make_normals(const SmallPart& part, const BakeOptions& options, std::uint32_t threads);

}  // namespace faqem::detail

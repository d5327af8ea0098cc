#pragma once
/// \file
/// Normals of the simplified mesh.

#include <cstdint>
#include <vector>

#include "bake/transfer/corners.hpp"
#include "faqem/detail/base/parallel.hpp"
#include "faqem/engine/mesh/vector.hpp"

namespace faqem::detail {

/// Per corner of the simplified mesh.
struct CornerNormals {
    std::vector<Vec3f> normals;   ///< unit length, on the front side of their face
    std::vector<Index> clusters;  ///< corners of one vertex that share a normal have the same number
    /// Per face: 1 where the original face that it used to be is wound against its own normals, while most of
    /// the part is not. Such files are lit as they were, wrong winding or not.
    std::vector<std::uint8_t> has_reversed_winding;
};

/// The unit normal of a simplified face as it is wound, or its opposite where it is CornerNormals::has_reversed_winding. Zero
/// where the face has no area. O(1)
engine::Vector3 oriented_face_normal(const BakePart& part, const CornerNormals& normals, std::size_t face);

/// Whether the normals of both ends are split along an edge.
/// \param corner,other_corner  of the two faces on it, each opposite the edge; both are wound alike
bool is_crease(const CornerNormals& normals, std::size_t face, std::size_t corner, std::size_t other,
               std::size_t other_corner);

/// As BakeOptions::normals says. Normals::transfer: a corner's normal is the original's (its face's, where it
/// has none) a little inside the simplified face. Normals::smooth: the simplified face's own.
/// Corners of one vertex whose normals differ by at most the crease angle get their mean, weighted by corner
/// angles. A normal that would look away from its face gives way to the face's: oriented_face_normal() with
/// Normals::transfer, else the face as it is wound. Normals::flat clusters as Normals::smooth does.
/// O(corners), for bounded numbers of creases per vertex
CornerNormals make_normals(const BakePart& part, const BakeOptions& options, Workers workers);

}  // namespace faqem::detail

#pragma once
/// \file
/// Normals at the corners of the simplified mesh.

#include <cstddef>

#include "bake/parts/corners.hpp"
#include "faqem/detail/base/parallel.hpp"
#include "faqem/detail/base/vector.hpp"

namespace faqem::detail {

/// Unit normal of a simplified face by its winding, reversed where CornerNormals::has_reversed_winding is
/// set. Zero if the face is degenerate. Complexity: O(1).
Vector3 oriented_face_normal(const BakePart& part, std::size_t face);

/// The mean of the normals at the corners of a simplified face, by barycentric weights; not of unit length.
/// Complexity: O(1).
Vector3 blended_normal(const BakePart& part, Index face, const Vec3& weights);

/// Whether the edge between two faces of consistent winding is a crease: the normals of both its vertices are
/// split along it.
/// \param corner        corner of `face` opposite the edge
/// \param other_corner  corner of `other` opposite the edge
bool is_crease(const CornerNormals& normals, std::size_t face, std::size_t corner, std::size_t other,
               std::size_t other_corner);

/// Computes the normals of a simplified part according to BakeOptions::normals.
/// Unless they are smooth or flat, the normal of a corner is that of the source (of its face, if it has no normals) at
/// a point slightly inside the simplified face, or at a third of its height, if that is on another facet with a normal
/// closer to the face's; with Normals::smooth it is the normal of the simplified face.
/// Corners of a vertex whose normals differ by at most the crease angle get their mean, weighted by corner
/// angle times face area; those on different facets of the source (normal_facets()) do not, if the facets are as large
/// as the faces. If they are on one facet, their normal is then fitted, by least squares, to those of the source at three
/// points of each face. A normal that is not within 90 degrees of the face normal is replaced by the latter, which is
/// oriented_face_normal() with Normals::transfer, and otherwise given by the winding. Where the normals of the source
/// are more than 60 degrees from its faces, those of the result may be farther from its faces.
/// With Normals::automatic, unless the kind makes an atlas, all corners of a vertex on a facet on which the source has one
/// normal at each position get their mean, whatever their angle.
/// Normals::flat has the clusters of Normals::smooth, but keeps the face normals.
/// Complexity: O(corners) for a bounded number of creases per vertex.
/// \param part  its normals are not used
CornerNormals make_normals(const BakePart& part, const BakeOptions& options, const RunContext& context);

}  // namespace faqem::detail

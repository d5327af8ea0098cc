#pragma once
/// \file
/// Polygons of a file to triangles.

#include <cstdint>
#include <span>
#include <vector>

#include "faqem/mesh.hpp"

namespace faqem::detail {

/// Splits one polygon into size - 2 triangles that use all its corners and keep its winding. A convex polygon
/// becomes a fan around corner 0; another is cut by ear clipping in the plane of its Newell normal, so that
/// triangles stay inside and do not overlap, as long as the polygon's projection does not cross itself. A
/// polygon that does is split all the same, without that promise.
/// \param ring  positions of the corners in order; may be of any size and scale
/// \param triangles  receives corner numbers, 0 .. ring.size() - 1
/// Complexity: linear for convex polygons; about n log n for others, n^2 for the worst.
/// Source: Meisters, "Polygons have ears", 1975.
void triangulate(std::span<const Vec3> ring, std::vector<Triangle>& triangles);

/// Polygons as a file lists them.
struct Polygons {
    std::vector<Index> vertices;       ///< corners of all polygons, one after the other
    std::vector<std::uint32_t> sizes;  ///< corners of each polygon
};

/// Triangles made of polygons, and what could not be.
struct TriangulatedPolygons {
    std::vector<Triangle> triangles;
    std::vector<Index> source_polygon;  ///< which polygon each triangle comes from
    std::uint64_t too_few_corners = 0;  ///< polygons of fewer than three corners, left out
    std::uint64_t non_finite = 0;       ///< polygons with a corner at infinity or NaN, left out
};

/// Splits all polygons in their order.
/// \param polygons   indices below positions.size()
/// \param positions  of the vertices
TriangulatedPolygons triangulate_polygons(const Polygons& polygons, std::span<const Vec3> positions);

}  // namespace faqem::detail

#pragma once
/// \file
/// Triangulation of polygons.

#include <cstdint>
#include <span>
#include <vector>

#include "faqem/mesh.hpp"

namespace faqem::detail {

/// Splits a polygon into size - 2 triangles that use all corners and keep the winding.
///
/// A convex polygon becomes a fan around corner 0. Other polygons are projected along the dominant axis of
/// their Newell normal and split by ear clipping. The triangles lie inside the polygon and do not overlap if
/// the projected polygon does not intersect itself; otherwise there is no such guarantee.
/// Complexity: O(n) for convex polygons. For others O(n log n) if few corners are near the boundary of most
/// triangles, whether or not the polygon intersects itself or has clustered or repeated positions; O(n sqrt n) for
/// stars with long, narrow spikes.
/// Source: Meisters, "Polygons have ears", 1975.
/// \param ring       positions of the corners in order; of any number and scale
/// \param triangles  the triangles are appended, as corner indices in [0, ring.size())
void triangulate(std::span<const Vec3> ring, std::vector<Triangle>& triangles);

/// Polygons as a file lists them.
struct Polygons {
    std::vector<Index> vertices;       ///< vertices of the corners of all polygons, concatenated
    std::vector<std::uint32_t> sizes;  ///< number of corners of each polygon
};

/// Result of triangulate_polygons().
struct TriangulatedPolygons {
    std::vector<Triangle> triangles;
    std::vector<Index> source_polygon;  ///< index of the polygon of each triangle
    std::uint64_t too_few_corners = 0;  ///< number of polygons with fewer than three corners, left out
    std::uint64_t non_finite = 0;       ///< number of polygons with a non-finite position, left out
};

/// Triangulates all polygons in order.
/// \param polygons   vertex indices less than positions.size()
/// \param positions  positions of the vertices
TriangulatedPolygons triangulate_polygons(const Polygons& polygons, std::span<const Vec3> positions);

}  // namespace faqem::detail

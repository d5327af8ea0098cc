#pragma once
/// \file
/// The triangles of a page, and the charts that are made from them.

#include <array>
#include <vector>

#include "bake/atlas/point2.hpp"
#include "bake/atlas/triangle_pairs.hpp"
#include "faqem/detail/base/vector.hpp"
#include "faqem/mesh.hpp"

namespace faqem::detail {

/// A triangle to be placed on a page.
struct PageTriangle {
    std::array<Vec3, 3> corners = {};
    double density = 1;  ///< wanted texels per unit of length, > 0
    /// By corner opposite the edge. Symmetric: neighbours name each other. Their winding is consistent.
    std::array<AdjacentTriangle, 3> adjacent = {};
    /// By corner opposite the edge: the vertices are split along the edge in any case, so there is no benefit
    /// in keeping it inside a chart.
    std::array<bool, 3> crease = {};
};

/// A connected set of faces with an injective map to the plane. All triangles are counter-clockwise.
struct Chart {
    std::vector<Index> faces;  ///< ascending
    /// By face: its three corners, in texels at the wanted density, x to the right, y up.
    std::vector<Triangle2> points;
    /// Area-weighted mean over the faces of (s1^2 + s2^2 + 1/s1^2 + 1/s2^2) / 4, where s1 and s2 are the
    /// singular values of the face's map when the chart has the wanted area. 1 means no distortion.
    /// Symmetric Dirichlet energy (Smith and Schaefer 2015).
    double stretch = 1;
    double texels = 0;  ///< wanted number of texels: sum of area times density squared
};

/// Normal of a triangle by its winding, with twice the area as length.
inline Vector3 area_vector(const PageTriangle& t) {
    return engine::area_vector(to_eigen(t.corners[0]), to_eigen(t.corners[1]), to_eigen(t.corners[2]));
}

/// Wanted number of texels of a face: its area times its density squared.
inline double wanted_texels(const PageTriangle& face) {
    return area_vector(face).norm() / 2 * face.density * face.density;
}

}  // namespace faqem::detail

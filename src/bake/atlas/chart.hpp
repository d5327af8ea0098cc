#pragma once
/// \file
/// What the chart atlas must know of a triangle, and a chart.

#include <array>
#include <complex>
#include <cstdint>
#include <vector>

#include "bake/atlas/triangle_pairs.hpp"
#include "faqem/mesh.hpp"

namespace faqem::detail {

/// A triangle that wants a place in a chart.
struct ChartFace {
    std::array<Vec3, 3> corners = {};
    double density = 1;                             ///< wanted texels per length, > 0
    std::array<AdjacentTriangle, 3> adjacent = {};  ///< by corner opposite the edge; mutual, wound alike
    /// By edge: vertices are split along it in any case, so nothing is won by laying it inside a chart.
    std::array<bool, 3> crease = {};
};

/// A point of a chart: x right, y up, in wanted texels.
using ChartPoint = std::complex<double>;

/// Faces that lie in one piece on the page. Every triangle turns counter-clockwise there, none lies on
/// another.
struct Chart {
    std::vector<Index> faces;                       ///< ascending
    std::vector<std::array<ChartPoint, 3>> points;  ///< by face, its three corners
    /// Mean over the area of (s1^2 + s2^2 + 1/s1^2 + 1/s2^2) / 4, s1 and s2 the stretches of a face when the
    /// chart has the area that is wanted. 1: none. Symmetric Dirichlet energy (Smith and Schaefer 2015).
    double stretch = 1;
    double texels = 0;  ///< wanted: sum of area times density squared
};

/// Of a face: its area times its density squared.
double wanted_texels(const ChartFace& face);

/// Twice the signed area.
inline double twice_signed_area(const ChartPoint& a, const ChartPoint& b, const ChartPoint& c) {
    return (std::conj(b - a) * (c - a)).imag();
}

}  // namespace faqem::detail

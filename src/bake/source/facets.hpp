#pragma once
/// \file
/// Sets of faces between edges at which the source looks different: facets, between vertices that are split by normals or
/// colours, and regions, between jumps of the appearance.

#include <cstdint>
#include <functional>
#include <vector>

#include "faqem/asset.hpp"
#include "faqem/surface_map.hpp"

namespace faqem::detail {

/// Sets of faces that are connected by vertices with about the same value: the surface is shown with an edge where two of
/// them meet.
struct Facets {
    std::vector<Index> of_face;             ///< by face; empty if the part has no such values
    std::vector<double> areas;              ///< by facet
    std::vector<std::uint8_t> is_seamless;  ///< by facet: it has one value at each position
};

/// The facets of a part by its normals. Complexity: O(n) expected.
Facets normal_facets(const Part& part);

/// The facets of a part by its colours. Complexity: O(n) expected.
Facets color_facets(const Part& part);

/// The texels per unit of length with which a page shows regions of a part: sets of faces between edges at which the
/// appearance jumps, as at the borders of materials and of the cells of a palette. Texels mix the appearance of both
/// sides at such edges; with these densities the larger share of each region is farther from them than a texel.
/// Densities of textures do not tell: UVs may cover a spot of a palette.
/// \param differs  whether the appearance differs between two points
/// \return by face, 0 where no such edge bounds the region; empty if there is none, or if too few vertices are split for
///         regions to be small
/// Complexity: O(n log n).
std::vector<float> region_densities(
    const Part& part, const std::function<bool(const SurfacePoint&, const SurfacePoint&)>& differs);

}  // namespace faqem::detail

#pragma once
/// \file
/// Regions of a surface whose appearance jumps where they meet.

#include <functional>
#include <vector>

#include "faqem/asset.hpp"
#include "faqem/surface_map.hpp"

namespace faqem::detail {

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

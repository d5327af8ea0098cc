#pragma once
/// \file
/// How a face count for a whole asset is spread over its parts.

#include <cstdint>
#include <span>
#include <vector>

#include "faqem/asset.hpp"

namespace faqem::detail {

/// In proportion to the parts' faces, by largest remainder. Where there is room for them, a part gets no
/// fewer than 4 faces (or all it has) for each of its connected components, at the others' cost; else no
/// fewer than 4.
/// \return per part; their sum is above `goal` only where the parts' 4 faces each are.
/// O(faces)
std::vector<std::uint64_t> budget_by_faces(const Asset& asset, std::uint64_t goal);

/// How much a squared distance times an area in a part's own units counts in the scene: lengths scale with
/// the part's instances, and what is seen twice counts twice. 1 for what has no size there.
/// \param parts  how many there are
std::vector<double> cost_weights(std::size_t parts, std::span<const Instance> instances);

}  // namespace faqem::detail

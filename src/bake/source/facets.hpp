#pragma once
/// \file
/// Facets of the source: where its vertices are split by normals or colours.

#include <cstdint>
#include <vector>

#include "faqem/asset.hpp"

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

}  // namespace faqem::detail

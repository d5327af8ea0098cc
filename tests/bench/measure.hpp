#pragma once
/// \file
/// Measures of a simplified mesh in addition to faqem::compare() and faqem::info().

#include <cstdint>
#include <optional>

#include "faqem/mesh.hpp"

namespace faqem::bench {

/// Returns the number of edges with exactly two faces whose consistently oriented normals have a dot product
/// below
/// -0.9. Equal positions are not welded. Faces of zero area are ignored. Complexity: O(n log n).
std::uint64_t foldovers(const TriangleMesh& mesh);

/// Returns the number of faces with two equal corners or a height below 1e-12 of their longest edge.
std::uint64_t flat_faces(const TriangleMesh& mesh);

/// Returns the two-sided maximum distance between the boundaries of two meshes (edges with one face), model
/// units. It is measured at the boundary vertices and at about `samples` points per direction, evenly
/// distributed along the boundary. Nothing if one of the meshes has no boundary.
std::optional<double> border_hausdorff(const TriangleMesh& a, const TriangleMesh& b, std::size_t samples);

}  // namespace faqem::bench

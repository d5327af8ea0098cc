#pragma once
/// \file
/// What faqem::compare and faqem::info do not tell about a simplified mesh.

#include <cstdint>
#include <optional>

#include "faqem/mesh.hpp"

namespace faqem::bench {

/// Edges with exactly two faces whose normals have a dot product below -0.9, both seen from the same side.
/// Equal positions are different vertices here. Faces without area are passed over. O(n log n)
std::uint64_t foldovers(const TriangleMesh& mesh);

/// Faces with two equal corners, or lower than 1e-12 of their longest edge.
std::uint64_t flat_faces(const TriangleMesh& mesh);

/// Largest distance between the open borders of two meshes (edges with one face), both ways, in model units;
/// at the borders' vertices and at `samples` places a side, evenly along them. Nothing if either has none.
std::optional<double> border_hausdorff(const TriangleMesh& a, const TriangleMesh& b, std::size_t samples);

}  // namespace faqem::bench

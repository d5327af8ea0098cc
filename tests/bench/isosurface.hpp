#pragma once
/// \file
/// Generator of large meshes of any size that resemble scanned surfaces.

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <random>
#include <utility>
#include <vector>

#include "faqem/mesh.hpp"

namespace faqem::bench {

/// Generates an isosurface of about unit size: a sphere with fractal noise (Musgrave: sum of noise at doubled
/// frequencies) and white noise of a fraction of a cell, which simulates a scanner. The surface is extracted
/// by marching tetrahedra in the Kuhn subdivision of a grid into six tetrahedra per cell. It is a closed
/// manifold without coincident vertices; the noise may create additional small components. Vertices and faces
/// are in scan-line order. The result depends only on the arguments, because only additions, multiplications
/// and square roots without fused operations are used. Complexity: O(faces) time and memory.
/// \param cells  cells along an edge of the grid, at least 8; the number of faces grows with its square
/// \param seed   seed of the noise
TriangleMesh isosurface(std::uint32_t cells, std::uint64_t seed);

/// Generates an isosurface with approximately `faces` faces (within a few percent for ten thousand and more).
TriangleMesh isosurface_of(std::size_t faces, std::uint64_t seed);

/// Permutes the vertices randomly. The order of the faces is preserved.
template <class Position>
void shuffle(std::vector<Position>& positions, std::vector<Triangle>& triangles, std::uint64_t seed) {
    std::vector<Index> number(positions.size());
    std::iota(number.begin(), number.end(), Index{0});
    std::mt19937_64 random(seed);
    for (std::size_t i = number.size(); i > 1; --i) std::swap(number[i - 1], number[random() % i]);
    const std::vector<Position> old = positions;
    for (std::size_t v = 0; v < number.size(); ++v) positions[number[v]] = old[v];
    for (Triangle& t : triangles) {
        for (Index& v : t) v = number[v];
    }
}

}  // namespace faqem::bench

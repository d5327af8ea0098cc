#pragma once
/// \file
/// Large meshes to measure with: a surface as scanners and marching cubes make them, in any size.

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <random>
#include <utility>
#include <vector>

#include "faqem/mesh.hpp"

namespace faqem::bench {

/// A lump of about unit size under fractal noise (Musgrave: sums of noise at doubled frequencies), whose
/// field is also off by white noise of a fraction of a cell, as a scan is. Marching tetrahedra over the
/// six-fold Kuhn subdivision of a grid make a closed manifold of it, without vertices at equal places; specks
/// that noise sets beside it may be there.
/// Vertices and faces are in the order in which a sweep over the grid meets them. The same for the same
/// arguments: additions, multiplications and square roots alone, without fused ones.
/// \param cells  along a side of the grid, at least 8; the number of faces grows with its square
/// O(faces) time and memory
TriangleMesh isosurface(std::uint32_t cells, std::uint64_t seed);

/// An isosurface of about this many faces (within a few percent from ten thousand on).
TriangleMesh isosurface_of(std::size_t faces, std::uint64_t seed);

/// Numbers the vertices at random; the faces keep their order.
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

#pragma once
/// \file
/// Sheets of a triangle soup, and which of their faces are wound the wrong way round.

#include <cstdint>
#include <span>
#include <vector>

#include "faqem/engine/poll.hpp"
#include "faqem/mesh.hpp"

namespace faqem::detail {

/// Components over edges with exactly two faces. Edges with more faces divide sheets, so that the two sides
/// of a thin wall that touch in a fin stay apart; but two faces that had such an edge to themselves before
/// vertices were joined stay together. So two boxes that touch in a full side stay whole.
struct Sheets {
    std::vector<Index> sheet;       ///< per face; no_index for faces with a corner no_index
    std::vector<std::int8_t> sign;  ///< per face: -1 where it is wound against most of its sheet (by area)
};

/// \param positions  one per vertex
/// \param triangles  faces with a corner no_index are left out
/// \param unwelded   empty, or the faces as they were before vertices at one place were joined
/// O(n log n) time, 48 bytes per face while it runs.
/// \throws what the poll throws
Sheets find_sheets(std::span<const Vec3> positions, std::span<const Triangle> triangles,
                   std::span<const Triangle> unwelded = {}, engine::Poll poll = {});

}  // namespace faqem::detail

#pragma once
/// \file
/// Points of the source near the corners of the simplified mesh, without a SurfaceMap.

#include <cstdint>
#include <functional>

#include "bake/parts/corners.hpp"
#include "faqem/detail/base/parallel.hpp"
#include "faqem/surface_map.hpp"

namespace faqem::detail {

/// Finds the point of the source that is closest to a point near each corner of the simplified mesh, as
/// barycentrics_near_corner() gives it. It is on a face with a corner that was collapsed into the vertex of the
/// simplified corner, of the same group, and at most 80 degrees from the simplified face. BakePart::map gives the same
/// point unless it is on a face of another vertex or of another surface patch, but takes longer to prepare.
/// \param part          its map is not used
/// \param inset         see barycentrics_near_corner()
/// \param visit         called once for each corner that has a point, concurrently
/// \throws whatever `context` throws
/// O(n log n) in the faces of both meshes
void visit_corner_points(const BakePart& part, double inset, const RunContext& context,
                         const std::function<void(std::uint64_t corner, const SurfacePoint& point)>& visit);

}  // namespace faqem::detail

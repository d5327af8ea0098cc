#pragma once
/// \file
/// Which pages get a normal map, and the tangents that go with it.

#include <span>
#include <vector>

#include "bake/texture/bake_job.hpp"
#include "bake/texture/page_atlas.hpp"

namespace faqem::detail {

/// Whether a page gets a normal map: as BakeOptions::normal_map says. O(faces)
/// \param faces  of the page
bool wants_normal_map(const BakeJob& job, const MaterialGroup& group, std::span<const PageFace> faces);

/// How much the normals that the original is lit with, its normal maps left aside, differ from those of the
/// simplified mesh: mean angle in degrees over the faces by area, at four places of each. O(faces)
double normal_deviation(const BakeJob& job, std::span<const PageFace> faces);

/// Gives the corners of some faces of a simplified mesh tangents (MikkTSpace).
/// \param faces     of the simplified mesh; they have one material
/// \param uvs       by corner of the simplified mesh
/// \param tangents  by corner of the simplified mesh; made so long if it is empty
void set_tangents(const BakePart& part, const CornerNormals& normals, std::span<const Index> faces,
                  std::span<const Vec2f> uvs, CancellationCheck check_cancelled,
                  std::vector<Vec4f>& tangents);

}  // namespace faqem::detail

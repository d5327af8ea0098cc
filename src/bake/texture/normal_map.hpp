#pragma once
/// \file
/// Which pages get a normal map, and the tangents for it.

#include <span>
#include <vector>

#include "bake/texture/bake_job.hpp"
#include "bake/texture/page_atlas.hpp"

namespace faqem::detail {

/// Whether a page gets a normal map, according to BakeOptions::normal_map.
/// \param group  the materials of the page
/// \param faces  the faces of the page
/// Complexity: O(faces).
bool wants_normal_map(const BakeJob& job, const MaterialGroup& group, std::span<const PageFace> faces);

/// Normal deviation: mean angle, in degrees, between the shading normals of the original (without its normal
/// maps) and those of the simplified mesh. Weighted by face area, and measured at four points of every face.
/// Complexity: O(faces).
double normal_deviation(const BakeJob& job, std::span<const PageFace> faces);

/// Computes tangents (MikkTSpace) at the corners of some faces of a simplified mesh.
/// \param faces     indices of faces of the simplified mesh, all of one material
/// \param uvs       by corner of the simplified mesh
/// \param tangents  by corner of the simplified mesh; resized if it is shorter
void set_tangents(const BakePart& part, const CornerNormals& normals, std::span<const Index> faces,
                  std::span<const Vec2f> uvs, std::vector<Vec4f>& tangents);

}  // namespace faqem::detail

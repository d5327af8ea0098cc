#pragma once
/// \file
/// Which pages get a normal map, and the tangents for it.

#include <span>
#include <vector>

#include "bake/page/page_mesh.hpp"
#include "bake/parts/corners.hpp"
#include "faqem/detail/base/parallel.hpp"
#include "scene/material_groups.hpp"

namespace faqem::detail {

/// Whether a page gets a normal map, according to BakeOptions::normal_map.
/// \param choice  BakeOptions::normal_map
/// \param source  has the materials
/// \param group   the materials of the page
/// \param parts   those of the faces have maps and normals
/// \param faces   the faces of the page
/// Complexity: O(faces) map queries.
bool wants_normal_map(NormalMap choice, const Asset& source, const MaterialGroup& group,
                      std::span<const BakePart> parts, std::span<const PageFace> faces,
                      const RunContext& context);

/// Normal deviation: root mean square of the difference between the unit shading normals of the original (without its
/// normal maps) and those of the simplified mesh, in degrees. Its square is three times the mean squared error of diffuse
/// shading under lights from all directions: a few wrong faces are seen more than the same sum of angles all over the
/// page. Weighted by face area, and measured at four points of every face.
/// Complexity: O(faces) map queries.
double normal_deviation(std::span<const BakePart> parts, std::span<const PageFace> faces,
                        const RunContext& context);

/// Computes tangents (MikkTSpace) at the corners of some faces of a simplified mesh.
/// \param part      has normals
/// \param faces     indices of faces of the simplified mesh, all of one material
/// \param uvs       by corner of the simplified mesh
/// \param tangents  by corner of the simplified mesh; resized if it is shorter
void set_tangents(const BakePart& part, std::span<const Index> faces, std::span<const Vec2f> uvs,
                  std::vector<Vec4f>& tangents);

}  // namespace faqem::detail

#pragma once
/// \file
/// Output parts from the corners of simplified meshes.

#include <span>
#include <vector>

#include "bake/parts/corners.hpp"
#include "faqem/engine/util/run_context.hpp"

namespace faqem::detail {

/// Makes an output part from a simplified mesh: welds the corners, and transfers what depends on no texture, the
/// custom attributes, skin weights and morph targets.
/// \param values     UVs, colours and tangents; the normals are those of the part
/// \param materials  by face
/// \throws whatever `context` throws
/// Complexity: O(corners log valence), and O(corners) map queries if there is something to transfer
Part make_output_part(const BakePart& part, CornerValues values, std::vector<Index> materials,
                      const engine::RunContext& context);

/// The material of each of some faces of a part.
std::vector<Index> materials_of_faces(const Part& part, std::span<const Index> faces);

/// By face of the simplified mesh: the material of the source face that it was.
std::vector<Index> remaining_materials(const BakePart& part);

/// By part: BakePart::is_kept.
std::vector<std::uint8_t> kept_flags(std::span<const BakePart> parts);

}  // namespace faqem::detail

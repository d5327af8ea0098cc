#include "bake/parts/output_part.hpp"

#include <utility>

#include "bake/parts/vertex_attributes.hpp"
#include "scene/material_groups.hpp"

namespace faqem::detail {

Part make_output_part(const BakePart& part, CornerValues values, std::vector<Index> materials,
                      const engine::RunContext& context) {
    if (part.writes_normals || !values.tangents.empty()) values.normals = part.normals.normals;
    values.custom_attributes = corner_custom_attributes(part, context);
    WeldedPart welded = weld_corners(part, values);
    transfer_skin_and_morphs(part, welded, context);
    welded.part.face_material = std::move(materials);
    return std::move(welded.part);
}

std::vector<Index> materials_of_faces(const Part& part, std::span<const Index> faces) {
    std::vector<Index> result;
    result.reserve(faces.size());
    for (const Index f : faces) result.push_back(face_material(part, f));
    return result;
}

std::vector<Index> remaining_materials(const BakePart& part) {
    return materials_of_faces(*part.source, part.simplified->history.remaining_faces);
}

std::vector<std::uint8_t> kept_flags(std::span<const BakePart> parts) {
    std::vector<std::uint8_t> result;
    for (const BakePart& part : parts) result.push_back(part.is_kept ? 1 : 0);
    return result;
}

}  // namespace faqem::detail

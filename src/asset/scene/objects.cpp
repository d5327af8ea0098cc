#include "asset/scene/objects.hpp"

#include <algorithm>

#include "asset/scene/part_arrays.hpp"

namespace faqem::detail {
namespace {

/// The part with the given faces, in their order, and with the vertices that they use.
/// \param number  by vertex of the part: scratch memory, no_index everywhere before and after
Part with_faces(const Part& part, const std::vector<Index>& faces, std::vector<Index>& number) {
    std::vector<Index> vertices, corners;
    number_corners(part, faces, number, vertices, corners);
    Part result;
    for (std::size_t c = 0; c < corners.size(); c += 3)
        result.triangles.push_back({corners[c], corners[c + 1], corners[c + 2]});
    for (const FaceArray& array : face_arrays) {
        if (array.values == object_array.values) continue;
        const std::vector<Index> values = gather(part.*array.values, faces);
        if (array.names)
            set_face_names(result, array, values, part.*array.names);
        else
            result.*array.values = values;
    }
    select_vertices(part, vertices, result);
    result.custom_attributes.clear();  // formats that have objects have none
    result.position_spacing = part.position_spacing;
    result.file_order = part.file_order;
    return result;
}

}  // namespace

std::optional<DividedAsset> divided_into_objects(const Asset& asset) {
    const auto has_objects = [](const Part& part) { return !part.face_object.empty(); };
    if (std::ranges::none_of(asset.parts, has_objects)) return std::nullopt;
    DividedAsset result;
    Asset& divided = result.asset;
    divided.materials = asset.materials;
    divided.images = asset.images;
    divided.source = asset.source;
    divided.precision = asset.precision;
    divided.compression = asset.compression;
    divided.normal_bits = asset.normal_bits;
    divided.uv_bits = asset.uv_bits;
    divided.warnings = asset.warnings;
    for (std::size_t p = 0; p < asset.parts.size(); ++p) {
        const Part& part = asset.parts[p];
        if (!has_objects(part)) {
            divided.parts.push_back(part);
            result.part.push_back(p);
            continue;
        }
        std::vector<std::vector<Index>> faces(part.object_names.size() + 1);  // the last one: the part itself
        for (Index f = 0; f < part.face_object.size(); ++f)
            faces[std::min<std::size_t>(part.face_object[f], part.object_names.size())].push_back(f);
        std::vector<Index> number(part.positions.size(), no_index);
        for (std::size_t object = 0; object < faces.size(); ++object) {
            const bool is_part = object == part.object_names.size();
            if (is_part && faces[object].empty()) continue;
            divided.parts.push_back(with_faces(part, faces[object], number));
            divided.parts.back().name = is_part ? part.name : part.object_names[object];
            if (is_part) divided.parts.back().source = part.source;
            result.part.push_back(p);
        }
    }
    return result;
}

}  // namespace faqem::detail

#include "asset/scene/objects.hpp"

#include <algorithm>
#include <map>
#include <utility>

namespace faqem::detail {
namespace {

/// Copies the values of some vertices; nothing if the part has no such values.
template <class Value>
void copy_vertices(std::vector<Value>& to, const std::vector<Value>& from,
                   const std::vector<Index>& vertices) {
    if (from.empty()) return;
    to.reserve(vertices.size());
    for (const Index v : vertices) to.push_back(from[v]);
}

/// The groups of some faces of a part, with the names of these groups only.
void copy_groups(const Part& part, const std::vector<Index>& faces, Part& to) {
    if (part.face_group.empty()) return;
    std::map<Index, Index> number;
    for (const Index f : faces) {
        const Index group = part.face_group[f];
        if (group == no_index) {
            to.face_group.push_back(no_index);
            continue;
        }
        const auto [entry, is_new] = number.try_emplace(group, static_cast<Index>(to.group_names.size()));
        if (is_new) to.group_names.push_back(part.group_names[group]);
        to.face_group.push_back(entry->second);
    }
}

/// The part with the given faces, in their order, and with the vertices that they use.
/// \param number  by vertex of the part: scratch memory, no_index everywhere before and after
Part with_faces(const Part& part, const std::vector<Index>& faces, std::vector<Index>& number) {
    std::vector<Index> vertices;
    for (const Index f : faces) {
        for (const Index v : part.triangles[f]) {
            if (number[v] != no_index) continue;
            number[v] = 0;
            vertices.push_back(v);
        }
    }
    std::sort(vertices.begin(), vertices.end());
    for (std::size_t i = 0; i < vertices.size(); ++i) number[vertices[i]] = static_cast<Index>(i);
    Part result;
    for (const Index f : faces) {
        Triangle t = part.triangles[f];
        for (Index& v : t) v = number[v];
        result.triangles.push_back(t);
        if (!part.face_material.empty()) result.face_material.push_back(part.face_material[f]);
    }
    copy_groups(part, faces, result);
    for (const Index v : vertices) number[v] = no_index;
    copy_vertices(result.positions, part.positions, vertices);
    copy_vertices(result.normals, part.normals, vertices);
    copy_vertices(result.tangents, part.tangents, vertices);
    copy_vertices(result.colors, part.colors, vertices);
    copy_vertices(result.joints, part.joints, vertices);
    copy_vertices(result.weights, part.weights, vertices);
    result.uvs.resize(part.uvs.size());
    for (std::size_t set = 0; set < part.uvs.size(); ++set)
        copy_vertices(result.uvs[set], part.uvs[set], vertices);
    result.morph_targets.resize(part.morph_targets.size());
    for (std::size_t m = 0; m < part.morph_targets.size(); ++m) {
        copy_vertices(result.morph_targets[m].positions, part.morph_targets[m].positions, vertices);
        copy_vertices(result.morph_targets[m].normals, part.morph_targets[m].normals, vertices);
    }
    result.position_spacing = part.position_spacing;
    result.file_order = part.file_order;
    return result;
}

}  // namespace

std::optional<DividedAsset> divided_into_objects(const Asset& asset) {
    const auto has_objects = [](const Part& part) { return !part.face_object.empty(); };
    if (std::none_of(asset.parts.begin(), asset.parts.end(), has_objects)) return std::nullopt;
    DividedAsset result;
    Asset& divided = result.asset;
    divided.materials = asset.materials;
    divided.images = asset.images;
    divided.source = asset.source;
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

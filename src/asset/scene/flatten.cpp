#include "asset/scene/flatten.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "asset/scene/affine.hpp"
#include "asset/scene/part_arrays.hpp"
#include "asset/scene/repair.hpp"

namespace faqem::detail {
namespace {

/// Appends an array by vertex, if there is one. Earlier vertices without a value get the neutral one.
/// \param first  number of these vertices
template <class Value>
void append(std::vector<Value>& to, const std::vector<Value>& values, Index first, const Value& neutral) {
    if (values.empty()) return;
    to.resize(first, neutral);
    to.insert(to.end(), values.begin(), values.end());
}

/// Appends an array by face, with its names. Faces of other parts have no_index. Objects are not kept.
void append_faces(Part& flat, const Part& part, const FaceArray& array) {
    const std::vector<Index>& values = part.*array.values;
    if (values.empty() || array.values == object_array.values) return;
    Index first_name = 0;
    if (array.names) {
        std::vector<std::string>& names = flat.*array.names;
        first_name = static_cast<Index>(names.size());
        names.insert(names.end(), (part.*array.names).begin(), (part.*array.names).end());
    }
    std::vector<Index>& to = flat.*array.values;
    to.resize(flat.triangles.size() - part.triangles.size(), no_index);
    for (const Index value : values) to.push_back(value == no_index ? no_index : first_name + value);
}

void append(Part& flat, const Part& part, const Matrix4& m) {
    const auto first = static_cast<Index>(flat.positions.size());
    const bool is_identity = m == identity_transform;
    const NormalTransform normal_transform(m);
    for (const Vec3& p : part.positions) flat.positions.push_back(is_identity ? p : transformed_point(m, p));
    append(flat.normals, part.normals, first, {0, 0, 0});
    for (std::size_t v = first; v < flat.normals.size() && !is_identity; ++v)
        flat.normals[v] = normal_transform(flat.normals[v]);
    append(flat.colors, part.colors, first, {1, 1, 1, 1});
    flat.uvs.resize(std::max(flat.uvs.size(), part.uvs.size()));
    for (std::size_t set = 0; set < part.uvs.size(); ++set)
        append(flat.uvs[set], part.uvs[set], first, {0, 0});
    for (const Triangle& t : part.triangles) {
        const bool is_mirrored = normal_transform.is_mirrored();
        flat.triangles.push_back(
            {first + t[0], first + t[is_mirrored ? 2 : 1], first + t[is_mirrored ? 1 : 2]});
    }
    for (const FaceArray& array : face_arrays) append_faces(flat, part, array);
}

/// Turns a part from y up to z up and moves it.
void place(Part& flat, const Vec3& center) {
    for (Vec3& p : flat.positions) p = {center[0] + p[0], center[1] - p[2], center[2] + p[1]};
    for (Vec3f& n : flat.normals) n = {n[0], -n[2], n[1]};
}

std::size_t uninstanced_part_count(const Asset& asset) {
    std::vector<std::uint8_t> is_uninstanced;
    for (const Part& part : asset.parts) is_uninstanced.push_back(!part.triangles.empty());
    for (const Instance& instance : instances(asset)) is_uninstanced[instance.part] = 0;
    return static_cast<std::size_t>(std::ranges::count(is_uninstanced, 1));
}

bool has_morph_weights(const Asset& asset) {
    return std::ranges::any_of(posed_instances(asset), [](const PosedInstance& instance) {
        return instance.pose && !instance.pose->morph_weights.empty();
    });
}

}  // namespace

Part flatten(const Asset& asset) { return flatten(asset, posed_instances(asset)); }

Part flatten(const Asset& asset, const std::vector<PosedInstance>& all) {
    Part flat;
    std::uint64_t vertices = 0, faces = 0;
    for (const PosedInstance& instance : all) {
        const Part& part = asset.parts[instance.part];
        vertices += part.positions.size();
        faces += part.triangles.size();
    }
    check_index_count(vertices, "", "vertices of the flattened scene");
    check_index_count(faces, "", "faces of the flattened scene");
    flat.positions.reserve(vertices);
    flat.triangles.reserve(faces);
    for (const PosedInstance& instance : all) {
        const Part& part = asset.parts[instance.part];
        if (instance.pose)
            append(flat, posed_part(part, instance), identity_transform);
        else
            append(flat, part, instance.transform);
    }
    if (!flat.normals.empty()) flat.normals.resize(vertices, {0, 0, 0});
    if (!flat.colors.empty()) flat.colors.resize(vertices, {1, 1, 1, 1});
    for (std::vector<Vec2f>& uvs : flat.uvs) uvs.resize(vertices, {0, 0});
    if (const std::optional<Vec3> center = scene_center(asset)) place(flat, *center);
    flat.face_material.resize(faces, no_index);
    for (const FaceArray& array : face_arrays)
        if (!(flat.*array.values).empty()) (flat.*array.values).resize(faces, no_index);
    if (all.size() == 1) flat.name = asset.parts[all[0].part].name;
    return flat;
}

std::vector<std::string> flattening_losses(const Asset& asset, const std::string& format) {
    std::vector<std::string> losses;
    const std::string cannot = format + " cannot hold ";
    if (asset.source)
        losses.push_back(
            cannot + "a scene: all meshes are transformed to world space, the rest of the scene is left out");
    if (const std::size_t uninstanced = uninstanced_part_count(asset))
        losses.push_back("no node of the scene references " + std::to_string(uninstanced) +
                         (uninstanced == 1 ? " mesh, which was left out" : " meshes, which were left out"));
    if (some_part_has(asset, &Part::joints))
        losses.push_back(cannot + "skins: the meshes are posed by their joints");
    if (some_part_has(asset, &Part::morph_targets))
        losses.push_back(cannot + "morph targets" +
                         (has_morph_weights(asset) ? ": the meshes have their default weights" : ""));
    if (some_part_has(asset, &Part::custom_attributes)) losses.push_back(cannot + "custom attributes");
    if (some_part_has(asset, &Part::tangents)) losses.push_back(cannot + "tangents");
    return losses;
}

bool is_float_representable(const std::vector<Vec3>& positions) {
    return std::ranges::all_of(positions, [](const Vec3& p) {
        return std::ranges::all_of(p, [](double x) {
            return std::abs(x) <= std::numeric_limits<float>::max() &&
                   static_cast<double>(static_cast<float>(x)) == x;
        });
    });
}

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
    result.position_spacing = part.position_spacing;
    result.file_order = part.file_order;
    return result;
}

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

#include <algorithm>

#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "asset/gltf/accessor.hpp"
#include "asset/gltf/write/primitive_data.hpp"
#include "asset/gltf/write/writer.hpp"
#include "asset/scene/messages.hpp"
#include "asset/scene/repair.hpp"

namespace faqem::detail {
namespace {

template <class T>
std::span<const std::uint8_t> bytes_of(const std::vector<T>& values) {
    return {reinterpret_cast<const std::uint8_t*>(values.data()), values.size() * sizeof(T)};
}

Json accessor_description(ComponentType component, const char* type, std::size_t count) {
    return {{"componentType", static_cast<std::uint32_t>(component)}, {"type", type}, {"count", count}};
}

/// Adds min and max. They are written exactly, since readers compare them with the floats.
void add_bounds(Json& description, const std::vector<Vec3f>& values) {
    Vec3f low = values[0], high = values[0];
    for (const Vec3f& value : values)
        for (std::size_t i = 0; i < 3; ++i) {
            low[i] = std::min(low[i], value[i]);
            high[i] = std::max(high[i], value[i]);
        }
    for (std::size_t i = 0; i < 3; ++i) {
        low[i] += 0.0f;  // -0 becomes 0
        high[i] += 0.0f;
    }
    description["min"] = Json(low);
    description["max"] = Json(high);
}

template <class T>
Index add_vertices(GltfWriter& writer, Json description, const std::vector<T>& values,
                   AccessorUse use = AccessorUse::vertices) {
    return writer.binary.add_accessor(std::move(description), bytes_of(values), use);
}

Index add_positions(GltfWriter& writer, const std::vector<Vec3f>& values) {
    Json description = accessor_description(ComponentType::f32, "VEC3", values.size());
    add_bounds(description, values);
    return add_vertices(writer, std::move(description), values);
}

/// Writes colours as normalised 16-bit integers, since 8 bits are too few for linear colours; as floats if a
/// value is outside [0, 1].
Index add_colors(GltfWriter& writer, const std::vector<Vec4f>& colors) {
    const bool in_range = std::all_of(colors.begin(), colors.end(), [](const Vec4f& color) {
        return std::all_of(color.begin(), color.end(), [](float x) { return x >= 0 && x <= 1; });
    });
    if (!in_range)
        return add_vertices(writer, accessor_description(ComponentType::f32, "VEC4", colors.size()), colors);
    std::vector<std::array<std::uint16_t, 4>> integers(colors.size());
    for (std::size_t i = 0; i < colors.size(); ++i)
        for (std::size_t c = 0; c < 4; ++c)
            integers[i][c] = static_cast<std::uint16_t>(std::lround(colors[i][c] * 65535.0));
    Json description = accessor_description(ComponentType::u16, "VEC4", integers.size());
    description["normalized"] = true;
    return add_vertices(writer, std::move(description), integers);
}

Index add_joints(GltfWriter& writer, const std::vector<std::array<std::uint16_t, 4>>& joints) {
    const bool fits_u8 = std::all_of(joints.begin(), joints.end(), [](const auto& four) {
        return std::all_of(four.begin(), four.end(), [](std::uint16_t joint) { return joint < 256; });
    });
    if (!fits_u8)
        return add_vertices(writer, accessor_description(ComponentType::u16, "VEC4", joints.size()), joints);
    std::vector<std::array<std::uint8_t, 4>> bytes(joints.size());
    for (std::size_t i = 0; i < joints.size(); ++i)
        for (std::size_t c = 0; c < 4; ++c) bytes[i][c] = static_cast<std::uint8_t>(joints[i][c]);
    return add_vertices(writer, accessor_description(ComponentType::u8, "VEC4", bytes.size()), bytes);
}

/// Writes indices with 16 bits if they fit, else with 32 bits. The value 65535 is primitive restart.
Index add_indices(GltfWriter& writer, const PrimitiveData& data, AccessorUse use) {
    if (data.vertices.size() > 65535)
        return writer.binary.add_accessor(
            accessor_description(ComponentType::u32, "SCALAR", data.corners.size()), bytes_of(data.corners),
            use);
    const std::vector<std::uint16_t> indices(data.corners.begin(), data.corners.end());
    return writer.binary.add_accessor(accessor_description(ComponentType::u16, "SCALAR", indices.size()),
                                      bytes_of(indices), use);
}

/// Writes morph target displacements. If all are zero, no bytes are stored.
Index add_displacements(GltfWriter& writer, const std::vector<Vec3f>& values, bool with_bounds) {
    Json description = accessor_description(ComponentType::f32, "VEC3", values.size());
    if (with_bounds) add_bounds(description, values);
    if (std::all_of(values.begin(), values.end(), [](const Vec3f& v) { return v == Vec3f{}; }))
        return writer.binary.add_accessor(std::move(description), {}, AccessorUse::vertices);
    return add_vertices(writer, std::move(description), values);
}

Json write_morph_targets(GltfWriter& writer, const Part& part, const PrimitiveData& data) {
    Json targets = Json::array();
    for (const MorphTarget& target : part.morph_targets) {
        Json json = Json::object();
        const std::vector<Vec3f> positions = target.positions.empty()
                                                 ? std::vector<Vec3f>(data.vertices.size(), Vec3f{})
                                                 : gather(target.positions, data.vertices);
        json["POSITION"] = add_displacements(writer, positions, true);
        if (!target.normals.empty() && !data.normals.empty())
            json["NORMAL"] = add_displacements(writer, gather(target.normals, data.vertices), false);
        targets.push_back(std::move(json));
    }
    return targets;
}

template <class T>
Index add_integers(GltfWriter& writer, const CustomAttribute& attribute, const PrimitiveData& data,
                   Json description) {
    const double unit = attribute.normalized ? static_cast<double>(std::numeric_limits<T>::max()) : 1;
    std::vector<T> values;
    for (const Index v : data.vertices)
        for (std::size_t c = 0; c < attribute.components; ++c)
            values.push_back(static_cast<T>(std::clamp(std::round(attribute.values[v][c] * unit),
                                                       static_cast<double>(std::numeric_limits<T>::min()),
                                                       static_cast<double>(std::numeric_limits<T>::max()))));
    return add_vertices(writer, std::move(description), values);
}

Index add_custom(GltfWriter& writer, const CustomAttribute& attribute, const PrimitiveData& data) {
    const auto component = static_cast<ComponentType>(attribute.component_type);
    constexpr std::array<const char*, 4> types = {"SCALAR", "VEC2", "VEC3", "VEC4"};
    Json description =
        accessor_description(component, types.at(attribute.components - 1), data.vertices.size());
    if (attribute.normalized) description["normalized"] = true;
    switch (component) {
        case ComponentType::i8:
            return add_integers<std::int8_t>(writer, attribute, data, description);
        case ComponentType::u8:
            return add_integers<std::uint8_t>(writer, attribute, data, description);
        case ComponentType::i16:
            return add_integers<std::int16_t>(writer, attribute, data, description);
        case ComponentType::u16:
            return add_integers<std::uint16_t>(writer, attribute, data, description);
        case ComponentType::u32:
            return add_integers<std::uint32_t>(writer, attribute, data, description);
        case ComponentType::f32:
            break;
    }
    std::vector<float> values;
    for (const Index v : data.vertices)
        for (std::size_t c = 0; c < attribute.components; ++c)
            values.push_back(static_cast<float>(attribute.values[v][c]));
    return add_vertices(writer, std::move(description), values);
}

Json write_attributes(GltfWriter& writer, const Part& part, const PrimitiveData& data) {
    const std::size_t count = data.vertices.size();
    // Vertices and triangles that are not those of the source may be changed by compression.
    const bool is_new = part.file_order == FileOrder::for_gpu;
    const AccessorUse directions = is_new ? AccessorUse::directions : AccessorUse::vertices;
    const AccessorUse uvs = is_new ? AccessorUse::texture_coordinates : AccessorUse::vertices;
    Json json = {{"POSITION", add_positions(writer, data.positions)}};
    if (!data.normals.empty())
        json["NORMAL"] = add_vertices(writer, accessor_description(ComponentType::f32, "VEC3", count),
                                      data.normals, directions);
    if (!data.tangents.empty())
        json["TANGENT"] = add_vertices(writer, accessor_description(ComponentType::f32, "VEC4", count),
                                       data.tangents, directions);
    for (std::size_t set = 0; set < part.uvs.size(); ++set)
        json["TEXCOORD_" + std::to_string(set)] =
            add_vertices(writer, accessor_description(ComponentType::f32, "VEC2", count),
                         gather(part.uvs[set], data.vertices), uvs);
    if (!data.colors.empty()) json["COLOR_0"] = add_colors(writer, data.colors);
    if (!data.joints.empty()) {
        json["JOINTS_0"] = add_joints(writer, data.joints);
        json["WEIGHTS_0"] =
            add_vertices(writer, accessor_description(ComponentType::f32, "VEC4", count), data.weights);
    }
    for (const CustomAttribute& attribute : part.custom_attributes)
        json[attribute.name] = add_custom(writer, attribute, data);
    return json;
}

/// Groups faces by material, in the order of the first use of each material.
std::vector<std::pair<Index, std::vector<Index>>> faces_by_material(const Part& part) {
    std::vector<std::pair<Index, std::vector<Index>>> groups;
    std::map<Index, std::size_t> group_of;
    for (Index f = 0; f < part.triangles.size(); ++f) {
        const Index material = part.face_material.empty() ? no_index : part.face_material[f];
        const auto [entry, is_new] = group_of.try_emplace(material, groups.size());
        if (is_new) groups.push_back({material, {}});
        groups[entry->second].second.push_back(f);
    }
    return groups;
}

}  // namespace

void write_part(GltfWriter& writer, const Part& part, Json& primitives) {
    std::vector<Index> scratch(part.positions.size(), no_index);
    std::size_t degenerate_faces = 0;
    for (const auto& [material, faces] : faces_by_material(part)) {
        const PrimitiveData data = gather_primitive(part, faces, writer.origin, scratch);
        degenerate_faces += data.degenerate_faces;
        Json primitive = kept_primitive_members(writer, part, material);
        primitive["attributes"] = write_attributes(writer, part, data);
        primitive["indices"] = add_indices(
            writer, data,
            part.file_order == FileOrder::for_gpu ? AccessorUse::triangles : AccessorUse::indices);
        if (!part.morph_targets.empty()) primitive["targets"] = write_morph_targets(writer, part, data);
        if (material != no_index) primitive["material"] = write_material(writer, material);
        primitives.push_back(std::move(primitive));
    }
    if (degenerate_faces > 0)
        writer.warnings.push_back("part '" + part.name + "': glTF stores positions as floats; " +
                                  pluralized(degenerate_faces, "face") + " became degenerate");
}

}  // namespace faqem::detail

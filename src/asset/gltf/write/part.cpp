#include <algorithm>

#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <type_traits>
#include <utility>

#include "asset/gltf/accessor.hpp"
#include "asset/gltf/write/mesh_grid.hpp"
#include "asset/gltf/write/writer.hpp"
#include "asset/scene/affine.hpp"
#include "asset/scene/messages.hpp"
#include "asset/scene/part_arrays.hpp"

namespace faqem::detail {
namespace {

constexpr std::array vector_types = {"SCALAR", "VEC2", "VEC3", "VEC4"};  // by the number of components - 1

template <class T>
void add_vector_bounds(Json& description, const std::vector<std::array<T, 3>>& values) {
    add_bounds(description, std::span<const T>(values.front().data(), 3 * values.size()), 3);
}

template <class T>
Index add_vertices(GltfWriter& writer, Json description, const std::vector<T>& values,
                   AccessorUse use = AccessorUse::vertices) {
    const std::span<const std::uint8_t> bytes = bytes_of(values);
    if (!writer.draco) return writer.binary.add_accessor(std::move(description), bytes, use);
    writer.draco->push_back({{}, std::move(description), {bytes.begin(), bytes.end()}});
    return static_cast<Index>(writer.draco->size() - 1);
}

/// Writes vectors as normalised integers.
/// \param integer  gives the integer, as a double, for a component
template <class T, class Integer, std::size_t N>
Index add_normalized(GltfWriter& writer, NumberType type, const std::vector<std::array<float, N>>& values,
                     Integer&& integer, AccessorUse use = AccessorUse::vertices) {
    std::vector<std::array<T, N>> integers(values.size());
    for (std::size_t i = 0; i < values.size(); ++i)
        for (std::size_t c = 0; c < N; ++c)
            integers[i][c] = static_cast<T>(std::lround(integer(values[i][c])));
    Json description = accessor_description(type, vector_types[N - 1], integers.size());
    description["normalized"] = true;
    return add_vertices(writer, std::move(description), integers, use);
}

template <std::size_t N>
Index add_float_vertices(GltfWriter& writer, const std::vector<std::array<float, N>>& values,
                         AccessorUse use = AccessorUse::vertices) {
    return add_vertices(writer, accessor_description(NumberType::f32, vector_types[N - 1], values.size()),
                        values, use);
}

constexpr double unit_16 = 65535;  // 1 as a normalised integer

/// Writes integer vectors with bounds.
template <class T, class Value>
Index add_bounded_integers(GltfWriter& writer, const std::vector<Value>& values, const MeshGrid& grid,
                           NumberType type) {
    std::vector<std::array<T, 3>> integers;
    integers.reserve(values.size());
    for (const Value& v : values) integers.push_back(converted<T>(v));
    Json description = accessor_description(type, "VEC3", integers.size());
    if (grid.normalized) description["normalized"] = true;
    add_vector_bounds(description, integers);
    writer.needs_quantization = true;
    return add_vertices(writer, std::move(description), integers);
}

Index add_positions(GltfWriter& writer, const std::vector<Vec3f>& values, const MeshGrid& grid) {
    if (!grid.is_on()) {
        Json description = accessor_description(NumberType::f32, "VEC3", values.size());
        add_vector_bounds(description, values);
        return add_vertices(writer, std::move(description), values);
    }
    std::vector<std::array<std::int32_t, 3>> steps;
    steps.reserve(values.size());
    for (const Vec3f& v : values)
        steps.push_back({grid.step(v[0], 0), grid.step(v[1], 1), grid.step(v[2], 2)});
    return visit_type(grid.type, [&](auto number) {
        return add_bounded_integers<decltype(number)>(writer, steps, grid, grid.type);
    });
}

/// Writes unit vectors, as 16-bit integers with Asset::normal_bits. Compression may round those of new vertices further.
template <std::size_t N>
Index add_directions(GltfWriter& writer, const std::vector<std::array<float, N>>& values, bool is_new) {
    if (writer.asset.normal_bits == 0 || writer.draco)
        return add_float_vertices(writer, values, is_new ? AccessorUse::directions : AccessorUse::vertices);
    writer.needs_quantization = true;
    return add_normalized<std::int16_t>(
        writer, NumberType::i16, values, [](float x) { return std::clamp(x, -1.0f, 1.0f) * 32767.0; },
        is_new ? AccessorUse::short_directions : AccessorUse::vertices);
}

/// Writes texture coordinates. With Asset::uv_bits they are normalised integers if all are from 0 to 1. Where
/// compression rounds floats, these are smaller; vertices that are not new stay exact there.
Index add_uvs(GltfWriter& writer, const std::vector<Vec2f>& values, bool is_new) {
    const bool is_compressed = writer.asset.compression == Compression::meshopt;
    const bool fits = std::ranges::all_of(values, [&](const Vec2f& uv) {
        return std::ranges::all_of(uv, [&](float x) {
            return x >= 0 && x <= 1 &&
                   (!is_compressed || static_cast<float>(std::round(x * unit_16) / unit_16) == x);
        });
    });
    if (writer.asset.uv_bits == 0 || (is_compressed && is_new) || !fits || writer.draco)
        return add_float_vertices(writer, values,
                                  is_new ? AccessorUse::texture_coordinates : AccessorUse::vertices);
    return add_normalized<std::uint16_t>(writer, NumberType::u16, values,
                                         [](float x) { return x * unit_16; });
}

/// Writes colours as normalised 16-bit integers, since 8 bits are too few for linear colours; as floats if a
/// value is outside [0, 1].
Index add_colors(GltfWriter& writer, const std::vector<Vec4f>& colors) {
    const bool in_range = std::ranges::all_of(colors, [](const Vec4f& color) {
        return std::ranges::all_of(color, [](float x) { return x >= 0 && x <= 1; });
    });
    if (!in_range) return add_float_vertices(writer, colors);
    return add_normalized<std::uint16_t>(writer, NumberType::u16, colors,
                                         [](float x) { return x * unit_16; });
}

Index add_joints(GltfWriter& writer, const std::vector<std::array<std::uint16_t, 4>>& joints) {
    const bool fits_u8 = std::ranges::all_of(joints, [](const auto& four) {
        return std::ranges::all_of(four, [](std::uint16_t joint) { return joint < 256; });
    });
    if (!fits_u8)
        return add_vertices(writer, accessor_description(NumberType::u16, "VEC4", joints.size()), joints);
    std::vector<std::array<std::uint8_t, 4>> bytes;
    for (const auto& four : joints) bytes.push_back(converted<std::uint8_t>(four));
    return add_vertices(writer, accessor_description(NumberType::u8, "VEC4", bytes.size()), bytes);
}

/// Writes morph target displacements. If all are zero, no bytes are stored.
Index add_displacements(GltfWriter& writer, const std::vector<Vec3f>& values, bool with_bounds) {
    Json description = accessor_description(NumberType::f32, "VEC3", values.size());
    if (with_bounds) add_vector_bounds(description, values);
    if (std::ranges::all_of(values, [](const Vec3f& v) { return v == Vec3f{}; }))
        return writer.binary.add_accessor(std::move(description), {}, AccessorUse::vertices);
    return add_vertices(writer, std::move(description), values);
}

/// Writes displacements in steps of a grid, as integers if their type has a sign and all are in its range.
Index add_displacement_steps(GltfWriter& writer, const std::vector<Vec3f>& values, const MeshGrid& grid) {
    std::vector<Vec3> steps;
    double largest = 0;
    for (const Vec3f& v : values) {
        steps.push_back({grid.steps(v[0]), grid.steps(v[1]), grid.steps(v[2])});
        for (const double step : steps.back()) largest = std::max(largest, std::abs(step));
    }
    const bool fits = largest <= 32767 && (!grid.normalized || grid.type == NumberType::i16);
    if (fits && largest > 0) return add_bounded_integers<std::int16_t>(writer, steps, grid, NumberType::i16);
    std::vector<Vec3f> floats;
    const double unit = grid.normalized ? grid.spacing : 1;
    for (const Vec3& step : steps)
        floats.push_back(converted<float>(Vec3{step[0] * unit, step[1] * unit, step[2] * unit}));
    return add_displacements(writer, floats, true);
}

Json write_morph_targets(GltfWriter& writer, const Part& part, const PrimitiveData& data,
                         const MeshGrid& grid) {
    Json targets = Json::array();
    for (const MorphTarget& target : part.morph_targets) {
        Json json = Json::object();
        const std::vector<Vec3f> positions = target.positions.empty()
                                                 ? std::vector<Vec3f>(data.vertices.size(), Vec3f{})
                                                 : gather(target.positions, data.vertices);
        json["POSITION"] = grid.is_on() ? add_displacement_steps(writer, positions, grid)
                                        : add_displacements(writer, positions, true);
        if (!target.normals.empty() && !data.normals.empty())
            json["NORMAL"] = add_displacements(writer, gather(target.normals, data.vertices), false);
        targets.push_back(std::move(json));
    }
    return targets;
}

/// The number that a file stores for a value of a custom attribute.
template <class T>
T stored_number(double value, bool is_normalized) {
    if constexpr (std::is_floating_point_v<T>) return static_cast<T>(value);
    constexpr double low{std::numeric_limits<T>::min()}, high{std::numeric_limits<T>::max()};
    return static_cast<T>(std::clamp(std::round(value * (is_normalized ? high : 1)), low, high));
}

Index add_custom(GltfWriter& writer, const CustomAttribute& attribute, const PrimitiveData& data) {
    const auto type = static_cast<NumberType>(attribute.component_type);
    Json description =
        accessor_description(type, vector_types.at(attribute.components - 1), data.vertices.size());
    if (attribute.normalized) description["normalized"] = true;
    return visit_type(type, [&](auto number) {
        using T = decltype(number);
        std::vector<T> values;
        for (const Index v : data.vertices)
            for (std::size_t c = 0; c < attribute.components; ++c)
                values.push_back(stored_number<T>(attribute.values[v][c], attribute.normalized));
        return add_vertices(writer, std::move(description), values);
    });
}

Json write_attributes(GltfWriter& writer, const Part& part, const PrimitiveData& data, const MeshGrid& grid) {
    // Vertices and triangles that are not those of the source may be changed by compression.
    const bool is_new = part.file_order == FileOrder::for_gpu;
    Json json = {{"POSITION", add_positions(writer, data.positions, grid)}};
    if (!data.normals.empty()) json["NORMAL"] = add_directions(writer, data.normals, is_new);
    if (!data.tangents.empty()) json["TANGENT"] = add_directions(writer, data.tangents, is_new);
    for (std::size_t set = 0; set < part.uvs.size(); ++set)
        json["TEXCOORD_" + std::to_string(set)] =
            add_uvs(writer, gather(part.uvs[set], data.vertices), is_new);
    if (!data.colors.empty()) json["COLOR_0"] = add_colors(writer, data.colors);
    if (!data.joints.empty()) {
        json["JOINTS_0"] = add_joints(writer, data.joints);
        json["WEIGHTS_0"] = add_float_vertices(writer, data.weights);
    }
    for (const CustomAttribute& attribute : part.custom_attributes)
        json[attribute.name] = add_custom(writer, attribute, data);
    return json;
}

/// The steps to which Draco rounds an attribute.
std::optional<DracoRounding> draco_rounding(const Asset& asset, const Part& part, const DracoValues& values) {
    // Tangents have a length within 5e-4 of 1, so that they are kept when they are written again.
    constexpr std::uint32_t min_tangent_bits = 13;
    if (values.name == "POSITION")
        return rounding_to_steps(floats_of(values.bytes), 3, part.position_spacing);
    if (values.name == "NORMAL" && asset.normal_bits > 0)
        return DracoRounding{asset.normal_bits, true, {}, 0};
    if (values.name == "TANGENT" && asset.normal_bits > 0)
        return DracoRounding{std::max(asset.normal_bits, min_tangent_bits), false, {-1, -1, -1, -1}, 2};
    if (values.name.starts_with("TEXCOORD_") && asset.uv_bits > 0)
        return rounding_to_steps(floats_of(values.bytes), 2,
                                 std::ldexp(1.0, -static_cast<int>(asset.uv_bits)));
    return std::nullopt;
}

/// Rounds the bounds of positions as Draco does.
void round_bounds(Json& description, double spacing) {
    for (const char* key : {"min", "max"})
        for (Json& x : description[key])
            x = static_cast<float>(std::round(x.get<double>() / spacing) * spacing);
}

/// Writes the attributes and triangles of a primitive as Draco data. Returns false if that is not possible.
bool write_draco(GltfWriter& writer, const Part& part, const PrimitiveData& data, Json& primitive) {
    std::vector<DracoValues> values;
    writer.draco = &values;
    const Json numbers = write_attributes(writer, part, data, {});
    writer.draco = nullptr;
    for (const auto& [name, number] : numbers.items()) {
        DracoValues& own = values[number.get<std::size_t>()];
        own.name = name;
        own.rounding = draco_rounding(writer.asset, part, own);
        if (name == "POSITION" && own.rounding) round_bounds(own.description, part.position_spacing);
    }
    // Morph targets, and extensions that refer to unchanged vertices and triangles, need their order.
    const bool keeps_order = !part.morph_targets.empty() || part.file_order == FileOrder::given;
    std::optional<DracoBytes> encoded = encode_draco(values, data.corners, keeps_order);
    if (!encoded) return false;
    for (const auto& [name, number] : numbers.items()) {
        Json& description = values[number.get<std::size_t>()].description;
        description["count"] = encoded->vertices;
        primitive["attributes"][name] = writer.binary.add_extension_accessor(std::move(description));
    }
    primitive["indices"] = writer.binary.add_extension_accessor(accessor_description(
        encoded->vertices > 65535 ? NumberType::u32 : NumberType::u16, "SCALAR", encoded->corners));
    primitive["extensions"][draco_name] = {
        {"bufferView", writer.binary.add_extension_data(std::move(encoded->bytes))}, {"attributes", numbers}};
    return true;
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

/// Number of triangles with two corners for which fits(corner, corner) is true.
template <class Fits>
std::size_t triangles_with(const std::vector<Index>& corners, const Fits& fits) {
    std::size_t count = 0;
    for (std::size_t c = 0; c + 2 < corners.size(); c += 3) {
        const Index* t = &corners[c];
        count += fits(t[0], t[1]) || fits(t[1], t[2]) || fits(t[2], t[0]);
    }
    return count;
}

/// Number of triangles that have two different positions which become equal as floats.
std::size_t degenerate_as_floats(const Part& part, const PrimitiveData& data) {
    return triangles_with(data.corners, [&](Index a, Index b) {
        return data.positions[a] == data.positions[b] &&
               part.positions[data.vertices[a]] != part.positions[data.vertices[b]];
    });
}

/// Number of triangles that have two different positions which become equal on the grid.
std::size_t degenerate_on_grid(const PrimitiveData& data, const MeshGrid& grid) {
    return triangles_with(data.corners, [&](Index a, Index b) {
        const Vec3f &p = data.positions[a], &q = data.positions[b];
        return p != q && grid.step(p[0], 0) == grid.step(q[0], 0) &&
               grid.step(p[1], 1) == grid.step(q[1], 1) && grid.step(p[2], 2) == grid.step(q[2], 2);
    });
}

void warn_degenerate(GltfWriter& writer, const Part& part, std::size_t faces, const char* why) {
    if (faces > 0)
        writer.warnings.push_back("part '" + part.name + "': " + why + "; " + pluralized(faces, "face") +
                                  " became degenerate");
}

/// Whether primitives get the names of the groups of their faces: if the mesh has several, and not so many that the
/// names would take more bytes than its geometry.
bool has_group_names(GltfWriter& writer, const Part& part) {
    constexpr std::size_t max_groups = 256;
    if (part.face_group.empty() || part.group_names.size() < 2) return false;
    if (part.group_names.size() <= max_groups) return true;
    writer.warnings.push_back("part '" + part.name + "': the names of " +
                              std::to_string(part.group_names.size()) + " groups were left out: more than " +
                              std::to_string(max_groups));
    return false;
}

/// Adds the names of the groups of some faces to the extras of their primitive: a primitive for each group would be a
/// draw call for each. Extras may be of any JSON type; only objects have names.
void add_group_names(const Part& part, const std::vector<Index>& faces, Json& primitive) {
    std::set<Index> groups;
    for (const Index f : faces)
        if (part.face_group[f] != no_index) groups.insert(part.face_group[f]);
    const Json& extras = member(primitive, "extras");
    if (groups.empty() || !(extras.is_null() || extras.is_object())) return;
    Json names = Json::array();
    for (const Index group : groups) names.push_back(part.group_names[group]);
    primitive["extras"]["groups"] = std::move(names);
}

}  // namespace

void write_part(GltfWriter& writer, const Part& part, const MeshGrid& grid, Json& primitives,
                Json& mesh_extensions) {
    std::vector<Index> scratch(part.positions.size(), no_index);
    std::size_t degenerate_faces = 0, degenerate_grid_faces = 0;
    const bool names_groups = has_group_names(writer, part);
    for (const auto& [material, faces] : faces_by_material(part)) {
        const PrimitiveData data = gather_primitive(part, faces, writer.origin, scratch);
        degenerate_faces += degenerate_as_floats(part, data);
        if (grid.is_on()) degenerate_grid_faces += degenerate_on_grid(data, grid);
        Json primitive = carried_primitive_members(writer, part, material, data);
        const bool is_draco =
            writer.asset.compression == Compression::draco && write_draco(writer, part, data, primitive);
        if (!is_draco) {
            primitive["attributes"] = write_attributes(writer, part, data, grid);
            primitive["indices"] = writer.binary.add_indices(
                data.corners,
                part.file_order == FileOrder::for_gpu ? AccessorUse::triangles : AccessorUse::indices);
        }
        if (!part.morph_targets.empty()) primitive["targets"] = write_morph_targets(writer, part, data, grid);
        // Without a material glTF means metal, which only a glTF file can have meant.
        if (material != no_index || !writer.asset.source)
            primitive["material"] = write_material(writer, material);
        keep_manifold(writer, part, data, primitive, mesh_extensions);
        if (names_groups) add_group_names(part, faces, primitive);
        primitives.push_back(std::move(primitive));
    }
    warn_degenerate(writer, part, degenerate_faces, "glTF stores positions as floats");
    warn_degenerate(writer, part, degenerate_grid_faces, "positions are rounded to a grid");
}

}  // namespace faqem::detail

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "asset/gltf/accessor.hpp"
#include "asset/gltf/read/load.hpp"
#include "asset/scene/influences.hpp"
#include "asset/scene/repair.hpp"
#include "faqem/engine/mesh/index_lists.hpp"
#include "faqem/error.hpp"
#include "faqem/options.hpp"

namespace faqem::detail {
namespace {

/// Union of the attributes of all triangle primitives of a mesh.
struct PartLayout {
    bool normals = false, tangents = false, colors = false, target_normals = false;
    std::size_t uv_sets = 0, joint_sets = 0, targets = 0;
    std::vector<CustomAttribute> custom;  // without values
    std::set<std::string> ignored_attributes;
};

/// What was left out of the joint weights of several sets.
struct TrimmedWeights {
    std::uint64_t non_finite = 0, vertices = 0;  // vertices: with more than four joints
    double left_out = 0, most_left_out = 0;      // of their weights: the sum of the shares, the largest share
};

std::string uv_name(std::size_t set) { return "TEXCOORD_" + std::to_string(set); }
std::string joints_name(std::size_t set) { return "JOINTS_" + std::to_string(set); }
std::string weights_name(std::size_t set) { return "WEIGHTS_" + std::to_string(set); }

// The attributes of applications that all triangle primitives store in the same way. Feature ids have no value that
// stands for none, so that an attribute which some primitives lack cannot be joined.
std::vector<CustomAttribute> custom_attributes(const Json& mesh, const Json& accessors) {
    std::map<std::string, CustomAttribute> found;
    std::map<std::string, std::size_t> uses;
    std::size_t primitives = 0;
    for (const Json& primitive : member(mesh, "primitives")) {
        if (!has_triangles(primitive)) continue;
        ++primitives;
        for (const auto& [name, index] : primitive["attributes"].items()) {
            if (name.empty() || name[0] != '_') continue;
            const Json& accessor = accessors[index.get<Index>()];
            CustomAttribute own{name, {}};
            const std::string type = string_member(accessor, "type");
            own.components = type.starts_with("MAT") ? 0 : component_count(type);
            own.component_type = static_cast<std::uint32_t>(unsigned_member(accessor, "componentType", 0));
            own.normalized = member(accessor, "normalized") == true;
            const CustomAttribute& first = found.try_emplace(name, own).first->second;
            const bool is_equal = first.components == own.components && first.normalized == own.normalized &&
                                  first.component_type == own.component_type;
            if (is_equal && own.components > 0) ++uses[name];
        }
    }
    std::vector<CustomAttribute> result;
    for (const auto& [name, attribute] : found)
        if (uses[name] == primitives) result.push_back(attribute);
    return result;
}

PartLayout layout_of(const Json& mesh, const Json& accessors) {
    PartLayout layout;
    layout.custom = custom_attributes(mesh, accessors);
    std::set<std::string> names, target_names;
    for (const Json& primitive : member(mesh, "primitives")) {
        if (!has_triangles(primitive)) continue;
        for (const auto& [name, accessor] : primitive["attributes"].items()) names.insert(name);
        const Json& targets = member(primitive, "targets");
        for (const Json& target : targets)
            for (const auto& [name, accessor] : target.items()) target_names.insert(name);
        layout.targets = std::max(layout.targets, targets.size());
    }
    while (names.erase(uv_name(layout.uv_sets)) != 0) ++layout.uv_sets;
    names.erase("POSITION");
    target_names.erase("POSITION");
    layout.normals = names.erase("NORMAL") != 0;
    layout.tangents = names.erase("TANGENT") != 0;
    layout.colors = names.erase("COLOR_0") != 0;
    for (std::size_t& set = layout.joint_sets;
         names.contains(joints_name(set)) && names.contains(weights_name(set)); ++set) {
        names.erase(joints_name(set));
        names.erase(weights_name(set));
    }
    for (const CustomAttribute& attribute : layout.custom) names.erase(attribute.name);
    layout.target_normals = target_names.erase("NORMAL") != 0;
    layout.ignored_attributes = std::move(names);
    for (const std::string& name : target_names) layout.ignored_attributes.insert("morph target " + name);
    return layout;
}

/// Appends `count` vectors to `out`: those of the accessor, or `fill` if there is no accessor.
template <class T, std::size_t N>
void append(std::vector<std::array<T, N>>& out, const SourceDocument& source, Index accessor,
            std::size_t count, const std::array<T, N>& fill) {
    const std::vector<std::array<T, N>> values = vectors_or(source, accessor, count, fill);
    out.insert(out.end(), values.begin(), values.end());
}

/// Appends the joints and weights of a primitive: one set as it is, of several the four heaviest influences.
/// \param sets  largest number of sets that the primitive may have
void append_joints(Part& part, const SourceDocument& source, const Json& attributes, std::size_t sets,
                   std::size_t count, TrimmedWeights& trimmed) {
    std::vector<std::vector<std::array<std::uint16_t, 4>>> joints;
    std::vector<std::vector<Vec4f>> weights;
    for (std::size_t set = 0; set < sets; ++set) {
        const Index of_joints = index_member(attributes, joints_name(set).c_str()),
                    of_weights = index_member(attributes, weights_name(set).c_str());
        if (of_joints == no_index || of_weights == no_index) continue;
        joints.push_back(read_vectors<std::uint16_t, 4>(source, of_joints));
        weights.push_back(read_vectors<float, 4>(source, of_weights));
    }
    if (joints.size() == 1) {
        part.joints.insert(part.joints.end(), joints[0].begin(), joints[0].end());
        part.weights.insert(part.weights.end(), weights[0].begin(), weights[0].end());
        return;
    }
    for (std::vector<Vec4f>& set : weights) trimmed.non_finite += reset_non_finite(set, {});
    const std::size_t first = part.joints.size();
    part.joints.resize(first + count);
    part.weights.resize(first + count);
    Influences all;
    for (std::size_t v = 0; v < count; ++v) {
        for (std::size_t set = 0; set < joints.size(); ++set)
            for (std::size_t k = 0; k < 4; ++k) all.add(joints[set][v][k], double{weights[set][v][k]});
        const double left_out = all.take_heaviest(part.joints[first + v], part.weights[first + v]);
        trimmed.vertices += left_out > 0;
        trimmed.left_out += left_out;
        trimmed.most_left_out = std::max(trimmed.most_left_out, left_out);
    }
}

/// Appends the vertices of a primitive. Returns the index of the first one.
std::uint64_t append_vertices(Part& part, const PartLayout& layout, const SourceDocument& source,
                              const Json& primitive, TrimmedWeights& trimmed) {
    const Json &from = primitive["attributes"], &targets = member(primitive, "targets");
    const std::uint64_t first = part.positions.size();
    const std::vector<Vec3> positions = read_vectors<double, 3>(source, index_member(from, "POSITION"));
    const std::size_t count = positions.size();
    part.positions.insert(part.positions.end(), positions.begin(), positions.end());
    if (layout.normals) append(part.normals, source, index_member(from, "NORMAL"), count, Vec3f{});
    if (layout.tangents) append(part.tangents, source, index_member(from, "TANGENT"), count, Vec4f{});
    for (std::size_t set = 0; set < layout.uv_sets; ++set)
        append(part.uvs[set], source, index_member(from, uv_name(set).c_str()), count, Vec2f{});
    if (layout.colors) append(part.colors, source, index_member(from, "COLOR_0"), count, Vec4f{1, 1, 1, 1});
    if (layout.joint_sets > 0) append_joints(part, source, from, layout.joint_sets, count, trimmed);
    for (CustomAttribute& attribute : part.custom_attributes)
        append(attribute.values, source, index_member(from, attribute.name.c_str()), count,
               std::array<double, 4>{});
    for (std::size_t t = 0; t < layout.targets; ++t) {
        static const Json none;
        const Json& target = t < targets.size() ? targets[t] : none;
        MorphTarget& to = part.morph_targets[t];
        append(to.positions, source, index_member(target, "POSITION"), count, Vec3f{});
        if (layout.target_normals) append(to.normals, source, index_member(target, "NORMAL"), count, Vec3f{});
    }
    return first;
}

/// The corners of a primitive as indices of its own vertices.
std::vector<Index> corners_of(const LoadedGltf& loaded, const Json& primitive, std::uint64_t vertices,
                              const std::string& where) {
    const Index indices = index_member(primitive, "indices");
    if (indices == no_index) return engine::all_indices(vertices);
    std::vector<Index> corners = read_indices(*loaded.source, indices);
    for (const Index corner : corners)
        if (corner >= vertices)
            throw InputError(loaded.file, where + "/indices",
                             "contains " + std::to_string(corner) + ", there are " +
                                 std::to_string(vertices) + " vertices");
    return corners;
}

/// Triangles of a list, strip or fan (glTF 2.0, section 3.7.2.1). Degenerate triangles of strips and fans,
/// which only connect parts of the strip, are left out.
std::vector<Triangle> triangles_of(const std::vector<Index>& v, std::uint64_t mode) {
    std::vector<Triangle> triangles;
    if (mode == triangle_list) {
        triangles.reserve(v.size() / 3);
        for (std::size_t i = 0; i + 2 < v.size(); i += 3) triangles.push_back({v[i], v[i + 1], v[i + 2]});
        return triangles;
    }
    for (std::size_t i = 0; i + 2 < v.size(); ++i) {
        const Triangle t = mode == triangle_fan ? Triangle{v[i + 1], v[i + 2], v[0]}
                                                : Triangle{v[i], v[i + 1 + i % 2], v[i + 2 - i % 2]};
        if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) triangles.push_back(t);
    }
    return triangles;
}

void warn(LoadedGltf& loaded, const std::string& where, std::uint64_t count, const std::string& what) {
    if (count != 0) loaded.warnings.push_back(where + ": " + std::to_string(count) + " " + what);
}

/// A share in percent, with one decimal place: `12.5%`.
std::string percent(double share) {
    const long tenths = std::lround(share * 1000);
    return std::to_string(tenths / 10) + "." + std::to_string(tenths % 10) + "%";
}

void add_warnings(LoadedGltf& loaded, const std::string& where, const TrimmedWeights& trimmed,
                  std::uint64_t excess_corners, const PartLayout& layout) {
    warn(loaded, where, trimmed.non_finite, "non-finite vectors of weights set to zero");
    if (trimmed.vertices > 0)
        warn(loaded, where, trimmed.vertices,
             "vertices have more than four joints: the four heaviest are kept, " +
                 percent(trimmed.left_out / static_cast<double>(trimmed.vertices)) +
                 " of the weights in the mean and at most " + percent(trimmed.most_left_out) +
                 " were left out");
    warn(loaded, where, excess_corners,
         "indices at the end of a triangle list do not form a triangle and were left out");
    for (const std::string& name : layout.ignored_attributes)
        loaded.warnings.push_back(where + ": the attribute " + name + " was left out");
}

}  // namespace

Part read_part(LoadedGltf& loaded, Index mesh_index, std::uint64_t& dropped_faces) {
    const Json& document = loaded.source->document;
    const Json &mesh = document["meshes"][mesh_index], &accessors = member(document, "accessors");
    const std::string where = child_path("/meshes", mesh_index);
    const PartLayout layout = layout_of(mesh, accessors);
    Part part;
    part.name = string_member(mesh, "name");
    part.source = mesh_index;
    part.uvs.resize(layout.uv_sets);
    part.morph_targets.resize(layout.targets);
    part.custom_attributes = layout.custom;
    TrimmedWeights trimmed;
    std::uint64_t excess = 0;
    std::set<double> spacings;  // of the positions of all primitives
    // Primitives often share their vertices and differ only in indices and material.
    std::map<std::pair<Json, Json>, std::uint64_t> first_vertex;
    const Json& primitives = member(mesh, "primitives");
    for (std::size_t p = 0; p < primitives.size(); ++p) {
        const Json& primitive = primitives[p];
        const std::uint64_t mode = primitive_mode(primitive);
        const std::string at = child_path(where + "/primitives", p);
        if (!has_triangles(primitive)) {
            if (mode >= triangle_list) loaded.warnings.push_back(at + ": has no positions and was left out");
            continue;
        }
        const auto [entry, is_new] =
            first_vertex.try_emplace({primitive["attributes"], member(primitive, "targets")}, 0);
        if (is_new) entry->second = append_vertices(part, layout, *loaded.source, primitive, trimmed);
        const std::uint64_t first = entry->second;
        if (part.positions.size() >= no_index)
            throw InputError(loaded.file, where, "has more than 2^32 - 2 vertices");
        const Json& position = accessors[index_member(primitive["attributes"], "POSITION")];
        spacings.insert(integer_step(position));
        const std::vector<Index> corners =
            corners_of(loaded, primitive, unsigned_member(position, "count", 0), at);
        if (mode == triangle_list) excess += corners.size() % 3;
        const Index material = index_member(primitive, "material");
        for (Triangle triangle : triangles_of(corners, mode)) {
            for (Index& corner : triangle) corner = static_cast<Index>(corner + first);
            part.triangles.push_back(triangle);
            part.face_material.push_back(material);
        }
    }
    if (spacings.size() == 1) part.position_spacing = *spacings.begin();
    std::vector<std::string> warnings;
    dropped_faces += repair_vertices(part, 0, warnings);
    for (const std::string& warning : warnings) loaded.warnings.push_back(where + ": " + warning);
    add_warnings(loaded, where, trimmed, excess, layout);
    return part;
}

void read_vertex_bits(const LoadedGltf& loaded, Asset& asset) {
    constexpr QuantizeOptions standard;
    const Json &meshes = member(loaded.source->document, "meshes"),
               &accessors = member(loaded.source->document, "accessors");
    for (const Json& mesh : meshes) {
        for (const Json& primitive : member(mesh, "primitives")) {
            if (!has_triangles(primitive)) continue;
            for (const auto& [name, accessor] : primitive["attributes"].items()) {
                if (integer_step(accessors[accessor.get<Index>()]) == 0) continue;
                if (name == "NORMAL" || name == "TANGENT") asset.normal_bits = standard.normal_bits;
                if (name.starts_with("TEXCOORD_")) asset.uv_bits = standard.uv_bits;
            }
        }
    }
    // Integers for texture coordinates alone need no extension, and do not tell of quantisation.
    const bool is_quantized = asset.normal_bits > 0 || std::ranges::any_of(asset.parts, [](const Part& part) {
                                  return part.position_spacing > 0;
                              });
    if (!is_quantized) asset.uv_bits = 0;
}

}  // namespace faqem::detail

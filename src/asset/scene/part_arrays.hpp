#pragma once
/// \file
/// The arrays of a part, for code that treats all of them alike. A new array of Part is listed here.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "faqem/asset.hpp"
#include "faqem/surface_map.hpp"

namespace faqem::detail {

/// An array of a part that is empty or has an index for each face.
struct FaceArray {
    std::vector<Index> Part::*values;       ///< no_index: none
    std::vector<std::string> Part::*names;  ///< what the values are indices into; null: Asset::materials
    std::string_view kind;                  ///< for messages
};

inline constexpr FaceArray material_array = {&Part::face_material, nullptr, "material"};
inline constexpr FaceArray object_array = {&Part::face_object, &Part::object_names, "object"};
inline constexpr FaceArray group_array = {&Part::face_group, &Part::group_names, "group"};

/// All arrays by face, except for the triangles.
inline constexpr std::array face_arrays = {material_array, object_array, group_array};

/// Whether an array is not empty in some part.
template <class T>
bool some_part_has(const Asset& asset, std::vector<T> Part::*values) {
    return std::ranges::any_of(asset.parts, [&](const Part& part) { return !(part.*values).empty(); });
}

/// The value at a point, interpolated between those of the corners of its face.
/// \tparam Sum    type of the sums and the result
/// \param values  by vertex of `part`
template <class Sum, class Value, std::size_t N>
std::array<Sum, N> interpolated(const std::vector<std::array<Value, N>>& values, const Part& part,
                                const SurfacePoint& point) {
    std::array<Sum, N> result{};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t k = 0; k < N; ++k)
            result[k] += static_cast<Sum>(point.barycentric[i]) * values[part.triangles[point.face][i]][k];
    return result;
}

/// Number of faces of all parts.
inline std::uint64_t face_count(const Asset& asset) {
    std::uint64_t sum = 0;
    for (const Part& part : asset.parts) sum += part.triangles.size();
    return sum;
}

/// What an array of vertices is.
struct VertexArray {
    std::string_view name;                       ///< for messages
    std::size_t uv_set = no_index;               ///< no_index: not an UV set
    const CustomAttribute* attribute = nullptr;  ///< whose values they are

    bool may_be_empty() const { return uv_set == no_index && !attribute; }
    std::string title() const {
        std::string text(name);
        if (uv_set != no_index) text.append(" ").append(std::to_string(uv_set));
        return text;
    }
};

/// Calls visit(description, array...) for the arrays of vertices, with the same array of each part.
/// \param part    Part or const Part
/// \param others  parts with at least as many UV sets, morph targets and custom attributes
template <class Visit, class First, class... Others>
void visit_vertex_arrays(const Visit& visit, First& part, Others&... others) {
    for (std::size_t s = 0; s < part.uvs.size(); ++s)
        visit(VertexArray{"uvs", s}, part.uvs[s], others.uvs[s]...);
    visit(VertexArray{"positions"}, part.positions, others.positions...);
    visit(VertexArray{"normals"}, part.normals, others.normals...);
    visit(VertexArray{"tangents"}, part.tangents, others.tangents...);
    visit(VertexArray{"colors"}, part.colors, others.colors...);
    visit(VertexArray{"weights"}, part.weights, others.weights...);
    visit(VertexArray{"joints"}, part.joints, others.joints...);
    for (std::size_t m = 0; m < part.morph_targets.size(); ++m) {
        visit(VertexArray{"positions of a morph target"}, part.morph_targets[m].positions,
              others.morph_targets[m].positions...);
        visit(VertexArray{"normals of a morph target"}, part.morph_targets[m].normals,
              others.morph_targets[m].normals...);
    }
    for (std::size_t a = 0; a < part.custom_attributes.size(); ++a) {
        const CustomAttribute& attribute = part.custom_attributes[a];
        visit(VertexArray{attribute.name, no_index, &attribute}, part.custom_attributes[a].values,
              others.custom_attributes[a].values...);
    }
}

/// Returns values[numbers[i]] for all i; nothing if there are no values.
template <class T, class Number>
std::vector<T> gather(const std::vector<T>& values, const std::vector<Number>& numbers) {
    std::vector<T> result;
    if (values.empty()) return result;
    result.reserve(numbers.size());
    for (const Number i : numbers) result.push_back(values[i]);
    return result;
}

/// Gives `to` the triangles and the arrays of some faces of a part, which may be `to` itself. The names, and the
/// vertices that the triangles refer to, are not changed.
inline void select_faces(const Part& from, const std::vector<Index>& faces, Part& to) {
    to.triangles = gather(from.triangles, faces);
    for (const FaceArray& array : face_arrays) to.*array.values = gather(from.*array.values, faces);
}

/// The attributes without their values.
inline std::vector<CustomAttribute> without_values(const std::vector<CustomAttribute>& attributes) {
    std::vector<CustomAttribute> result;
    for (const CustomAttribute& a : attributes)
        result.push_back({a.name, {}, a.components, a.component_type, a.normalized});
    return result;
}

/// Gives `to` some vertices of another part, in all arrays of vertices.
template <class Number>
void select_vertices(const Part& from, const std::vector<Number>& vertices, Part& to) {
    to.uvs.resize(from.uvs.size());
    to.morph_targets.resize(from.morph_targets.size());
    to.custom_attributes = without_values(from.custom_attributes);
    visit_vertex_arrays(
        [&](const VertexArray&, auto& values, const auto& all) { values = gather(all, vertices); }, to, from);
}

/// Sets an array by face. It has only those of the names that are used, in the order of their first use.
/// \param values  by face: indices into `names`, or no_index
/// Complexity: O(faces).
inline void set_face_names(Part& part, const FaceArray& array, const std::vector<Index>& values,
                           const std::vector<std::string>& names) {
    std::vector<Index>& to = part.*array.values;
    std::vector<std::string>& used = part.*array.names;
    std::unordered_map<Index, Index> number = {{no_index, no_index}};
    to.clear(), used.clear();
    for (const Index value : values) {
        const auto [entry, is_new] = number.try_emplace(value, static_cast<Index>(used.size()));
        if (is_new) used.push_back(names[value]);
        to.push_back(entry->second);
    }
}

/// Sets the objects of the faces as set_face_names() does, if there are several.
inline void set_objects(Part& part, const std::vector<Index>& values, const std::vector<std::string>& names) {
    set_face_names(part, object_array, values, names);
    if (part.object_names.size() >= 2) return;
    part.face_object.clear();
    part.object_names.clear();
}

/// The vertices that some faces use, ascending, and the corners of these faces as indices into them.
/// \param scratch  one no_index per vertex of the part; restored on return
/// Complexity: O(faces log faces).
inline void number_corners(const Part& part, const std::vector<Index>& faces, std::vector<Index>& scratch,
                           std::vector<Index>& vertices, std::vector<Index>& corners) {
    for (const Index f : faces)
        for (const Index v : part.triangles[f])
            if (scratch[v] == no_index) {
                scratch[v] = 0;
                vertices.push_back(v);
            }
    std::ranges::sort(vertices);
    for (Index i = 0; i < vertices.size(); ++i) scratch[vertices[i]] = i;
    corners.reserve(faces.size() * 3);
    for (const Index f : faces)
        for (const Index v : part.triangles[f]) corners.push_back(scratch[v]);
    for (const Index v : vertices) scratch[v] = no_index;
}

}  // namespace faqem::detail

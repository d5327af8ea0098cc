#include "asset/gltf/write/index_extensions.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <string>
#include <utility>

#include "asset/gltf/accessor.hpp"

namespace faqem::detail {
namespace {

/// The numbers in an accessor that an extension refers to; none if it is no accessor of unsigned integers.
std::optional<std::vector<Index>> referenced_numbers(const GltfWriter& writer, const Json& reference) {
    const Json& accessors = source_array(writer, "accessors");
    if (!reference.is_number_unsigned() || reference.get<std::uint64_t>() >= accessors.size())
        return std::nullopt;
    const auto index = reference.get<Index>();
    if (string_member(accessors[index], "type") != "SCALAR" ||
        !is_index_type(component_type(accessors[index])))
        return std::nullopt;
    return read_indices(writer.source, index);
}

/// The output vertices in an accessor of source vertices; none if one of them has no number.
std::optional<std::vector<Index>> renumbered(const GltfWriter& writer, const VertexNumbers& vertices,
                                             const Json& reference) {
    std::optional<std::vector<Index>> numbers = referenced_numbers(writer, reference);
    if (!numbers) return std::nullopt;
    for (Index& number : *numbers) {
        if (number >= vertices.size() || vertices[number] == no_index) return std::nullopt;
        number = vertices[number];
    }
    return numbers;
}

}  // namespace

std::optional<VertexNumbers> unchanged_vertices(const GltfWriter& writer, const Json& source,
                                                const PrimitiveData& data) {
    const Index position = index_member(member(source, "attributes"), "POSITION");
    if (position == no_index || primitive_mode(source) != triangle_list) return std::nullopt;
    const std::vector<Vec3> positions = read_vectors<double, 3>(writer.source, position);
    std::vector<Index> corners;
    if (source.contains("indices")) {
        corners = read_indices(writer.source, index_member(source, "indices"));
    } else {
        corners.resize(positions.size());
        std::iota(corners.begin(), corners.end(), Index{0});
    }
    if (corners.size() != data.corners.size()) return std::nullopt;
    VertexNumbers to(positions.size(), no_index);
    std::vector<Index> from(data.vertices.size(), no_index);
    for (std::size_t c = 0; c < corners.size(); ++c) {
        const Index old_vertex = corners[c], new_vertex = data.corners[c];
        if (to[old_vertex] == no_index && from[new_vertex] == no_index) {
            for (std::size_t k = 0; k < 3; ++k)
                if (static_cast<float>(positions[old_vertex][k]) != data.positions[new_vertex][k])
                    return std::nullopt;
            to[old_vertex] = new_vertex;
            from[new_vertex] = old_vertex;
        }
        if (to[old_vertex] != new_vertex || from[new_vertex] != old_vertex) return std::nullopt;
    }
    return to;
}

std::vector<std::string> remap_index_extensions(GltfWriter& writer, const VertexNumbers& vertices,
                                                Json& extensions) {
    std::vector<std::string> valid;
    if (extensions.contains(ngon_name)) valid.emplace_back(ngon_name);
    if (!extensions.contains(outline_name)) return valid;
    const auto outline = renumbered(writer, vertices, member(extensions[outline_name], "indices"));
    if (!outline) return valid;
    extensions[outline_name]["indices"] = writer.binary.add_indices(*outline, AccessorUse::other);
    valid.emplace_back(outline_name);
    return valid;
}

bool remap_manifold(GltfWriter& writer, const VertexNumbers& vertices, std::size_t corners,
                    const Json& primitive, Json& manifold) {
    const Json& joined = member(manifold, "manifoldPrimitive");
    const auto indices = renumbered(writer, vertices, member(joined, "indices"));
    if (!indices || indices->size() != corners) return false;
    const auto add_numbers = [&](const std::vector<Index>& numbers) {
        return writer.binary.add_indices(numbers, AccessorUse::other);
    };
    Json result = manifold;
    for (const auto& [name, accessor] : member(joined, "attributes").items()) {
        if (!member(primitive, "attributes").contains(name)) return false;
        result["manifoldPrimitive"]["attributes"][name] = primitive["attributes"][name];
    }
    const bool is_merged = manifold.contains("mergeIndices") || manifold.contains("mergeValues");
    if (is_merged) {
        const auto moved = referenced_numbers(writer, member(manifold, "mergeIndices"));
        const auto values = renumbered(writer, vertices, member(manifold, "mergeValues"));
        if (!moved || !values || moved->size() != values->size() ||
            std::any_of(moved->begin(), moved->end(), [&](Index corner) { return corner >= corners; }))
            return false;
        result["mergeIndices"] = add_numbers(*moved);
        result["mergeValues"] = add_numbers(*values);
    }
    result["manifoldPrimitive"]["indices"] = add_numbers(*indices);
    manifold = std::move(result);
    return true;
}

}  // namespace faqem::detail

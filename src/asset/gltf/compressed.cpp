#include "asset/gltf/compressed.hpp"

#include <algorithm>
#include <cstring>
#include <optional>
#include <utility>

#include "faqem/error.hpp"

namespace faqem::detail {
namespace {

constexpr std::uint64_t most_meshopt_ratio = 128;  // the vertex codec makes at most 64 bytes of one

[[maybe_unused]] std::span<const std::uint8_t> part_of(const std::vector<std::uint8_t>& buffer,
                                                       const Json& holder) {
    return std::span(buffer).subspan(number_of(holder, "byteOffset", 0), number_of(holder, "byteLength", 0));
}

std::uint64_t buffer_bytes(const SourceDocument& source) {
    std::uint64_t sum = 0;
    for (const auto& buffer : source.buffers) sum += buffer.size();
    return sum;
}

/// Adds bytes as a buffer of their own. \return its index
[[maybe_unused]] std::size_t add_buffer(SourceDocument& source, std::vector<std::uint8_t> bytes) {
    source.document["buffers"].push_back({{"byteLength", bytes.size()}});
    source.buffers.push_back(std::move(bytes));
    return source.buffers.size() - 1;
}

void erase_extension(Json& holder, const char* name) {
    if (!holder.contains("extensions")) return;
    holder["extensions"].erase(name);
    if (holder["extensions"].empty()) holder.erase("extensions");
}

void unpack_views(SourceDocument& source, const std::string& file) {
    if (!source.document.contains("bufferViews")) return;
    [[maybe_unused]] Allowance left(most_meshopt_ratio * buffer_bytes(source), file);
    Json& views = source.document["bufferViews"];
    for (std::uint64_t i = 0; i < views.size(); ++i) {
#ifdef FAQEM_WITH_MESHOPT
        const Json& packed = meshopt_of(source.document, views[i]);
        if (!packed.is_null()) {
            const std::string where = step("/bufferViews", i);
            left.take(number_of(views[i], "byteLength", 0), where, meshopt_name);
            std::vector<std::uint8_t> bytes = decode_meshopt(
                packed, part_of(source.buffers[index_of(packed, "buffer")], packed), file, where);
            views[i]["buffer"] = add_buffer(source, std::move(bytes));
            views[i].erase("byteOffset");
        }
#endif
        erase_extension(views[i], meshopt_name);
    }
}

#ifdef FAQEM_WITH_DRACO

/// Gives an accessor bytes of its own.
void set_bytes(SourceDocument& source, Json& accessor, std::vector<std::uint8_t> bytes) {
    const std::uint64_t size = bytes.size();
    const std::size_t buffer = add_buffer(source, std::move(bytes));
    Json& views = source.document["bufferViews"];
    accessor["bufferView"] = views.size();
    accessor.erase("byteOffset");
    views.push_back({{"buffer", buffer}, {"byteLength", size}});
}

/// Nothing where the type is too small for a corner.
std::optional<std::vector<std::uint8_t>> as_type(const std::vector<std::uint32_t>& corners,
                                                 ComponentType type) {
    const std::uint32_t size = component_size(static_cast<std::uint64_t>(type));
    const std::uint64_t end = std::uint64_t{1} << 8 * size;
    if (std::any_of(corners.begin(), corners.end(), [end](std::uint32_t v) { return v >= end; })) return {};
    std::vector<std::uint8_t> bytes(corners.size() * size);
    for (std::size_t i = 0; i < corners.size(); ++i) std::memcpy(&bytes[i * size], &corners[i], size);
    return bytes;
}

/// Corners and vertices; all attributes have as many of these.
std::uint64_t draco_elements(const Json& document, const Json& primitive) {
    const Json& accessors = document["accessors"];
    const auto count = [&](std::uint64_t accessor) { return number_of(accessors[accessor], "count", 0); };
    return count(index_of(primitive, "indices")) + count(primitive["attributes"].front().get<Index>());
}

void unpack_primitive(SourceDocument& source, const Json& primitive, const std::string& file,
                      const std::string& where) {
    const Json& packed = member(member(primitive, "extensions"), draco_name);
    const Json& view = source.document["bufferViews"][index_of(packed, "bufferView")];
    Json& accessors = source.document["accessors"];
    std::vector<Index> targets;
    std::vector<DracoAttribute> attributes;
    for (const auto& [name, id] : packed["attributes"].items()) {
        targets.push_back(index_of(primitive["attributes"], name.c_str()));
        const Json& accessor = accessors[targets.back()];
        attributes.push_back({id.get<std::uint32_t>(),
                              static_cast<ComponentType>(number_of(accessor, "componentType", 0)),
                              component_count(string_of(accessor, "type")),
                              {}});
    }
    Json& indices = accessors[index_of(primitive, "indices")];
    const std::vector<std::uint32_t> corners =
        decode_draco(part_of(source.buffers[index_of(view, "buffer")], view),
                     number_of(accessors[targets.front()], "count", 0), number_of(indices, "count", 0),
                     attributes, file, where);
    auto typed = as_type(corners, static_cast<ComponentType>(number_of(indices, "componentType", 0)));
    if (!typed)
        throw InputError(file, where,
                         std::string(draco_name) + ": has vertices beyond the type of the indices");
    for (std::size_t i = 0; i < targets.size(); ++i)
        set_bytes(source, accessors[targets[i]], std::move(attributes[i].bytes));
    set_bytes(source, indices, std::move(*typed));
}

#endif

void unpack_primitives(SourceDocument& source, const std::string& file) {
    if (!source.document.contains("meshes")) return;
    [[maybe_unused]] Allowance left(always_believed + most_per_byte * buffer_bytes(source), file);
    Json& meshes = source.document["meshes"];
    for (std::uint64_t m = 0; m < meshes.size(); ++m) {
        if (!meshes[m].contains("primitives")) continue;
        Json& primitives = meshes[m]["primitives"];
        for (std::uint64_t p = 0; p < primitives.size(); ++p) {
#ifdef FAQEM_WITH_DRACO
            if (needs_draco(source.document, primitives[p])) {
                const std::string where = step(step("/meshes", m) + "/primitives", p);
                left.take(draco_elements(source.document, primitives[p]), where, draco_name);
                unpack_primitive(source, primitives[p], file, where);
            }
#endif
            erase_extension(primitives[p], draco_name);
        }
    }
}

}  // namespace

void Allowance::take(std::uint64_t amount, const std::string& where, const char* extension) {
    if (amount > left_)
        throw InputError(
            file_, where,
            std::string(extension) + ": is more than all buffers can hold, with what is before it");
    left_ -= amount;
}

bool can_decode([[maybe_unused]] std::string_view extension) {
#ifdef FAQEM_WITH_MESHOPT
    if (extension == meshopt_name) return true;
#endif
#ifdef FAQEM_WITH_DRACO
    if (extension == draco_name) return true;
#endif
    return false;
}

std::string missing_decoder(std::string_view extension) {
    return std::string(extension) + " compressed data: this faqem was built without " +
           (extension == draco_name ? "Draco" : "meshoptimizer");
}

bool is_placeholder(const Json& buffer) {
    return !buffer.contains("uri") &&
           member(member(member(buffer, "extensions"), meshopt_name), "fallback") == true;
}

const Json& meshopt_of(const Json& document, const Json& view) {
    static const Json none;
    const bool plain = !is_placeholder(member(document, "buffers")[index_of(view, "buffer")]);
    return plain ? none : member(member(view, "extensions"), meshopt_name);
}

void check_meshopt(const GltfChecker& checker, const Json& view, const std::string& view_where) {
    const std::string where = view_where + "/extensions/" + meshopt_name;
    const Json& packed = member(member(view, "extensions"), meshopt_name);
    if (packed.is_null()) checker.fail(view_where, "lies in a buffer that has no bytes");
    if (!can_decode(meshopt_name)) checker.fail_unsupported(view_where, missing_decoder(meshopt_name));
    const std::uint64_t buffer = checker.needed_reference(packed, where, "buffer", "buffers");
    const Json& from = member(checker.document, "buffers")[buffer];
    if (is_placeholder(from)) checker.fail(step(where, "buffer"), "is a buffer that has no bytes");
    const std::uint64_t size = from["byteLength"].get<std::uint64_t>();
    const std::uint64_t offset = checker.number(packed, where, "byteOffset").value_or(0);
    const std::uint64_t length = checker.needed_number(packed, where, "byteLength");
    if (offset > size || length > size - offset)
        checker.fail(where, "needs " + std::to_string(length) + " bytes from byte " + std::to_string(offset) +
                                ", buffer " + std::to_string(buffer) + " has " + std::to_string(size));

    const std::uint64_t stride = checker.needed_number(packed, where, "byteStride");
    const std::uint64_t count = checker.needed_number(packed, where, "count");
    const std::string mode = string_of(packed, "mode"), filter = string_of(packed, "filter");
    const bool vertices = mode == "ATTRIBUTES", triangles = mode == "TRIANGLES";
    if (!vertices && !triangles && mode != "INDICES") checker.fail(step(where, "mode"), "is no known mode");
    const bool good_stride =
        vertices ? stride >= 4 && stride <= 256 && stride % 4 == 0 : stride == 2 || stride == 4;
    if (!good_stride) checker.fail(step(where, "byteStride"), "is " + std::to_string(stride));
    if (triangles && count % 3 != 0) checker.fail(step(where, "count"), "is no multiple of 3");
    const bool good_filter = filter.empty() || filter == "NONE" ||
                             (vertices && filter == "OCTAHEDRAL" && (stride == 4 || stride == 8)) ||
                             (vertices && filter == "QUATERNION" && stride == 8) ||
                             (vertices && filter == "EXPONENTIAL");
    if (!good_filter) checker.fail(step(where, "filter"), "is not known or does not fit the mode and stride");
    const std::uint64_t wanted = number_of(view, "byteLength", 0);
    if (count > wanted || count * stride != wanted)
        checker.fail(where, "makes " + std::to_string(count) + " times " + std::to_string(stride) +
                                " bytes, the bufferView has " + std::to_string(wanted));
    if (wanted / most_meshopt_ratio > length)
        checker.fail(
            where, "is damaged: " + std::to_string(length) + " bytes cannot hold " + std::to_string(wanted));
}

bool needs_draco(const Json& document, const Json& primitive) {
    if (!member(primitive, "extensions").contains(draco_name)) return false;
    const Json& accessors = member(document, "accessors");
    const auto is_bare = [&](Index accessor) {
        return accessor < accessors.size() && !accessors[accessor].contains("bufferView");
    };
    const Json& attributes = member(primitive, "attributes");
    return std::any_of(attributes.begin(), attributes.end(),
                       [&](const Json& a) { return is_bare(a.get<Index>()); }) ||
           is_bare(index_of(primitive, "indices"));
}

void check_draco(const GltfChecker& checker, const Json& primitive, const std::string& primitive_where) {
    const std::string where = primitive_where + "/extensions/" + draco_name;
    if (!can_decode(draco_name)) checker.fail_unsupported(primitive_where, missing_decoder(draco_name));
    const Json& packed = primitive["extensions"][draco_name];
    const std::uint64_t view = checker.needed_reference(packed, where, "bufferView", "bufferViews");
    const Json& described = member(checker.document, "bufferViews")[view];
    if (is_placeholder(member(checker.document, "buffers")[index_of(described, "buffer")]))
        checker.fail(step(where, "bufferView"), "lies in a buffer that has no bytes");
    if (number_of(primitive, "mode", 4) != 4)
        checker.fail_unsupported(step(primitive_where, "mode"), "strips in Draco data are not read");
    if (!primitive.contains("indices")) checker.fail(primitive_where, "has Draco data and no indices");
    const Json& attributes = checker.object(packed, where, "attributes");
    if (attributes.is_null() || attributes.empty()) checker.fail(where, "has no attributes");
    for (const auto& [name, id] : attributes.items()) {
        const std::string at = where + "/attributes/" + name;
        if (!id.is_number_unsigned() || id.get<std::uint64_t>() > UINT32_MAX)
            checker.fail(at, "is not an unsigned 32-bit integer");
        if (!primitive["attributes"].contains(name)) checker.fail(at, "is no attribute of the primitive");
    }
}

std::vector<char> draco_accessors(const Json& document) {
    std::vector<char> result(array_size(document, "accessors"), 0);
    const auto mark = [&](const Json& index) {
        if (index.is_number_unsigned() && index.get<std::uint64_t>() < result.size())
            result[index.get<std::uint64_t>()] = 1;
    };
    for (const Json& mesh : member(document, "meshes")) {
        for (const Json& primitive : member(mesh, "primitives")) {
            if (!member(primitive, "extensions").contains(draco_name)) continue;
            for (const Json& accessor : member(primitive, "attributes")) mark(accessor);
            mark(member(primitive, "indices"));
        }
    }
    return result;
}

void decompress(SourceDocument& source, const std::string& file) {
    unpack_views(source, file);
    unpack_primitives(source, file);
}

}  // namespace faqem::detail

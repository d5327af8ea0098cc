#include "asset/gltf/read/compressed.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <utility>

#ifdef FAQEM_WITH_MESHOPT
#include <meshoptimizer.h>
#endif

#include "asset/scene/messages.hpp"

namespace faqem::detail {
namespace {

constexpr std::uint64_t max_meshopt_ratio = 128;  // the vertex codec expands a byte to at most 64 bytes

std::uint64_t total_buffer_size(const SourceDocument& source) {
    std::uint64_t sum = 0;
    for (const auto& buffer : source.buffers) sum += buffer.size();
    return sum;
}

/// Adds a buffer. Returns its index.
[[maybe_unused]] std::size_t add_buffer(SourceDocument& source, std::vector<std::uint8_t> bytes) {
    source.document["buffers"].push_back({{"byteLength", bytes.size()}});
    source.buffers.push_back(std::move(bytes));
    return source.buffers.size() - 1;
}

void decompress_views(SourceDocument& source, const std::string& file) {
    [[maybe_unused]] DecompressionLimit limit{max_meshopt_ratio * total_buffer_size(source), file};
    const std::span<Json> views = elements(source.document, "bufferViews");
    for (std::uint64_t i = 0; i < views.size(); ++i) {
#ifdef FAQEM_WITH_MESHOPT
        const Json& compressed = meshopt_extension(source.document, views[i]);
        if (!compressed.is_null()) {
            const std::string where = child_path("/bufferViews", i);
            limit.consume(unsigned_member(views[i], "byteLength", 0), where, meshopt_name);
            std::vector<std::uint8_t> bytes =
                decode_meshopt(compressed, view_bytes(source, compressed), file, where);
            views[i]["buffer"] = add_buffer(source, std::move(bytes));
            views[i].erase("byteOffset");
            source.compression = Compression::meshopt;
        }
#endif
        erase_extension(views[i], meshopt_name);
    }
}

#ifdef FAQEM_WITH_MESHOPT

/// The filter OCTAHEDRAL of EXT_meshopt_compression for vectors of integers T. The instructions by which meshoptimizer approximates reciprocal square
/// roots have other results on other processors.
template <class T>
void decode_octahedral(std::vector<std::uint8_t>& bytes) {
    for (std::size_t at = 0; at < bytes.size(); at += 4 * sizeof(T)) {
        std::array<T, 3> v;  // two coordinates and the integer that means 1
        std::memcpy(v.data(), &bytes[at], sizeof v);
        float x = v[0], y = v[1];
        const float z = static_cast<float>(v[2]) - std::abs(x) - std::abs(y), fold = std::min(z, 0.0f);
        x += x >= 0 ? fold : -fold;
        y += y >= 0 ? fold : -fold;
        const float squared = x * x + (y * y + z * z);
        const float scale = squared > 0 ? std::numeric_limits<T>::max() / std::sqrt(squared) : 0;
        v = {static_cast<T>(std::nearbyint(x * scale)), static_cast<T>(std::nearbyint(y * scale)),
             static_cast<T>(std::nearbyint(z * scale))};
        std::memcpy(&bytes[at], v.data(), sizeof v);
    }
}

#endif
#ifdef FAQEM_WITH_DRACO

/// Stores the bytes of an accessor in a new buffer and view.
void set_bytes(SourceDocument& source, Json& accessor, std::vector<std::uint8_t> bytes) {
    const std::uint64_t size = bytes.size();
    const std::size_t buffer = add_buffer(source, std::move(bytes));
    Json& views = source.document["bufferViews"];
    accessor["bufferView"] = views.size();
    accessor.erase("byteOffset");
    views.push_back({{"buffer", buffer}, {"byteLength", size}});
}

/// Converts indices to the given component type; empty if an index is out of its range.
std::optional<std::vector<std::uint8_t>> encode_indices(const std::vector<std::uint32_t>& corners,
                                                        NumberType type) {
    const std::size_t size = number_size(type);
    const std::uint64_t end = std::uint64_t{1} << 8 * size;
    if (std::ranges::any_of(corners, [end](std::uint32_t v) { return v >= end; })) return {};
    std::vector<std::uint8_t> bytes(corners.size() * size);
    for (std::size_t i = 0; i < corners.size(); ++i) std::memcpy(&bytes[i * size], &corners[i], size);
    return bytes;
}

/// Number of corners plus number of vertices of a primitive.
std::uint64_t draco_element_count(const Json& document, const Json& primitive) {
    const auto count = [&](Index a) { return unsigned_member(document["accessors"][a], "count", 0); };
    return count(index_member(primitive, "indices")) + count(primitive["attributes"].front().get<Index>());
}

void decompress_primitive(SourceDocument& source, const Json& primitive, const std::string& file,
                          const std::string& where) {
    const Json& compressed = member(primitive, "extensions", draco_name);
    const Json& view = source.document["bufferViews"][index_member(compressed, "bufferView")];
    Json& accessors = source.document["accessors"];
    std::vector<Index> targets;
    std::vector<DracoAttribute> attributes;
    for (const auto& [name, id] : compressed["attributes"].items()) {
        targets.push_back(index_member(primitive["attributes"], name.c_str()));
        const Json& accessor = accessors[targets.back()];
        attributes.push_back({id.get<std::uint32_t>(),
                              component_type(accessor),
                              component_count(string_member(accessor, "type")),
                              {}});
    }
    Json& indices = accessors[index_member(primitive, "indices")];
    const std::vector<std::uint32_t> corners =
        decode_draco(view_bytes(source, view), unsigned_member(accessors[targets.front()], "count", 0),
                     unsigned_member(indices, "count", 0), attributes, file, where);
    auto typed = encode_indices(corners, component_type(indices));
    if (!typed)
        throw InputError(file, where,
                         std::string(draco_name) + ": has more vertices than the index type can address");
    for (std::size_t i = 0; i < targets.size(); ++i)
        set_bytes(source, accessors[targets[i]], std::move(attributes[i].bytes));
    set_bytes(source, indices, std::move(*typed));
}

#endif

void decompress_primitives(SourceDocument& source, const std::string& file) {
    [[maybe_unused]] DecompressionLimit limit{
        draco_base_element_limit + max_draco_elements_per_byte * total_buffer_size(source), file};
    const std::span<Json> meshes = elements(source.document, "meshes");
    for (std::uint64_t m = 0; m < meshes.size(); ++m) {
        const std::span<Json> primitives = elements(meshes[m], "primitives");
        for (std::uint64_t p = 0; p < primitives.size(); ++p) {
#ifdef FAQEM_WITH_DRACO
            if (needs_draco(source.document, primitives[p])) {
                const std::string where = child_path(child_path("/meshes", m) + "/primitives", p);
                limit.consume(draco_element_count(source.document, primitives[p]), where, draco_name);
                decompress_primitive(source, primitives[p], file, where);
                if (source.compression == Compression::none) source.compression = Compression::draco;
            }
#endif
            erase_extension(primitives[p], draco_name);
        }
    }
}

}  // namespace

#ifdef FAQEM_WITH_MESHOPT

std::vector<std::uint8_t> decode_meshopt(const Json& extension, std::span<const std::uint8_t> bytes,
                                         const std::string& file, const std::string& where) {
    const std::uint64_t count = unsigned_member(extension, "count", 0),
                        stride = unsigned_member(extension, "byteStride", 0);
    const std::string mode = string_member(extension, "mode"), filter = string_member(extension, "filter");
    std::vector<std::uint8_t> result(count * stride);
    int error = 0;
    if (mode == "ATTRIBUTES")
        error = meshopt_decodeVertexBuffer(result.data(), count, stride, bytes.data(), bytes.size());
    else if (mode == "TRIANGLES")
        error = meshopt_decodeIndexBuffer(result.data(), count, stride, bytes.data(), bytes.size());
    else
        error = meshopt_decodeIndexSequence(result.data(), count, stride, bytes.data(), bytes.size());
    if (error != 0) throw InputError(file, where, std::string(meshopt_name) + ": the data is damaged");
    if (filter == "OCTAHEDRAL" && stride == 4) decode_octahedral<std::int8_t>(result);
    if (filter == "OCTAHEDRAL" && stride == 8) decode_octahedral<std::int16_t>(result);
    if (filter == "QUATERNION") meshopt_decodeFilterQuat(result.data(), count, stride);
    if (filter == "EXPONENTIAL") meshopt_decodeFilterExp(result.data(), count, stride);
    return result;
}

#endif

std::string missing_decoder_message(std::string_view extension) {
    return std::string(extension) + " compressed data: faqem was built without " +
           (extension == draco_name ? "Draco" : "meshoptimizer");
}

bool is_fallback_buffer(const Json& buffer) {
    return !buffer.contains("uri") && member(buffer, "extensions", meshopt_name, "fallback") == true;
}

bool has_fallback_buffer(const Json& document, const Json& view) {
    return is_fallback_buffer(member(document, "buffers")[index_member(view, "buffer")]);
}

const Json& meshopt_extension(const Json& document, const Json& view) {
    static const Json none;
    return has_fallback_buffer(document, view) ? member(view, "extensions", meshopt_name) : none;
}

const Json& checked_buffer(const CheckedJson& view) {
    const std::uint64_t buffer = view.required_reference("buffer", "buffers");
    const Json& json = view.element("buffers", buffer);
    const auto size = json["byteLength"].get<std::uint64_t>();
    const std::uint64_t offset = view.number("byteOffset").value_or(0);
    const std::uint64_t length = view.required_number("byteLength");
    if (offset > size || length > size - offset)
        view.fail("needs " + bytes_text(length) + " at offset " + std::to_string(offset) + ", buffer " +
                  std::to_string(buffer) + " has " + std::to_string(size));
    return json;
}

void check_meshopt(const CheckedJson& view) {
    const CheckedJson compressed = view.member("extensions").member(meshopt_name);
    if (compressed.json.is_null()) view.fail("refers to a buffer without data");
    if (!has_codec(meshopt_name)) view.fail_unsupported(missing_decoder_message(meshopt_name));
    compressed.required_reference("buffer", "buffers");
    if (has_fallback_buffer(view.document, compressed.json))
        compressed.fail_at("buffer", "is a buffer without data");
    checked_buffer(compressed);
    const std::uint64_t length = compressed.required_number("byteLength");
    const std::uint64_t stride = compressed.required_number("byteStride");
    const std::uint64_t count = compressed.required_number("count");
    const std::string mode = string_member(compressed.json, "mode"),
                      filter = string_member(compressed.json, "filter");
    const bool vertices = mode == "ATTRIBUTES", triangles = mode == "TRIANGLES";
    if (!vertices && !triangles && mode != "INDICES")
        compressed.fail_at("mode", "must be ATTRIBUTES, TRIANGLES or INDICES");
    const bool good_stride =
        vertices ? stride >= 4 && stride <= 256 && stride % 4 == 0 : stride == 2 || stride == 4;
    if (!good_stride) compressed.fail_at("byteStride", "is invalid for the mode: " + std::to_string(stride));
    if (triangles && count % 3 != 0) compressed.fail_at("count", "is not a multiple of 3");
    const bool good_filter = filter.empty() || filter == "NONE" ||
                             (vertices && filter == "OCTAHEDRAL" && (stride == 4 || stride == 8)) ||
                             (vertices && filter == "QUATERNION" && stride == 8) ||
                             (vertices && filter == "EXPONENTIAL");
    if (!good_filter) compressed.fail_at("filter", "is unknown or does not match the mode and stride");
    const std::uint64_t wanted = unsigned_member(view.json, "byteLength", 0);
    if (count > wanted || count * stride != wanted)
        compressed.fail("decodes to " + std::to_string(count) + " times " + std::to_string(stride) +
                        " bytes, the bufferView has " + std::to_string(wanted));
    if (wanted / max_meshopt_ratio > length)
        compressed.fail("is damaged: " + std::to_string(length) + " bytes cannot hold " +
                        std::to_string(wanted));
}

bool needs_draco(const Json& document, const Json& primitive) {
    if (!member(primitive, "extensions").contains(draco_name)) return false;
    const Json& accessors = member(document, "accessors");
    const auto has_no_buffer_view = [&](Index accessor) {
        return accessor < accessors.size() && !accessors[accessor].contains("bufferView");
    };
    const Json& attributes = member(primitive, "attributes");
    return std::ranges::any_of(attributes,
                               [&](const Json& a) { return has_no_buffer_view(a.get<Index>()); }) ||
           has_no_buffer_view(index_member(primitive, "indices"));
}

void check_draco(const CheckedJson& primitive) {
    if (!has_codec(draco_name)) primitive.fail_unsupported(missing_decoder_message(draco_name));
    const CheckedJson compressed = primitive.member("extensions").member(draco_name);
    const std::uint64_t view = compressed.required_reference("bufferView", "bufferViews");
    if (has_fallback_buffer(primitive.document, primitive.element("bufferViews", view)))
        compressed.fail_at("bufferView", "refers to a buffer without data");
    if (primitive_mode(primitive.json) != triangle_list)
        primitive.member("mode").fail_unsupported("triangle strips in Draco data are not supported");
    if (!primitive.json.contains("indices")) primitive.fail("has Draco data but no indices");
    const CheckedJson attributes = compressed.object("attributes");
    if (attributes.json.empty()) compressed.fail("has no attributes");
    attributes.members([&](const std::string& name, const CheckedJson& id) {
        if (!id.json.is_number_unsigned() || id.json.get<std::uint64_t>() > UINT32_MAX)
            id.fail("is not an unsigned 32-bit integer");
        if (!primitive.json["attributes"].contains(name)) id.fail("is not an attribute of the primitive");
    });
}

std::vector<char> draco_accessor_flags(const Json& document) {
    std::vector<char> result(array_size(document, "accessors"), 0);
    const auto mark = [&](const Json& accessor) {
        if (const std::optional<Index> index = valid_index(accessor, result.size())) result[*index] = 1;
    };
    for (const Json& mesh : member(document, "meshes"))
        for (const Json& primitive : member(mesh, "primitives")) {
            if (!member(primitive, "extensions").contains(draco_name)) continue;
            for (const Json& accessor : member(primitive, "attributes")) mark(accessor);
            mark(member(primitive, "indices"));
        }
    return result;
}

void decompress(SourceDocument& source, const std::string& file) {
    decompress_views(source, file);
    decompress_primitives(source, file);
}

}  // namespace faqem::detail

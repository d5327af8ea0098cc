#include "asset/gltf/accessor.hpp"
#include "asset/gltf/read/checker.hpp"
#include "asset/gltf/read/compressed.hpp"
#include "asset/scene/messages.hpp"

namespace faqem::detail {
namespace {

constexpr std::uint64_t max_stride = 252;

void check_buffer(const GltfChecker& checker, const Json& buffer, const std::string& where) {
    if (checker.required_number(buffer, where, "byteLength") == 0)
        checker.fail(child_path(where, "byteLength"), "is 0");
    const Json& uri = member(buffer, "uri");
    if (!uri.is_null() && !uri.is_string()) checker.fail(child_path(where, "uri"), "is not a string");
}

void check_view(const GltfChecker& checker, const Json& view, const std::string& where) {
    const std::uint64_t buffer = checker.required_reference(view, where, "buffer", "buffers");
    const std::uint64_t offset = checker.number(view, where, "byteOffset").value_or(0);
    const std::uint64_t length = checker.required_number(view, where, "byteLength");
    const Json& buffer_json = member(checker.document, "buffers")[buffer];
    const auto size = buffer_json["byteLength"].get<std::uint64_t>();
    if (length == 0) checker.fail(child_path(where, "byteLength"), "is 0");
    if (offset > size || length > size - offset)
        checker.fail(where, "needs " + bytes_text(length) + " at offset " + std::to_string(offset) +
                                ", buffer " + std::to_string(buffer) + " has " + std::to_string(size));
    if (is_fallback_buffer(buffer_json)) check_meshopt(checker, view, where);
    const auto stride = checker.number(view, where, "byteStride");
    if (stride && (*stride < 4 || *stride > max_stride || *stride % 4 != 0))
        checker.fail(child_path(where, "byteStride"),
                     "is " + std::to_string(*stride) + ", not a multiple of 4 between 4 and 252");
}

/// Checks that `count` elements of `size` bytes with a distance of `stride` bytes fit into a view.
void check_range(const GltfChecker& checker, const std::string& where, std::uint64_t view,
                 std::uint64_t offset, std::uint64_t count, std::uint64_t size, std::uint64_t stride) {
    const auto length = member(checker.document, "bufferViews")[view]["byteLength"].get<std::uint64_t>();
    // Every element takes at least one byte. A count above the length fails; smaller counts do not overflow.
    if (count > length || offset > length || (count - 1) * stride + size > length - offset)
        checker.fail(where, "needs " +
                                (count > length ? std::to_string(count) + " elements"
                                                : bytes_text(offset + (count - 1) * stride + size)) +
                                ", bufferView " + std::to_string(view) + " has " + std::to_string(length) +
                                (count > length ? " bytes" : ""));
}

void check_sparse_layout(const GltfChecker& checker, const Json& sparse, const std::string& where,
                         std::uint64_t accessor_count, std::uint64_t size) {
    const std::uint64_t count = checker.required_number(sparse, where, "count");
    if (count == 0 || count > accessor_count)
        checker.fail(child_path(where, "count"), "is " + std::to_string(count) + ", the accessor has " +
                                                     std::to_string(accessor_count) + " elements");
    for (const char* key : {"indices", "values"}) {
        const std::string at = child_path(where, key);
        const Json& part = checker.object(sparse, where, key);
        if (part.is_null()) checker.fail(where, std::string("has no ") + key);
        const std::uint64_t view = checker.required_reference(part, at, "bufferView", "bufferViews");
        const std::uint64_t offset = checker.number(part, at, "byteOffset").value_or(0);
        std::uint64_t bytes = size;
        if (key == std::string("indices")) {
            const auto type = static_cast<NumberType>(checker.required_number(part, at, "componentType"));
            if (!is_index_type(type))
                checker.fail(child_path(at, "componentType"), "is not an unsigned integer type");
            bytes = number_size(type);
        }
        check_range(checker, at, view, offset, count, bytes, bytes);
    }
}

std::uint64_t declared_buffer_size(const Json& document) {
    std::uint64_t total = 0;
    for (const Json& buffer : member(document, "buffers")) {
        if (is_fallback_buffer(buffer)) continue;
        const auto length = buffer["byteLength"].get<std::uint64_t>();
        total = length > UINT64_MAX - total ? UINT64_MAX : total + length;
    }
    return total;
}

void check_accessor(const GltfChecker& checker, const Json& accessor, const std::string& where,
                    std::uint64_t file_bytes) {
    const std::uint64_t component = checker.required_number(accessor, where, "componentType");
    if (!is_component_type(component))
        checker.fail(child_path(where, "componentType"),
                     "is " + std::to_string(component) + ", which is not a type of glTF 2.0");
    const std::string type = string_member(accessor, "type");
    if (component_count(type) == 0)
        checker.fail(child_path(where, "type"), "'" + type + "' is not a type of glTF 2.0");
    const Json& normalized = member(accessor, "normalized");
    if (!normalized.is_null() && !normalized.is_boolean())
        checker.fail(child_path(where, "normalized"), "is neither true nor false");
    const std::uint64_t count = checker.required_number(accessor, where, "count");
    if (count == 0) checker.fail(child_path(where, "count"), "is 0");
    const std::uint64_t size = element_size(accessor);
    const std::uint64_t offset = checker.number(accessor, where, "byteOffset").value_or(0);

    if (const auto view = checker.reference(accessor, where, "bufferView", "bufferViews")) {
        const Json& buffer_view = member(checker.document, "bufferViews")[*view];
        const std::uint64_t stride = unsigned_member(buffer_view, "byteStride", size);
        if (stride < size)
            checker.fail(where, "has elements of " + bytes_text(size) + ", bufferView " +
                                    std::to_string(*view) + " has a stride of " + std::to_string(stride));
        check_range(checker, where, *view, offset, count, size, stride);
    } else if (count > file_bytes) {
        // All elements are zero and no bytes confirm the count, which is therefore limited by the file size.
        checker.fail(child_path(where, "count"), "is " + std::to_string(count) +
                                                     " without a bufferView, all buffers have " +
                                                     bytes_text(file_bytes));
    }
    const Json& sparse = checker.object(accessor, where, "sparse");
    if (!sparse.is_null()) check_sparse_layout(checker, sparse, child_path(where, "sparse"), count, size);
}

}  // namespace

void check_accessors(const GltfChecker& checker) {
    checker.for_each_object("buffers", check_buffer);
    checker.for_each_object("bufferViews", check_view);
    const Json& accessors = member(checker.document, "accessors");
    const std::uint64_t file_bytes = declared_buffer_size(checker.document);
    const std::uint64_t max_draco_elements =
        draco_base_element_limit +
        std::min(file_bytes, UINT64_MAX / max_draco_elements_per_byte - draco_base_element_limit) *
            max_draco_elements_per_byte;
    const std::vector<char> draco = draco_accessor_flags(checker.document);
    for (std::uint64_t i = 0; i < accessors.size(); ++i)
        check_accessor(checker, accessors[i], child_path("/accessors", i),
                       draco[i] ? max_draco_elements : file_bytes);
}

}  // namespace faqem::detail

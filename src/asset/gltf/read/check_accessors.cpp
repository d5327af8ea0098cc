#include "asset/gltf/accessor.hpp"
#include "asset/gltf/read/checker.hpp"
#include "asset/gltf/read/compressed.hpp"
#include "asset/scene/messages.hpp"

namespace faqem::detail {
namespace {

constexpr std::uint64_t max_stride = 252;

void check_buffer(const CheckedJson& buffer) {
    if (buffer.required_number("byteLength") == 0) buffer.fail_at("byteLength", "is 0");
    buffer.string("uri");
}

void check_view(const CheckedJson& view) {
    const Json& buffer = checked_buffer(view);
    if (view.number("byteLength") == 0) view.fail_at("byteLength", "is 0");
    if (is_fallback_buffer(buffer)) check_meshopt(view);
    const auto stride = view.number("byteStride");
    if (stride && (*stride < 4 || *stride > max_stride || *stride % 4 != 0))
        view.fail_at("byteStride",
                     "is " + std::to_string(*stride) + ", not a multiple of 4 between 4 and 252");
}

/// Checks that `count` elements of `size` bytes with a distance of `stride` bytes fit into a view.
/// \param holder  of the reference to the view
void check_range(const CheckedJson& holder, std::uint64_t view, std::uint64_t count, std::uint64_t size,
                 std::uint64_t stride) {
    const std::uint64_t offset = holder.number("byteOffset").value_or(0);
    const auto length = holder.element("bufferViews", view)["byteLength"].get<std::uint64_t>();
    // Every element takes at least one byte. A count above the length fails; smaller counts do not overflow.
    if (count > length || offset > length || (count - 1) * stride + size > length - offset)
        holder.fail("needs " +
                    (count > length ? std::to_string(count) + " elements"
                                    : bytes_text(offset + (count - 1) * stride + size)) +
                    ", bufferView " + std::to_string(view) + " has " + std::to_string(length) +
                    (count > length ? " bytes" : ""));
}

void check_sparse_layout(const CheckedJson& sparse, std::uint64_t accessor_count, std::uint64_t size) {
    const std::uint64_t count = sparse.required_number("count");
    if (count == 0 || count > accessor_count)
        sparse.fail_at("count", "is " + std::to_string(count) + ", the accessor has " +
                                    std::to_string(accessor_count) + " elements");
    for (const std::string key : {"indices", "values"}) {
        const CheckedJson part = sparse.required_object(key.c_str());
        const std::uint64_t view = part.required_reference("bufferView", "bufferViews");
        std::uint64_t bytes = size;
        if (key == "indices") {
            const auto type = static_cast<NumberType>(part.required_number("componentType"));
            if (!is_index_type(type)) part.fail_at("componentType", "is not an unsigned integer type");
            bytes = number_size(type);
        }
        check_range(part, view, count, bytes, bytes);
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

void check_accessor(const CheckedJson& accessor, std::uint64_t file_bytes) {
    const std::uint64_t component = accessor.required_number("componentType");
    if (!is_component_type(component))
        accessor.fail_at("componentType",
                         "is " + std::to_string(component) + ", which is not a type of glTF 2.0");
    const std::string type = string_member(accessor.json, "type");
    if (component_count(type) == 0) accessor.fail_at("type", "'" + type + "' is not a type of glTF 2.0");
    const Json& normalized = member(accessor.json, "normalized");
    if (!normalized.is_null() && !normalized.is_boolean())
        accessor.fail_at("normalized", "is neither true nor false");
    const std::uint64_t count = accessor.required_number("count");
    if (count == 0) accessor.fail_at("count", "is 0");
    const std::uint64_t size = element_size(accessor.json);
    if (const auto view = accessor.reference("bufferView", "bufferViews")) {
        const std::uint64_t stride =
            unsigned_member(accessor.element("bufferViews", *view), "byteStride", size);
        if (stride < size)
            accessor.fail("has elements of " + bytes_text(size) + ", bufferView " + std::to_string(*view) +
                          " has a stride of " + std::to_string(stride));
        check_range(accessor, *view, count, size, stride);
    } else if (count > file_bytes) {
        // All elements are zero and no bytes confirm the count, which is therefore limited by the file size.
        accessor.fail_at("count", "is " + std::to_string(count) + " without a bufferView, all buffers have " +
                                      bytes_text(file_bytes));
    }
    const CheckedJson sparse = accessor.object("sparse");
    if (!sparse.json.is_null()) check_sparse_layout(sparse, count, size);
}

}  // namespace

void check_accessors(const CheckedJson& document) {
    document.for_each("buffers", check_buffer);
    document.for_each("bufferViews", check_view);
    const std::uint64_t file_bytes = declared_buffer_size(document.json);
    const std::uint64_t max_draco_elements =
        draco_base_element_limit +
        std::min(file_bytes, UINT64_MAX / max_draco_elements_per_byte - draco_base_element_limit) *
            max_draco_elements_per_byte;
    const std::vector<char> draco = draco_accessor_flags(document.json);
    std::size_t next = 0;
    document.for_each("accessors", [&](const CheckedJson& accessor) {
        check_accessor(accessor, draco[next++] ? max_draco_elements : file_bytes);
    });
}

}  // namespace faqem::detail

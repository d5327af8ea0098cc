#include "asset/gltf/accessor.hpp"

#include <algorithm>
#include <bit>
#include <cstring>

#include "faqem/error.hpp"

namespace faqem::detail {
namespace {

static_assert(std::endian::native == std::endian::little,
              "glTF buffers are little-endian and copied without conversion");

/// The first byte of the view that `holder` (an accessor or a sparse member) refers to, offsets included.
/// \param stride  in: the default stride; out: the stride of the view; may be null
const std::uint8_t* view_bytes(const SourceDocument& source, const Json& holder, std::uint64_t* stride) {
    const Json& view = member(source.document, "bufferViews")[index_member(holder, "bufferView")];
    if (stride) *stride = unsigned_member(view, "byteStride", *stride);
    return source.buffers[index_member(view, "buffer")].data() + unsigned_member(view, "byteOffset", 0) +
           unsigned_member(holder, "byteOffset", 0);
}

template <class T>
T load(const std::uint8_t* bytes) {
    T value;
    std::memcpy(&value, bytes, sizeof value);
    return value;
}

/// Loads an unsigned integer of type u8, u16 or u32.
std::uint32_t load_unsigned(const std::uint8_t* bytes, ComponentType type) {
    if (type == ComponentType::u8) return *bytes;
    return type == ComponentType::u16 ? load<std::uint16_t>(bytes) : load<std::uint32_t>(bytes);
}

std::vector<std::uint32_t> sparse_indices(const SourceDocument& source, const Json& sparse) {
    const Json& indices = sparse["indices"];
    const auto type = static_cast<ComponentType>(unsigned_member(indices, "componentType", 0));
    const std::uint8_t* bytes = view_bytes(source, indices, nullptr);
    std::vector<std::uint32_t> result(unsigned_member(sparse, "count", 0));
    for (std::uint32_t& index : result) {
        index = load_unsigned(bytes, type);
        bytes += component_size(static_cast<std::uint64_t>(type));
    }
    return result;
}

template <class T>
T from_normalized(double value, double largest) {
    return static_cast<T>(std::max(value / largest, -1.0));
}

template <class T>
T load_number(const std::uint8_t* bytes, ComponentType type, bool is_normalized) {
    switch (type) {
        case ComponentType::i8: {
            const auto value = load<std::int8_t>(bytes);
            return is_normalized ? from_normalized<T>(value, 127) : static_cast<T>(value);
        }
        case ComponentType::u8:
            return is_normalized ? from_normalized<T>(*bytes, 255) : static_cast<T>(*bytes);
        case ComponentType::i16: {
            const auto value = load<std::int16_t>(bytes);
            return is_normalized ? from_normalized<T>(value, 32767) : static_cast<T>(value);
        }
        case ComponentType::u16: {
            const auto value = load<std::uint16_t>(bytes);
            return is_normalized ? from_normalized<T>(value, 65535) : static_cast<T>(value);
        }
        case ComponentType::u32:
            return static_cast<T>(load<std::uint32_t>(bytes));
        case ComponentType::f32:
            break;
    }
    return static_cast<T>(load<float>(bytes));
}

const Json& accessor_at(const SourceDocument& source, Index accessor) {
    return member(source.document, "accessors")[accessor];
}

}  // namespace

std::uint32_t component_size(std::uint64_t type) {
    switch (type) {
        case 5120:
        case 5121:
            return 1;
        case 5122:
        case 5123:
            return 2;
        case 5125:
        case 5126:
            return 4;
        default:
            return 0;
    }
}

std::uint32_t component_count(const std::string& type) {
    if (type == "SCALAR") return 1;
    if (type == "VEC2") return 2;
    if (type == "VEC3") return 3;
    if (type == "VEC4" || type == "MAT2") return 4;
    if (type == "MAT3") return 9;
    return type == "MAT4" ? 16 : 0;
}

std::uint32_t element_size(std::uint64_t component_type, const std::string& type) {
    const std::uint32_t component = component_size(component_type);
    if (type.compare(0, 3, "MAT") != 0) return component * component_count(type);
    const std::uint32_t columns = type == "MAT2" ? 2 : type == "MAT3" ? 3 : 4;
    return columns * ((columns * component + 3) / 4 * 4);
}

double integer_step(const Json& accessor) {
    const bool is_normalized = member(accessor, "normalized") == true;
    switch (static_cast<ComponentType>(unsigned_member(accessor, "componentType", 0))) {
        case ComponentType::i8:
            return is_normalized ? 1.0 / 127 : 1;
        case ComponentType::u8:
            return is_normalized ? 1.0 / 255 : 1;
        case ComponentType::i16:
            return is_normalized ? 1.0 / 32767 : 1;
        case ComponentType::u16:
            return is_normalized ? 1.0 / 65535 : 1;
        default:
            return 0;
    }
}

std::vector<std::uint8_t> dense_bytes(const SourceDocument& source, Index index) {
    const Json& accessor = accessor_at(source, index);
    const std::uint64_t size =
        element_size(unsigned_member(accessor, "componentType", 0), string_member(accessor, "type"));
    const std::uint64_t count = unsigned_member(accessor, "count", 0);
    std::vector<std::uint8_t> dense(count * size);
    if (accessor.contains("bufferView")) {
        std::uint64_t stride = size;
        const std::uint8_t* bytes = view_bytes(source, accessor, &stride);
        if (stride == size)
            std::memcpy(dense.data(), bytes, dense.size());
        else
            for (std::uint64_t i = 0; i < count; ++i)
                std::memcpy(dense.data() + i * size, bytes + i * stride, size);
    }
    const Json& sparse = member(accessor, "sparse");
    if (!sparse.is_null()) {
        const std::uint8_t* values = view_bytes(source, sparse["values"], nullptr);
        for (const std::uint32_t element : sparse_indices(source, sparse)) {
            std::memcpy(dense.data() + element * size, values, size);
            values += size;
        }
    }
    return dense;
}

template <class T, std::size_t N>
std::vector<std::array<T, N>> read_vectors(const SourceDocument& source, Index index, T fill) {
    const Json& accessor = accessor_at(source, index);
    const std::vector<std::uint8_t> dense = dense_bytes(source, index);
    const auto type = static_cast<ComponentType>(unsigned_member(accessor, "componentType", 0));
    const std::uint32_t step = component_size(static_cast<std::uint64_t>(type));
    const std::size_t components = component_count(string_member(accessor, "type"));
    const bool is_normalized = member(accessor, "normalized") == true && type != ComponentType::f32;
    std::vector<std::array<T, N>> result(unsigned_member(accessor, "count", 0));
    const std::uint8_t* bytes = dense.data();
    for (std::array<T, N>& element : result) {
        element.fill(fill);
        for (std::size_t c = 0; c < components; ++c, bytes += step)
            if (c < N) element[c] = load_number<T>(bytes, type, is_normalized);
    }
    return result;
}

template std::vector<Vec3> read_vectors<double, 3>(const SourceDocument&, Index, double);
template std::vector<std::array<double, 4>> read_vectors<double, 4>(const SourceDocument&, Index, double);
template std::vector<Vec2f> read_vectors<float, 2>(const SourceDocument&, Index, float);
template std::vector<Vec3f> read_vectors<float, 3>(const SourceDocument&, Index, float);
template std::vector<Vec4f> read_vectors<float, 4>(const SourceDocument&, Index, float);

std::vector<Index> read_indices(const SourceDocument& source, Index index) {
    const Json& accessor = accessor_at(source, index);
    const std::vector<std::uint8_t> dense = dense_bytes(source, index);
    const auto type = static_cast<ComponentType>(unsigned_member(accessor, "componentType", 0));
    const std::uint32_t step = component_size(static_cast<std::uint64_t>(type));
    std::vector<Index> result(unsigned_member(accessor, "count", 0));
    const std::uint8_t* bytes = dense.data();
    for (Index& element : result) {
        element = load_unsigned(bytes, type);
        bytes += step;
    }
    return result;
}

std::vector<std::array<std::uint16_t, 4>> read_joints(const SourceDocument& source, Index index) {
    const Json& accessor = accessor_at(source, index);
    const std::vector<std::uint8_t> dense = dense_bytes(source, index);
    const auto type = static_cast<ComponentType>(unsigned_member(accessor, "componentType", 0));
    const std::uint32_t step = component_size(static_cast<std::uint64_t>(type));
    std::vector<std::array<std::uint16_t, 4>> result(unsigned_member(accessor, "count", 0));
    const std::uint8_t* bytes = dense.data();
    for (auto& element : result)
        for (std::uint16_t& joint : element) {
            joint = static_cast<std::uint16_t>(load_unsigned(bytes, type));
            bytes += step;
        }
    return result;
}

void check_sparse(const SourceDocument& source, const std::string& file) {
    const Json& accessors = member(source.document, "accessors");
    for (std::uint64_t i = 0; i < accessors.size(); ++i) {
        const Json& sparse = member(accessors[i], "sparse");
        if (sparse.is_null()) continue;
        const std::string where = child_path("/accessors", i) + "/sparse/indices";
        const std::uint64_t count = unsigned_member(accessors[i], "count", 0);
        std::int64_t previous = -1;
        for (const std::uint32_t index : sparse_indices(source, sparse)) {
            if (index >= count)
                throw InputError(file, where,
                                 "contains index " + std::to_string(index) + ", the accessor has " +
                                     std::to_string(count) + " elements");
            if (index <= previous)
                throw InputError(file, where,
                                 "is not increasing: " + std::to_string(index) + " comes after " +
                                     std::to_string(previous));
            previous = index;
        }
    }
}

}  // namespace faqem::detail

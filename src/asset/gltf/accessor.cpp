#include "asset/gltf/accessor.hpp"

#include <algorithm>
#include <cstring>
#include <limits>
#include <type_traits>

#include "faqem/error.hpp"

namespace faqem::detail {
namespace {

/// The first byte of the view that `holder` (an accessor or a sparse member) refers to, offsets included.
/// \param stride  in: the default stride; out: the stride of the view; may be null
const std::uint8_t* first_byte(const SourceDocument& source, const Json& holder, std::uint64_t* stride) {
    const Json& view = member(source.document, "bufferViews")[index_member(holder, "bufferView")];
    if (stride) *stride = unsigned_member(view, "byteStride", *stride);
    return view_bytes(source, view).data() + unsigned_member(holder, "byteOffset", 0);
}

std::vector<std::uint32_t> sparse_indices(const SourceDocument& source, const Json& sparse) {
    const Json& indices = sparse["indices"];
    const std::uint8_t* bytes = first_byte(source, indices, nullptr);
    std::vector<std::uint32_t> result(unsigned_member(sparse, "count", 0));
    visit_type(component_type(indices), [&](auto number) {
        for (std::uint32_t& index : result) {
            index = static_cast<std::uint32_t>(load_number<decltype(number)>(bytes));
            bytes += sizeof number;
        }
    });
    return result;
}

template <class T, class Stored>
T converted_number(Stored value, bool is_normalized) {
    constexpr double largest{std::numeric_limits<Stored>::max()};
    if (std::is_floating_point_v<T> && std::is_integral_v<Stored> && is_normalized)
        return static_cast<T>(std::max(value / largest, -1.0));
    return static_cast<T>(value);
}

const Json& accessor_at(const SourceDocument& source, Index accessor) {
    return member(source.document, "accessors")[accessor];
}

/// Writes N numbers for each element of an accessor to `to`.
template <std::size_t N, class T>
void copy_elements(const SourceDocument& source, Index index, T fill, T* to) {
    const Json& accessor = accessor_at(source, index);
    const std::vector<std::uint8_t> dense = dense_bytes(source, index);
    const std::size_t components = component_count(string_member(accessor, "type"));
    const std::uint64_t count = unsigned_member(accessor, "count", 0);
    const bool is_normalized = member(accessor, "normalized") == true;
    visit_type(component_type(accessor), [&](auto number) {
        const std::uint8_t* bytes = dense.data();
        for (T* const end = to + count * N; to != end; to += N) {
            std::fill_n(to, N, fill);
            for (std::size_t c = 0; c < components; ++c, bytes += sizeof number)
                if (c < N) to[c] = converted_number<T>(load_number<decltype(number)>(bytes), is_normalized);
        }
    });
}

}  // namespace

std::uint32_t component_count(const std::string& type) {
    if (type == "SCALAR") return 1;
    if (type == "VEC2") return 2;
    if (type == "VEC3") return 3;
    if (type == "VEC4" || type == "MAT2") return 4;
    if (type == "MAT3") return 9;
    return type == "MAT4" ? 16 : 0;
}

std::size_t element_size(const Json& accessor) {
    const std::string type = string_member(accessor, "type");
    const std::size_t component = number_size(component_type(accessor));
    if (!type.starts_with("MAT")) return component * component_count(type);
    const std::size_t columns = type == "MAT2" ? 2 : type == "MAT3" ? 3 : 4;
    return columns * ((columns * component + 3) / 4 * 4);
}

double integer_step(const Json& accessor) {
    return visit_type(component_type(accessor), [&](auto number) -> double {
        if (sizeof number > 2) return 0;
        return member(accessor, "normalized") == true ? 1.0 / std::numeric_limits<decltype(number)>::max()
                                                      : 1;
    });
}

std::span<const std::uint8_t> view_bytes(const SourceDocument& source, const Json& view) {
    return std::span(source.buffers[index_member(view, "buffer")])
        .subspan(unsigned_member(view, "byteOffset", 0), unsigned_member(view, "byteLength", 0));
}

std::vector<std::uint8_t> dense_bytes(const SourceDocument& source, Index index) {
    const Json& accessor = accessor_at(source, index);
    const std::uint64_t size = element_size(accessor);
    const std::uint64_t count = unsigned_member(accessor, "count", 0);
    std::vector<std::uint8_t> dense(count * size);
    if (accessor.contains("bufferView")) {
        std::uint64_t stride = size;
        const std::uint8_t* bytes = first_byte(source, accessor, &stride);
        if (stride == size)
            std::memcpy(dense.data(), bytes, dense.size());
        else
            for (std::uint64_t i = 0; i < count; ++i)
                std::memcpy(dense.data() + i * size, bytes + i * stride, size);
    }
    const Json& sparse = member(accessor, "sparse");
    if (!sparse.is_null()) {
        const std::uint8_t* values = first_byte(source, sparse["values"], nullptr);
        for (const std::uint32_t element : sparse_indices(source, sparse)) {
            std::memcpy(dense.data() + element * size, values, size);
            values += size;
        }
    }
    return dense;
}

template <class T, std::size_t N>
std::vector<std::array<T, N>> read_vectors(const SourceDocument& source, Index index, T fill) {
    std::vector<std::array<T, N>> result(unsigned_member(accessor_at(source, index), "count", 0));
    copy_elements<N>(source, index, fill, result.front().data());
    return result;
}

template std::vector<Vec3> read_vectors<double, 3>(const SourceDocument&, Index, double);
template std::vector<std::array<double, 4>> read_vectors<double, 4>(const SourceDocument&, Index, double);
template std::vector<Vec2f> read_vectors<float, 2>(const SourceDocument&, Index, float);
template std::vector<Vec3f> read_vectors<float, 3>(const SourceDocument&, Index, float);
template std::vector<Vec4f> read_vectors<float, 4>(const SourceDocument&, Index, float);
template std::vector<std::array<std::uint16_t, 4>> read_vectors<std::uint16_t, 4>(const SourceDocument&,
                                                                                  Index, std::uint16_t);

std::vector<Index> read_indices(const SourceDocument& source, Index index) {
    std::vector<Index> result(unsigned_member(accessor_at(source, index), "count", 0));
    copy_elements<1>(source, index, Index{0}, result.data());
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

#pragma once
/// \file
/// Construction of the single binary buffer of an output document, with its views and accessors.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "asset/gltf/json.hpp"
#include "asset/io/number_type.hpp"
#include "faqem/asset.hpp"

namespace faqem::detail {

/// Purpose of an accessor. Accessors share a buffer view if and only if they have the same use and stride.
enum class AccessorUse {
    vertices,          ///< attributes that stay as they are
    directions,        ///< normals and tangents of a simplified mesh, as floats: compression may round them
    short_directions,  ///< normals and tangents of a simplified mesh, as normalised 16-bit integers: as above
    texture_coordinates,  ///< of a simplified mesh, as floats: compression may round them
    indices,
    triangles,  ///< indices of triangles whose corners compression may rotate
    matrices,
    other,
};

/// Whether the accessor has one element per vertex.
constexpr bool is_vertex_attribute(AccessorUse use) {
    return use == AccessorUse::vertices || use == AccessorUse::directions ||
           use == AccessorUse::short_directions || use == AccessorUse::texture_coordinates;
}

/// Bits to which compression rounds vertices; 0: the usual ones of the encoder.
struct VertexBits {
    std::uint32_t normals = 0;  ///< of the two octahedral coordinates of AccessorUse::short_directions
    std::uint32_t uvs = 0;      ///< of texture coordinates from 0 to 1
};

/// The members of an accessor that it must have.
inline Json accessor_description(NumberType component, const char* type, std::size_t count) {
    return {{"componentType", static_cast<std::uint32_t>(component)}, {"type", type}, {"count", count}};
}

/// The bytes of numbers, or of arrays of numbers.
template <class T>
std::span<const std::uint8_t> bytes_of(const std::vector<T>& values) {
    return {reinterpret_cast<const std::uint8_t*>(values.data()), values.size() * sizeof(T)};
}

/// Adds min and max to an accessor. They are written exactly, since readers compare them with the numbers.
/// \param numbers     of at least one element
/// \param components  of an element
template <class T>
void add_bounds(Json& description, std::span<const T> numbers, std::size_t components) {
    std::vector<T> low(numbers.begin(), numbers.begin() + static_cast<std::ptrdiff_t>(components)),
        high = low;
    for (std::size_t i = 0; i < numbers.size(); i += components)
        for (std::size_t c = 0; c < components; ++c) {
            low[c] = std::min(low[c], numbers[i + c]);
            high[c] = std::max(high[c], numbers[i + c]);
        }
    for (std::vector<T>* const bound : {&low, &high})
        for (T& number : *bound) number = static_cast<T>(number + T{0});  // -0 becomes 0
    description["min"] = std::move(low);
    description["max"] = std::move(high);
}

/// Collects accessors and views, and writes them to a buffer. Equal accessors are stored once.
class GltfBufferBuilder {
public:
    /// \param compression  of vertices and triangles; with meshopt, finish() adds EXT_meshopt_compression to the
    ///                     extensions of the document
    /// \param bits         for meshopt
    explicit GltfBufferBuilder(Compression compression = Compression::none, VertexBits bits = {})
        : compression_(compression), bits_(bits) {}

    /// Adds an accessor.
    /// \param description  componentType, type, count and any other members of the accessor
    /// \param dense        contiguous elements, copied; empty: all elements are zero, and no bytes are stored
    /// \return index of the accessor; that of an earlier one if all members and bytes are equal
    Index add_accessor(Json description, std::span<const std::uint8_t> dense, AccessorUse use);

    /// Adds indices with 16 bits if they fit, else with 32 bits. The value 65535 is primitive restart.
    Index add_indices(const std::vector<Index>& indices, AccessorUse use);

    /// Adds an accessor whose elements are in the data of an extension. It is never shared.
    /// \return index of the accessor
    Index add_extension_accessor(Json description);

    /// Adds bytes that an extension refers to, in a separate view.
    /// \return what must be added to first_data_view() for the index of the view
    Index add_extension_data(std::vector<std::uint8_t> bytes);

    /// The view of the first data of add_extension_data(). \pre no accessor is added afterwards
    Index first_data_view() const { return static_cast<Index>(groups_.size()); }

    /// Adds bytes, for example of an image, in a separate view.
    /// \param bytes      borrowed until finish()
    /// \param alignment  of its offset in the buffer, a multiple of 4
    /// \return index of the view
    /// \pre no accessor and no data of an extension is added afterwards
    Index add_view(std::span<const std::uint8_t> bytes, std::uint64_t alignment = 4);

    /// Writes accessors, bufferViews and buffers[0] (without uri) to the document, and buffers[1], which has no bytes,
    /// if views were compressed.
    /// \return the bytes of the first buffer; if empty, the document has no buffer
    std::vector<std::uint8_t> finish(Json& document);

private:
    struct Group {
        AccessorUse use;
        std::uint64_t stride;  ///< bytes of an element; 0 if views of this use have none
        std::vector<std::uint8_t> bytes;
    };
    /// An added accessor. Its bytes are at `offset` in its group.
    struct StoredAccessor {
        Json description;
        Index group;
        std::uint64_t offset, size;
    };
    Index find_or_add_group(AccessorUse use, std::uint64_t stride);

    struct SeparateView {
        std::span<const std::uint8_t> bytes;
        std::uint64_t alignment;
        std::vector<std::uint8_t> owned;  ///< `bytes`, unless they are borrowed
    };

    void append_view(const Group& group, std::vector<std::uint8_t>& buffer, std::uint64_t& fallback_size,
                     Json& views) const;

    Compression compression_;
    VertexBits bits_;
    std::vector<StoredAccessor> stored_;
    std::map<std::size_t, std::vector<Index>> accessors_by_hash_;
    std::vector<Group> groups_;
    std::vector<SeparateView> views_;  ///< of extension data, then others
};

}  // namespace faqem::detail

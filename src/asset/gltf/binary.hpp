#pragma once
/// \file
/// The one binary buffer of an output document, with its views and accessors, under construction.

#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "asset/gltf/json.hpp"

namespace faqem::detail {

/// What an accessor is for. Views are shared by accessors of equal use and stride, and by no others.
enum class AccessorUse { vertices, indices, matrices, other };

class GltfBufferBuilder {
public:
    /// \param description  componentType, type, count and whatever else belongs into the accessor
    /// \param dense        the elements back to back; empty: all zero, and no bytes are stored
    /// \return index of the accessor: an earlier one if it is equal in everything
    Index add_accessor(Json description, std::span<const std::uint8_t> dense, AccessorUse use);

    /// Bytes in a view of their own (an image), which must live until finish().
    /// \return index of the view
    /// \pre no accessor is added afterwards
    Index add_view(std::span<const std::uint8_t> bytes);

    /// Puts accessors, bufferViews and buffers[0] (without uri) into the document.
    /// \return the buffer's bytes; empty if there are none, and then there is no buffer
    std::vector<std::uint8_t> finish(Json& document);

private:
    struct Group {
        AccessorUse use;
        std::uint64_t stride;
        std::vector<std::uint8_t> bytes;
    };
    /// What add_accessor() was called with, the bytes as they are in their group.
    struct StoredAccessor {
        Json description;
        Index group;
        std::uint64_t offset, size;
    };
    Index find_or_add_group(AccessorUse use, std::uint64_t stride);
    bool is_equal(const StoredAccessor& stored, const Json& description, Index group,
                  std::span<const std::uint8_t> strided) const;

    std::vector<StoredAccessor> stored_;
    std::map<std::size_t, std::vector<Index>> accessors_by_hash_;
    std::vector<Group> groups_;
    std::vector<std::span<const std::uint8_t>> views_;
};

}  // namespace faqem::detail

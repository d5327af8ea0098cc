#include "asset/gltf/write/buffer_builder.hpp"

#include <cstring>
#include <functional>
#include <optional>
#include <string_view>

#include "asset/gltf/accessor.hpp"
#include "asset/gltf/write/meshopt_encoder.hpp"

namespace faqem::detail {
namespace {

constexpr int array_buffer = 34962, element_array_buffer = 34963;

void pad_to_4(std::vector<std::uint8_t>& bytes) { bytes.resize((bytes.size() + 3) / 4 * 4); }

}  // namespace

Index GltfBufferBuilder::find_or_add_group(AccessorUse use, std::uint64_t stride) {
    // Each list of triangles is compressed by itself.
    const bool is_separate = compression_ == Compression::meshopt && use == AccessorUse::triangles;
    const auto found = is_separate ? groups_.end() : std::ranges::find_if(groups_, [&](const Group& group) {
        return group.use == use && group.stride == stride;
    });
    const auto index = static_cast<Index>(found - groups_.begin());
    if (index == groups_.size()) groups_.push_back({use, stride, {}});
    return index;
}

Index GltfBufferBuilder::add_accessor(Json description, std::span<const std::uint8_t> dense,
                                      AccessorUse use) {
    const std::uint64_t size = element_size(description);
    // Only views of vertex attributes have a stride, which must be a multiple of 4. That of triangles is for their
    // compression.
    const std::uint64_t stride = is_vertex_attribute(use)        ? (size + 3) / 4 * 4
                                 : use == AccessorUse::triangles ? size
                                                                 : 0;
    std::vector<std::uint8_t> padded;
    if (stride > size) {
        padded.resize(dense.size() / size * stride);
        for (std::uint64_t i = 0; i < dense.size() / size; ++i)
            std::memcpy(padded.data() + i * stride, dense.data() + i * size, size);
        dense = padded;
    }
    const Index group = dense.empty() ? no_index : find_or_add_group(use, stride);
    const std::size_t hash =
        std::hash<std::string_view>()({reinterpret_cast<const char*>(dense.data()), dense.size()});
    std::vector<Index>& candidates = accessors_by_hash_[hash];
    for (const Index candidate : candidates) {
        const StoredAccessor& known = stored_[candidate];
        if (known.group == group && known.size == dense.size() && known.description == description &&
            (group == no_index ||
             std::equal(dense.begin(), dense.end(), groups_[group].bytes.data() + known.offset)))
            return candidate;
    }

    StoredAccessor stored{std::move(description), group, 0, dense.size()};
    if (group != no_index) {
        std::vector<std::uint8_t>& bytes = groups_[group].bytes;
        pad_to_4(bytes);
        stored.offset = bytes.size();
        bytes.insert(bytes.end(), dense.begin(), dense.end());
    }
    candidates.push_back(static_cast<Index>(stored_.size()));
    stored_.push_back(std::move(stored));
    return candidates.back();
}

Index GltfBufferBuilder::add_indices(const std::vector<Index>& indices, AccessorUse use) {
    constexpr Index restart = 65535;
    const bool is_short = std::ranges::all_of(indices, [](Index index) { return index < restart; });
    if (!is_short)
        return add_accessor(accessor_description(NumberType::u32, "SCALAR", indices.size()),
                            bytes_of(indices), use);
    const std::vector<std::uint16_t> shorts(indices.begin(), indices.end());
    return add_accessor(accessor_description(NumberType::u16, "SCALAR", shorts.size()), bytes_of(shorts),
                        use);
}

Index GltfBufferBuilder::add_extension_accessor(Json description) {
    stored_.push_back({std::move(description), no_index, 0, 0});
    return static_cast<Index>(stored_.size() - 1);
}

Index GltfBufferBuilder::add_extension_data(std::vector<std::uint8_t> bytes) {
    const std::span<const std::uint8_t> span(bytes);  // stays valid when the vector is moved
    views_.push_back({span, 4, std::move(bytes)});
    return static_cast<Index>(views_.size() - 1);
}

Index GltfBufferBuilder::add_view(std::span<const std::uint8_t> bytes, std::uint64_t alignment) {
    views_.push_back({bytes, alignment, {}});
    return static_cast<Index>(groups_.size() + views_.size() - 1);
}

// A compressed view has its decompressed bytes in a buffer that exists only in the document.
void GltfBufferBuilder::append_view(const Group& group, std::vector<std::uint8_t>& buffer,
                                    std::uint64_t& fallback_size, Json& views) const {
    std::optional<CompressedView> compressed;
    if (compression_ == Compression::meshopt)
        compressed = encode_meshopt(group.bytes, group.stride, group.use, bits_);
    pad_to_4(buffer);
    const std::vector<std::uint8_t>& bytes = compressed ? compressed->bytes : group.bytes;
    Json view = {{"buffer", 0}, {"byteOffset", buffer.size()}, {"byteLength", bytes.size()}};
    if (compressed) {
        Json extension = view;
        extension["byteStride"] = group.stride;
        extension["count"] = compressed->count;
        extension["mode"] = compressed->mode;
        if (!compressed->filter.empty()) extension["filter"] = compressed->filter;
        view = {{"buffer", 1}, {"byteOffset", fallback_size}, {"byteLength", group.bytes.size()}};
        view["extensions"][meshopt_name] = std::move(extension);
        fallback_size += (group.bytes.size() + 3) / 4 * 4;
    }
    buffer.insert(buffer.end(), bytes.begin(), bytes.end());
    if (is_vertex_attribute(group.use)) view["byteStride"] = group.stride;
    if (is_vertex_attribute(group.use)) view["target"] = array_buffer;
    if (group.use == AccessorUse::indices || group.use == AccessorUse::triangles)
        view["target"] = element_array_buffer;
    views.push_back(std::move(view));
}

std::vector<std::uint8_t> GltfBufferBuilder::finish(Json& document) {
    std::uint64_t total = 0, fallback_size = 0;
    for (const Group& group : groups_) total += group.bytes.size() + 3;
    for (const SeparateView& view : views_) total += view.bytes.size() + view.alignment - 1;
    std::vector<std::uint8_t> buffer;
    buffer.reserve(total);
    Json views = Json::array();
    for (Group& group : groups_) {
        append_view(group, buffer, fallback_size, views);
        std::vector<std::uint8_t>().swap(group.bytes);
    }
    for (const SeparateView& view : views_) {
        buffer.resize((buffer.size() + view.alignment - 1) / view.alignment * view.alignment);
        views.push_back({{"buffer", 0}, {"byteOffset", buffer.size()}, {"byteLength", view.bytes.size()}});
        buffer.insert(buffer.end(), view.bytes.begin(), view.bytes.end());
    }
    for (StoredAccessor& stored : stored_) {
        if (stored.group != no_index) stored.description["bufferView"] = stored.group;
        if (stored.group != no_index && stored.offset != 0) stored.description["byteOffset"] = stored.offset;
        document["accessors"].push_back(std::move(stored.description));
    }
    if (buffer.empty()) return buffer;
    document["bufferViews"] = std::move(views);
    document["buffers"] = Json::array({{{"byteLength", buffer.size()}}});
    if (fallback_size > 0) {
        Json fallback = {{"byteLength", fallback_size}};
        fallback["extensions"][meshopt_name]["fallback"] = true;
        document["buffers"].push_back(std::move(fallback));
        for (const char* list : {"extensionsUsed", "extensionsRequired"})
            document[list].push_back(meshopt_name);
    }
    return buffer;
}

}  // namespace faqem::detail

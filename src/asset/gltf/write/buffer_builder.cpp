#include "asset/gltf/write/buffer_builder.hpp"

#include <algorithm>
#include <cstring>
#include <functional>
#include <string_view>
#include <utility>

#include "asset/gltf/accessor.hpp"

namespace faqem::detail {
namespace {

constexpr int array_buffer = 34962, element_array_buffer = 34963;

void pad_to_4(std::vector<std::uint8_t>& bytes) { bytes.resize((bytes.size() + 3) / 4 * 4); }

}  // namespace

Index GltfBufferBuilder::find_or_add_group(AccessorUse use, std::uint64_t stride) {
    const auto found = std::find_if(groups_.begin(), groups_.end(), [&](const Group& group) {
        return group.use == use && group.stride == stride;
    });
    const auto index = static_cast<Index>(found - groups_.begin());
    if (index == groups_.size()) groups_.push_back({use, stride, {}});
    return index;
}

bool GltfBufferBuilder::is_equal(const StoredAccessor& stored, const Json& description, Index group,
                                 std::span<const std::uint8_t> strided) const {
    if (stored.group != group || stored.size != strided.size() || stored.description != description)
        return false;
    if (group == no_index) return true;
    const std::uint8_t* bytes = groups_[group].bytes.data() + stored.offset;
    return std::equal(strided.begin(), strided.end(), bytes);
}

Index GltfBufferBuilder::add_accessor(Json description, std::span<const std::uint8_t> dense,
                                      AccessorUse use) {
    const std::uint64_t size =
        element_size(unsigned_member(description, "componentType", 0), string_member(description, "type"));
    // Only views of vertex attributes have a stride, which must be a multiple of 4.
    const std::uint64_t stride = use == AccessorUse::vertices ? (size + 3) / 4 * 4 : 0;
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
    for (const Index candidate : candidates)
        if (is_equal(stored_[candidate], description, group, dense)) return candidate;

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

Index GltfBufferBuilder::add_view(std::span<const std::uint8_t> bytes) {
    views_.push_back(bytes);
    return static_cast<Index>(groups_.size() + views_.size() - 1);
}

std::vector<std::uint8_t> GltfBufferBuilder::finish(Json& document) {
    std::uint64_t total = 0;
    for (const Group& group : groups_) total += group.bytes.size() + 3;
    for (const auto& view : views_) total += view.size() + 3;
    std::vector<std::uint8_t> buffer;
    buffer.reserve(total);
    Json views = Json::array();
    const auto append = [&](std::span<const std::uint8_t> bytes) -> Json& {
        pad_to_4(buffer);
        views.push_back({{"buffer", 0}, {"byteOffset", buffer.size()}, {"byteLength", bytes.size()}});
        buffer.insert(buffer.end(), bytes.begin(), bytes.end());
        return views.back();
    };
    for (Group& group : groups_) {
        Json& view = append(group.bytes);
        if (group.use == AccessorUse::vertices) view["byteStride"] = group.stride;
        if (group.use == AccessorUse::vertices) view["target"] = array_buffer;
        if (group.use == AccessorUse::indices) view["target"] = element_array_buffer;
        std::vector<std::uint8_t>().swap(group.bytes);
    }
    for (const auto& bytes : views_) append(bytes);
    for (StoredAccessor& stored : stored_) {
        if (stored.group != no_index) stored.description["bufferView"] = stored.group;
        if (stored.group != no_index && stored.offset != 0) stored.description["byteOffset"] = stored.offset;
        document["accessors"].push_back(std::move(stored.description));
    }
    if (buffer.empty()) return buffer;
    document["bufferViews"] = std::move(views);
    document["buffers"] = Json::array({{{"byteLength", buffer.size()}}});
    return buffer;
}

}  // namespace faqem::detail

#include "asset/gltf/json.hpp"

#include <charconv>

namespace faqem::detail {
namespace {

/// Removes the samplers that no channel has.
void keep_used_samplers(Json& animation, Json& channels) {
    Json samplers = Json::array();
    std::vector<Index> number(array_size(animation, "samplers"), no_index);
    for (Json& channel : channels) {
        const Index sampler = index_member(channel, "sampler");
        if (number[sampler] == no_index) {
            number[sampler] = static_cast<Index>(samplers.size());
            samplers.push_back(animation["samplers"][sampler]);
        }
        channel["sampler"] = number[sampler];
    }
    animation["samplers"] = std::move(samplers);
}

}  // namespace

bool has_codec([[maybe_unused]] std::string_view extension) {
#ifdef FAQEM_WITH_MESHOPT
    if (extension == meshopt_name) return true;
#endif
#ifdef FAQEM_WITH_DRACO
    if (extension == draco_name) return true;
#endif
    return false;
}

const Json& member(const Json& object, const char* key) {
    static const Json none;
    if (!object.is_object()) return none;
    const auto found = object.find(key);
    return found == object.end() ? none : *found;
}

std::uint64_t array_size(const Json& object, const char* key) {
    const Json& array = member(object, key);
    return array.is_array() ? array.size() : 0;
}

std::span<Json> elements(Json& object, const char* key) {
    const auto found = object.find(key);
    if (found == object.end() || !found->is_array()) return {};
    return found->get_ref<Json::array_t&>();
}

Index index_member(const Json& object, const char* key) {
    const Json& value = member(object, key);
    return value.is_number_integer() ? value.get<Index>() : no_index;
}

std::optional<Index> valid_index(const Json& value, std::uint64_t count) {
    if (!value.is_number_unsigned() || value.get<std::uint64_t>() >= count) return std::nullopt;
    return value.get<Index>();
}

std::uint64_t unsigned_member(const Json& object, const char* key, std::uint64_t fallback) {
    const Json& value = member(object, key);
    return value.is_number_integer() ? value.get<std::uint64_t>() : fallback;
}

std::string string_member(const Json& object, const char* key) {
    const Json& value = member(object, key);
    return value.is_string() ? value.get<std::string>() : std::string();
}

std::uint64_t primitive_mode(const Json& primitive) {
    return unsigned_member(primitive, "mode", triangle_list);
}

bool is_triangle_primitive(const Json& primitive) { return primitive_mode(primitive) >= triangle_list; }

bool has_triangles(const Json& primitive) {
    return is_triangle_primitive(primitive) && member(primitive, "attributes").contains("POSITION");
}

Index texture_image(const Json& texture) {
    Index image = index_member(texture, "source");
    const Json& extensions = member(texture, "extensions");
    for (const ImageExtension& extension : image_extensions)
        if (image == no_index) image = index_member(member(extensions, extension.name), "source");
    for (const Json& extension : extensions)
        if (image == no_index) image = index_member(extension, "source");
    return image;
}

bool erase_from(Json& object, const char* holder, const std::string& key) {
    if (!member(object, holder).contains(key)) return false;
    object[holder].erase(key);
    if (object[holder].empty()) object.erase(holder);
    return true;
}

void set_or_erase(Json& object, const char* key, Json array) {
    if (array.empty())
        object.erase(key);
    else
        object[key] = std::move(array);
}

const Json& level_ids(const Json& object) { return member(object, "extensions", lod_name, "ids"); }

std::string animated_pointer(const Json& channel) {
    return string_member(member(channel, "target", "extensions", "KHR_animation_pointer"), "pointer");
}

void filter_channels(Json& document, const std::function<bool(const Json& animation, Json& channel)>& keeps) {
    if (!document.contains("animations")) return;
    Json animations = Json::array();
    for (Json& animation : document["animations"]) {
        Json channels = Json::array();
        for (Json& channel : animation["channels"])
            if (keeps(animation, channel)) channels.push_back(std::move(channel));
        if (channels.size() < animation["channels"].size()) keep_used_samplers(animation, channels);
        if (channels.empty()) continue;
        animation["channels"] = std::move(channels);
        animations.push_back(std::move(animation));
    }
    set_or_erase(document, "animations", std::move(animations));
}

Index pointed_node(std::string_view pointer) {
    constexpr std::string_view nodes = "/nodes/";
    if (!pointer.starts_with(nodes)) return no_index;
    Index node = no_index;
    const char* const end = pointer.data() + pointer.size();
    const auto [last, error] = std::from_chars(pointer.data() + nodes.size(), end, node);
    return error == std::errc() && last != end && *last == '/' ? node : no_index;
}

std::string child_path(const std::string& where, std::uint64_t index) {
    return where + "/" + std::to_string(index);
}

std::string child_path(const std::string& where, const std::string& key) { return where + "/" + key; }

double shortest_decimal(float value) {
    char text[32];
    const std::to_chars_result written = std::to_chars(text, text + sizeof text, value);
    double result = value;
    std::from_chars(text, written.ptr, result);
    return result;
}

bool is_texture_info(const std::string& key, const Json& value) {
    return key.ends_with("Texture") && value.is_object() && value.contains("index");
}

}  // namespace faqem::detail

#include "asset/gltf/json.hpp"

#include <charconv>
#include <string_view>

namespace faqem::detail {

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

Index index_member(const Json& object, const char* key) {
    const Json& value = member(object, key);
    return value.is_number_integer() ? value.get<Index>() : no_index;
}

std::uint64_t unsigned_member(const Json& object, const char* key, std::uint64_t fallback) {
    const Json& value = member(object, key);
    return value.is_number_integer() ? value.get<std::uint64_t>() : fallback;
}

std::string string_member(const Json& object, const char* key) {
    const Json& value = member(object, key);
    return value.is_string() ? value.get<std::string>() : std::string();
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
    constexpr std::string_view suffix = "Texture";
    return key.size() >= suffix.size() &&
           key.compare(key.size() - suffix.size(), suffix.size(), suffix) == 0 && value.is_object() &&
           value.contains("index");
}

}  // namespace faqem::detail

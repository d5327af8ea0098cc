#pragma once
/// \file
/// JSON helpers shared by the glTF rooms. A document is kept as JSON besides tinygltf's model because the
/// model cannot hold everything (integers beyond 32 bits, unknown members), and what we do not change must
/// survive.

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "faqem/mesh.hpp"

namespace faqem::detail {

using Json = nlohmann::json;

/// object[key], or null where `object` is not an object or has no such key.
const Json& member(const Json& object, const char* key);

/// Number of elements of the array object[key]; 0 where there is none.
std::uint64_t array_size(const Json& object, const char* key);

/// The index stored under `key`, no_index where there is none. \pre the document was validated
Index index_member(const Json& object, const char* key);

/// The unsigned number stored under `key`, or `fallback`. \pre the document was validated
std::uint64_t unsigned_member(const Json& object, const char* key, std::uint64_t fallback);

/// The string stored under `key`, or an empty one.
std::string string_member(const Json& object, const char* key);

/// `where` with a JSON pointer step added: "/accessors" and 3 make "/accessors/3".
std::string child_path(const std::string& where, std::uint64_t index);
std::string child_path(const std::string& where, const std::string& key);

/// A float as the shortest decimal that reads back as the same float: 0.1f gives 0.1, not 0.10000000149.
double shortest_decimal(float value);

/// A texture info, of an extension or of nobody knows whom: an object under a key that ends with Texture, with an index.
bool is_texture_info(const std::string& key, const Json& value);

/// Calls visit(name, value) for every extension in `value` and below; extras are skipped.
/// \param value  Json or const Json
template <class J, class Visit>
void for_each_extension(J& value, const Visit& visit) {
    if (!value.is_structured()) return;
    if (value.is_object()) {
        const auto found = value.find("extensions");
        if (found != value.end() && found->is_object())
            for (auto it = found->begin(); it != found->end(); ++it) visit(it.key(), it.value());
    }
    for (auto it = value.begin(); it != value.end(); ++it) {
        if (value.is_object() && it.key() == "extras") continue;
        for_each_extension(*it, visit);
    }
}

}  // namespace faqem::detail

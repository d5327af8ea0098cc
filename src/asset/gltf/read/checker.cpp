#include "asset/gltf/read/checker.hpp"

#include "faqem/error.hpp"

namespace faqem::detail {

void GltfChecker::fail(const std::string& where, const std::string& what) const {
    throw InputError(file, where, what);
}

void GltfChecker::fail_unsupported(const std::string& where, const std::string& what) const {
    throw UnsupportedError(file, where, what);
}

std::optional<std::uint64_t> GltfChecker::number(const Json& object, const std::string& where,
                                                 const char* key) const {
    const Json& value = member(object, key);
    if (value.is_null()) return std::nullopt;
    if (!value.is_number_unsigned()) fail(child_path(where, key), "is not an unsigned integer");
    return value.get<std::uint64_t>();
}

std::uint64_t GltfChecker::required_number(const Json& object, const std::string& where,
                                           const char* key) const {
    const auto value = number(object, where, key);
    if (!value) fail(where, std::string("has no ") + key);
    return *value;
}

std::uint64_t GltfChecker::checked_index(const Json& value, const std::string& where,
                                         const char* array_name) const {
    const std::uint64_t size = array_size(document, array_name);
    if (!value.is_number_unsigned()) fail(where, std::string("is not an index into ") + array_name);
    const auto index = value.get<std::uint64_t>();
    if (index >= size)
        fail(where, "refers to /" + std::string(array_name) + "/" + std::to_string(index) + ", there are " +
                        std::to_string(size));
    return index;
}

std::optional<std::uint64_t> GltfChecker::reference(const Json& object, const std::string& where,
                                                    const char* key, const char* array_name) const {
    const Json& value = member(object, key);
    if (value.is_null()) return std::nullopt;
    return checked_index(value, child_path(where, key), array_name);
}

std::uint64_t GltfChecker::required_reference(const Json& object, const std::string& where, const char* key,
                                              const char* array_name) const {
    const auto value = reference(object, where, key, array_name);
    if (!value) fail(where, std::string("has no ") + key);
    return *value;
}

const Json& GltfChecker::array(const Json& parent, const std::string& where, const char* key) const {
    const Json& value = member(parent, key);
    if (!value.is_null() && !value.is_array()) fail(child_path(where, key), "is not an array");
    return value;
}

const Json& GltfChecker::object(const Json& parent, const std::string& where, const char* key) const {
    const Json& value = member(parent, key);
    if (!value.is_null() && !value.is_object()) fail(child_path(where, key), "is not an object");
    return value;
}

void GltfChecker::check_number_array(const Json& parent, const std::string& where, const char* key,
                                     std::uint64_t size) const {
    const Json& values = array(parent, where, key);
    if (values.is_null()) return;
    if (values.size() != size)
        fail(child_path(where, key),
             "has " + std::to_string(values.size()) + " numbers instead of " + std::to_string(size));
    for (const Json& value : values)
        if (!value.is_number()) fail(child_path(where, key), "contains an element that is not a number");
}

void GltfChecker::check_levels(const Json& parent, const std::string& where, const char* array_name) const {
    const std::string at = where + "/extensions/" + lod_name;
    for_each(member(object(parent, where, "extensions"), lod_name), at, "ids",
             [&](const Json& id, const std::string& path) { checked_index(id, path, array_name); });
}

void validate_gltf(const Json& document, const std::string& file) {
    const GltfChecker checker{document, file};
    check_document(checker);
    check_accessors(checker);
    check_meshes_and_materials(checker);
    check_scene(checker);
}

}  // namespace faqem::detail

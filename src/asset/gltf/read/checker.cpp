#include "asset/gltf/read/checker.hpp"

#include "faqem/error.hpp"

namespace faqem::detail {

void CheckedJson::fail(const std::string& what) const { throw InputError(file, where, what); }

void CheckedJson::fail_unsupported(const std::string& what) const {
    throw UnsupportedError(file, where, what);
}

CheckedJson CheckedJson::array(const char* key) const {
    const CheckedJson value = member(key);
    if (!value.json.is_null() && !value.json.is_array()) value.fail("is not an array");
    return value;
}

CheckedJson CheckedJson::object(const char* key) const {
    const CheckedJson value = member(key);
    if (!value.json.is_null() && !value.json.is_object()) value.fail("is not an object");
    return value;
}

CheckedJson CheckedJson::required_object(const char* key) const {
    const CheckedJson value = object(key);
    if (value.json.is_null()) fail(std::string("has no ") + key);
    return value;
}

const Json& CheckedJson::string(const char* key) const {
    const Json& value = detail::member(json, key);
    if (!value.is_null() && !value.is_string()) fail_at(key, "is not a string");
    return value;
}

std::optional<std::uint64_t> CheckedJson::number(const char* key) const {
    const Json& value = detail::member(json, key);
    if (value.is_null()) return std::nullopt;
    if (!value.is_number_unsigned()) fail_at(key, "is not an unsigned integer");
    return value.get<std::uint64_t>();
}

std::uint64_t CheckedJson::required(const char* key, std::optional<std::uint64_t> value) const {
    if (!value) fail(std::string("has no ") + key);
    return *value;
}

std::optional<std::uint64_t> CheckedJson::reference(const char* key, const char* array) const {
    if (detail::member(json, key).is_null()) return std::nullopt;
    return member(key).index(array);
}

std::uint64_t CheckedJson::index(const char* array) const {
    const std::uint64_t size = array_size(document, array);
    if (!json.is_number_unsigned()) fail(std::string("is not an index into ") + array);
    const auto result = json.get<std::uint64_t>();
    if (result >= size)
        fail("refers to /" + std::string(array) + "/" + std::to_string(result) + ", there are " +
             std::to_string(size));
    return result;
}

void CheckedJson::check_levels(const char* array) const {
    object("extensions").member(lod_name).for_each("ids", [&](const CheckedJson& id) { id.index(array); });
}

void CheckedJson::check_number_array(const char* key, std::uint64_t size) const {
    const CheckedJson values = array(key);
    if (values.json.is_null()) return;
    if (values.json.size() != size)
        values.fail("has " + std::to_string(values.json.size()) + " numbers instead of " +
                    std::to_string(size));
    for (const Json& value : values.json)
        if (!value.is_number()) values.fail("contains an element that is not a number");
}

}  // namespace faqem::detail

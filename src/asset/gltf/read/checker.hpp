#pragma once
/// \file
/// Validation of glTF documents: typed and range-checked access to JSON.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "asset/gltf/json.hpp"

namespace faqem::detail {

/// Maximum size of an image file.
inline constexpr std::uint64_t max_image_bytes = INT32_MAX;

/// A value of a document under validation. The functions throw InputError with the JSON pointer of the first invalid
/// value. In their names, a member is one of this value, which must be an object or null, and null if it is absent.
struct CheckedJson {
    const Json& document;
    const std::string& file;  ///< path for messages
    const Json& json;         ///< the value
    std::string where;        ///< JSON pointer to it

    /// \throws InputError  always
    [[noreturn]] void fail(const std::string& what) const;
    /// The same for a member.
    [[noreturn]] void fail_at(const char* key, const std::string& what) const { member(key).fail(what); }
    /// \throws UnsupportedError  always
    [[noreturn]] void fail_unsupported(const std::string& what) const;

    /// A member of any type.
    CheckedJson member(const std::string& key) const {
        return {document, file, detail::member(json, key.c_str()), child_path(where, key)};
    }
    /// An element of this array.
    CheckedJson at(std::uint64_t index) const {
        return {document, file, json[index], child_path(where, index)};
    }
    /// A member that is an array.
    CheckedJson array(const char* key) const;
    /// A member that is an object.
    CheckedJson object(const char* key) const;
    /// The same, which must be present.
    CheckedJson required_object(const char* key) const;
    /// A member that is a string.
    const Json& string(const char* key) const;
    /// A member that is an unsigned integer.
    std::optional<std::uint64_t> number(const char* key) const;
    /// The same, which must be present.
    std::uint64_t required_number(const char* key) const { return required(key, number(key)); }
    /// A member that is an index into the top-level array `array` of the document.
    std::optional<std::uint64_t> reference(const char* key, const char* array) const;
    /// The same, which must be present.
    std::uint64_t required_reference(const char* key, const char* array) const {
        return required(key, reference(key, array));
    }
    /// Checks that this value is an index into the top-level array `array`, and returns it.
    std::uint64_t index(const char* array) const;
    /// Element of a top-level array of the document.
    const Json& element(const char* array, std::uint64_t index) const {
        return detail::member(document, array)[index];
    }

    /// Calls visit(element) for the elements of this array.
    template <class Visit>
    void elements(Visit&& visit) const {
        for (std::uint64_t i = 0; i < json.size(); ++i) visit(at(i));
    }
    /// Calls visit(name, member) for the members of this object.
    template <class Visit>
    void members(Visit&& visit) const {
        for (const auto& [name, value] : json.items())
            visit(name, CheckedJson{document, file, value, child_path(where, name)});
    }
    /// Calls visit(element) for the elements of a member that is an array.
    template <class Visit>
    void for_each(const char* key, Visit&& visit) const {
        array(key).elements(visit);
    }

    /// Checks that the coarser levels of this node or material (MSFT_lod) are indices into the top-level array `array`.
    void check_levels(const char* array) const;
    /// The value of a member; an error if it has none.
    std::uint64_t required(const char* key, std::optional<std::uint64_t> value) const;
    /// Checks that a member is an array of exactly `size` numbers.
    void check_number_array(const char* key, std::uint64_t size) const;
};

/// Checks the types of top-level members, asset.version, extensions and extensionsRequired.
/// \throws InputError, UnsupportedError
void check_document(const CheckedJson& document);

/// Returns the names of the extensions in a document that are kept without being known, sorted.
/// \pre the document was validated
std::vector<std::string> unknown_extensions(const Json& document);

/// Checks buffers, views and accessors. Byte ranges are checked in 64-bit arithmetic.
/// \throws InputError, UnsupportedError
void check_accessors(const CheckedJson& document);

/// Checks meshes, materials, textures and images, and their references.
/// \throws InputError, UnsupportedError
void check_meshes_and_materials(const CheckedJson& document);

/// Checks nodes, scenes, skins and animations: valid references, at most one parent per node, no cycles.
/// \throws InputError
void check_scene(const CheckedJson& document);

}  // namespace faqem::detail

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

/// A document under validation.
///
/// The functions take a JSON object and `where`, the JSON pointer to it, which is used in messages. They
/// throw InputError with the JSON pointer of the first invalid value.
struct GltfChecker {
    const Json& document;
    const std::string& file;  ///< path for messages

    /// \throws InputError  always
    [[noreturn]] void fail(const std::string& where, const std::string& what) const;
    /// \throws UnsupportedError  always
    [[noreturn]] void fail_unsupported(const std::string& where, const std::string& what) const;

    /// The unsigned integer under `key`; empty if the key is absent.
    std::optional<std::uint64_t> number(const Json& object, const std::string& where, const char* key) const;
    /// The unsigned integer under `key`, which must be present.
    std::uint64_t required_number(const Json& object, const std::string& where, const char* key) const;
    /// The index under `key` into the top-level array `array` of the document; empty if the key is absent.
    std::optional<std::uint64_t> reference(const Json& object, const std::string& where, const char* key,
                                           const char* array) const;
    /// The index under `key` into the top-level array `array`, which must be present.
    std::uint64_t required_reference(const Json& object, const std::string& where, const char* key,
                                     const char* array) const;
    /// Checks that a value is an index into the top-level array `array`. Returns the index.
    /// \param where  JSON pointer of the value
    std::uint64_t checked_index(const Json& value, const std::string& where, const char* array) const;
    /// The array under `key`; null if the key is absent.
    const Json& array(const Json& object, const std::string& where, const char* key) const;
    /// The object under `key`; null if the key is absent.
    const Json& object(const Json& parent, const std::string& where, const char* key) const;
    /// Calls visit(value, where) for the values of the array under `key`, if it is present.
    template <class Visit>
    void for_each(const Json& parent, const std::string& where, const char* key, Visit&& visit) const {
        const Json& values = array(parent, where, key);
        const std::string path = child_path(where, key);
        for (std::uint64_t i = 0; i < values.size(); ++i) visit(values[i], child_path(path, i));
    }
    /// Calls check(checker, object, where) for the objects of a top-level array.
    template <class Check>
    void for_each_object(const char* array_name, Check&& check) const {
        for_each(document, "", array_name,
                 [&](const Json& value, const std::string& where) { check(*this, value, where); });
    }
    /// Checks that the coarser levels of a node or material (MSFT_lod) are indices into the top-level array `array`.
    void check_levels(const Json& object, const std::string& where, const char* array) const;
    /// Checks that the value under `key`, if present, is an array of exactly `size` numbers.
    void check_number_array(const Json& object, const std::string& where, const char* key,
                            std::uint64_t size) const;
};

/// Checks the types of top-level members, asset.version, extensions and extensionsRequired.
/// \throws InputError, UnsupportedError
void check_document(const GltfChecker& checker);

/// Returns the names of the extensions in a document that are kept without being known, sorted.
/// \pre the document was validated
std::vector<std::string> unknown_extensions(const Json& document);

/// Checks buffers, views and accessors. Byte ranges are checked in 64-bit arithmetic.
/// \throws InputError, UnsupportedError
void check_accessors(const GltfChecker& checker);

/// Checks meshes, materials, textures and images, and their references.
/// \throws InputError, UnsupportedError
void check_meshes_and_materials(const GltfChecker& checker);

/// Checks nodes, scenes, skins and animations: valid references, at most one parent per node, no cycles.
/// \throws InputError
void check_scene(const GltfChecker& checker);

/// Calls all of the above functions in this order.
/// \param file  path for messages
/// \throws InputError, UnsupportedError
void validate_gltf(const Json& document, const std::string& file);

}  // namespace faqem::detail

#pragma once
/// \file
/// Typed and range-checked access to JSON that nobody has validated yet.

#include <cstdint>
#include <optional>
#include <string>

#include "asset/gltf/json.hpp"

namespace faqem::detail {

/// A document under validation. Every function throws InputError with the place in it on the first thing
/// wrong.
struct GltfChecker {
    const Json& document;
    const std::string& file;  ///< path for messages

    [[noreturn]] void fail(const std::string& where, const std::string& what) const;
    [[noreturn]] void fail_unsupported(const std::string& where, const std::string& what) const;

    /// An unsigned integer; nothing where the key is absent.
    std::optional<std::uint64_t> number(const Json& object, const std::string& where, const char* key) const;
    std::uint64_t required_number(const Json& object, const std::string& where, const char* key) const;
    /// An index into the document's top-level array `array`.
    std::optional<std::uint64_t> reference(const Json& object, const std::string& where, const char* key,
                                           const char* array) const;
    std::uint64_t required_reference(const Json& object, const std::string& where, const char* key,
                                     const char* array) const;
    /// Same for a value at hand, e.g. an element of a list.
    std::uint64_t checked_index(const Json& value, const std::string& where, const char* array) const;
    /// An array (or nothing) under `key`.
    const Json& array(const Json& object, const std::string& where, const char* key) const;
    /// An object (or nothing) under `key`.
    const Json& object(const Json& parent, const std::string& where, const char* key) const;
    /// Array of exactly `size` numbers, if present.
    void check_number_array(const Json& object, const std::string& where, const char* key,
                            std::uint64_t size) const;
};

/// Members and types of the whole document, asset.version, extensionsRequired, URIs.
/// \throws InputError, UnsupportedError
void check_document(const GltfChecker& checker);

/// Buffers, views and accessors: every byte range in 64-bit arithmetic.
void check_accessors(const GltfChecker& checker);

/// Meshes, materials, textures, images and what they refer to.
void check_meshes_and_materials(const GltfChecker& checker);

/// Nodes, scenes, skins and animations: references, one parent each, no cycle.
void check_scene(const GltfChecker& checker);

/// All of the above, in this order.
void validate_gltf(const Json& document, const std::string& file);

}  // namespace faqem::detail

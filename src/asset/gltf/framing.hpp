#pragma once
/// \file
/// The outermost layer of glTF files: GLB header and chunks, and the nesting depth of the JSON. Checked
/// before any parser sees the bytes.

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace faqem::detail {

/// What a .glb or .gltf file consists of. Views into the file's bytes.
struct GltfContainer {
    std::string_view json;
    std::span<const std::uint8_t> bin;
    bool is_binary = false;  ///< a GLB
    bool has_bin = false;    ///< the GLB has a BIN chunk, maybe an empty one
};

/// Deepest nesting of JSON arrays and objects that is accepted.
inline constexpr int max_json_depth = 64;

/// Splits a file. Anything that does not begin with the GLB magic is taken for JSON.
/// \param file      path for messages
/// \param warnings  gets one sentence for each thing that is left out (chunks of unknown type ...)
/// \throws InputError        truncated, or the lengths contradict each other
/// \throws UnsupportedError  a GLB version other than 2
GltfContainer split_gltf(std::span<const std::uint8_t> bytes, const std::string& file,
                         std::vector<std::string>& warnings);

/// Checks the nesting depth without recursion; brackets inside strings do not count.
/// \throws InputError  deeper than max_json_depth
void check_json_depth(std::string_view json, const std::string& file);

/// Puts a GLB together.
/// \param bin  may be empty: then there is no BIN chunk
/// \throws WriteError  the file would have 4 GiB or more, which GLB cannot express
std::vector<std::uint8_t> join_glb(std::string_view json, std::span<const std::uint8_t> bin,
                                   const std::string& file);

}  // namespace faqem::detail

#pragma once
/// \file
/// GLB header and chunks.

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace faqem::detail {

/// The JSON text and the BIN chunk of a file, as views into its bytes.
struct GltfContainer {
    std::string_view json;
    std::span<const std::uint8_t> bin;
    bool is_binary = false;  ///< the file is a GLB
    bool has_bin = false;    ///< the GLB has a BIN chunk, which may be empty
};

/// Splits a file into JSON and binary data. A file that does not start with the GLB magic is taken as JSON.
/// \param bytes     the whole file, borrowed; the result refers to it
/// \param file      path for messages
/// \param warnings  receives a sentence for each ignored part, for example a chunk of unknown type
/// \throws InputError        if the file is truncated or its lengths are inconsistent
/// \throws UnsupportedError  if the GLB version is not 2
GltfContainer split_gltf(std::span<const std::uint8_t> bytes, const std::string& file,
                         std::vector<std::string>& warnings);

/// Opens a file at the beginning of its JSON text, without checks. Returns the size of the text, at most that of the file.
std::uint64_t open_json(const std::filesystem::path& file, std::ifstream& in);

/// Reads the JSON text of a file alone, without checks.
/// \return empty if the file cannot be read, or if the text has 4 GiB or more, which load() does not support
std::string read_json_text(const std::filesystem::path& file);

/// Builds a GLB.
/// \param bin   content of the BIN chunk; empty: no BIN chunk
/// \param file  path for messages
/// \throws WriteError  if the GLB would exceed its limit of 4 GiB
std::vector<std::uint8_t> join_glb(std::string_view json, std::span<const std::uint8_t> bin,
                                   const std::string& file);

}  // namespace faqem::detail

#pragma once
/// \file
/// Loading of a glTF file to a validated document.

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "asset/gltf/source_document.hpp"

namespace faqem::detail {

/// A loaded document, before it is converted to an Asset.
struct LoadedGltf {
    std::string file;                        ///< path for messages
    std::shared_ptr<SourceDocument> source;  ///< has the buffers and images; materials are still empty
    std::vector<std::string> warnings;
};

/// Parses and validates the JSON of a file. Members that are null are left out, as if they were absent.
/// \param file  path for messages
/// \throws InputError, UnsupportedError  as read_gltf()
Json parse_gltf(std::string_view json, const std::string& file);

/// Loads and validates a glTF file, with its buffers and images, and decompresses it.
/// \param bytes  the whole file, borrowed
/// \param file   path for messages; buffers and images are searched in its folder
/// \throws ReadError, InputError, UnsupportedError  as read_gltf()
LoadedGltf load_gltf(std::span<const std::uint8_t> bytes, const std::filesystem::path& file);

}  // namespace faqem::detail

#pragma once
/// \file
/// From a file's bytes to a validated document. tinygltf parses it and fetches the buffers and images,
/// fenced: it sees the JSON only after our validation, and every byte it asks for comes through us.

#include <tiny_gltf.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "asset/source_document.hpp"

namespace faqem::detail {

/// A document on its way into an Asset.
struct LoadedGltf {
    std::string file;                        ///< path for messages
    std::shared_ptr<SourceDocument> source;  ///< buffers and images are in here; materials are still empty
    tinygltf::Model model;                   ///< the same document with types; without buffers and images
    std::vector<std::string> warnings;
};

/// \param bytes  of the file
/// \param file   for messages; its folder is searched for buffers and images
/// \throws ReadError, InputError, UnsupportedError
LoadedGltf load_gltf(std::span<const std::uint8_t> bytes, const std::filesystem::path& file);

}  // namespace faqem::detail

#pragma once
/// \file
/// glTF 2.0: .glb and .gltf.

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "faqem/asset.hpp"

namespace faqem::detail {

/// Reads a GLB or a JSON glTF, told apart by content. One part per mesh, in the meshes' order.
/// \throws ReadError, InputError, UnsupportedError
Asset read_gltf(const std::filesystem::path& file);

/// The same for bytes in memory. \param file  for messages; its folder is searched for buffers and images
Asset read_gltf(std::span<const std::uint8_t> bytes, const std::filesystem::path& file);

/// Writes a GLB, or for names that end in .gltf the JSON with NAME.bin and NAME_0.png ... beside it. The same
/// asset gives the same bytes.
/// \return what could not be kept, one sentence each
/// \throws WriteError
std::vector<std::string> write_gltf(const Asset& asset, const std::filesystem::path& file,
                                    Overwrite overwrite);

/// A GLB in memory. What write_gltf() would warn of is left out. \throws WriteError  it has more than 4 GiB
FAQEM_EXPORT std::vector<std::uint8_t> encode_glb(const Asset& asset);

/// Walks the default scene (the first one if none is named; all root nodes if there is none).
/// \pre asset.source is set
std::vector<Instance> gltf_instances(const Asset& asset);

}  // namespace faqem::detail

#pragma once
/// \file
/// The source document that the glTF reader keeps for the writer.

#include <cstdint>
#include <string>
#include <vector>

#include "asset/gltf/json.hpp"
#include "faqem/asset.hpp"

namespace faqem {

/// A glTF document as it was read. It is immutable after load(); the writer modifies a copy.
struct SourceDocument {
    detail::Json document;                           ///< validated
    std::vector<std::vector<std::uint8_t>> buffers;  ///< one per buffer, byteLength bytes each
    std::vector<Image> images;        ///< one per image of the document; `encoded` is empty if it is missing
    bool has_meshopt = false;         ///< the file was compressed with EXT_meshopt_compression
    bool has_draco = false;           ///< the file was compressed with KHR_draco_mesh_compression
    std::vector<Material> materials;  ///< one per material as read; TextureRef::image is an index in `images`
    std::string unused;  ///< unused_objects() of the file: what save() leaves out, with a warning
};

}  // namespace faqem

#pragma once
/// \file
/// What the glTF reader keeps for its writer.

#include <cstdint>
#include <vector>

#include "asset/gltf/json.hpp"
#include "faqem/asset.hpp"

namespace faqem {

/// A glTF document as it was read. Nothing in it changes after load(): the writer makes a changed copy.
struct SourceDocument {
    detail::Json document;                           ///< validated
    std::vector<std::vector<std::uint8_t>> buffers;  ///< one per buffer, byteLength bytes each
    std::vector<Image> images;        ///< one per image of the document; encoded is empty where it is missing
    std::vector<Material> materials;  ///< one per material as read; TextureRef::image counts in `images`
};

}  // namespace faqem

#pragma once
/// \file
/// The source document that the glTF reader keeps for the writer, what of it no mesh uses, and what its bytes are.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "asset/gltf/json.hpp"
#include "faqem/asset.hpp"
#include "faqem/report.hpp"

namespace faqem {

/// A glTF document as it was read. It is immutable after load(); the writer modifies a copy.
struct SourceDocument {
    detail::Json document;                           ///< validated
    std::vector<std::vector<std::uint8_t>> buffers;  ///< one per buffer, byteLength bytes each
    std::vector<Image> images;  ///< one per image of the document; `encoded` is empty if it is missing
    Compression compression = Compression::none;  ///< of the geometry of the file; meshopt before Draco
    std::vector<Material> materials;  ///< one per material as read; TextureRef::image is an index in `images`
    std::string unused;  ///< unused_objects() of the file: what save() leaves out, with a warning
};

namespace detail {

/// The document that an asset was read from; an empty one if there is none.
inline const SourceDocument& source_document(const Asset& asset) {
    static const SourceDocument none;
    return asset.source ? *asset.source : none;
}

/// Whether an extension names materials, textures and images by number: VRM and VRMC_*.
bool names_by_number(std::string_view extension);

/// Whether a document has or uses such an extension, so that all of these objects and their order must stay.
bool names_objects_by_number(const Json& document);

/// Counts the materials that no primitive has, itself, in a variant or as a coarser level of its material, and the
/// images that only these or nothing refers to. Images of image-based lights and of features and their properties are
/// in use; all materials and images are if names_objects_by_number().
/// \param document  validated
/// \return `2 materials and 1 image that no mesh uses`; empty if there are none
/// Complexity: O(size of the document)
std::string unused_objects(const Json& document);

/// Lists the buffer views of a document, without those of images, in their order.
/// Complexity: O(size of the document).
std::vector<ResultView> buffer_views(const Json& document);

}  // namespace detail

}  // namespace faqem

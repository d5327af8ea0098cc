#pragma once
/// \file
/// Vertices as a reader of a glTF file gets them, for pictures of a result that is not saved yet.

#include "faqem/asset.hpp"
#include "faqem/export.hpp"

namespace faqem::detail {

/// Rounds positions and texture coordinates as save() does in glTF files: by Part::position_spacing, and where geometry
/// is compressed by Asset::uv_bits. Normals and tangents stay exact, and texture coordinates of 16 bits.
/// \param asset  its parts stay valid; points may become equal
/// \return whether there is anything to round
/// Complexity: O(vertices).
FAQEM_EXPORT bool round_vertices(Asset& asset);

}  // namespace faqem::detail

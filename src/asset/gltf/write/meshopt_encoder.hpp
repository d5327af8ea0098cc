#pragma once
/// \file
/// Encoding of buffer views with EXT_meshopt_compression.

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "asset/gltf/write/buffer_builder.hpp"

namespace faqem::detail {

/// A buffer view that is compressed.
struct CompressedView {
    std::vector<std::uint8_t> bytes;
    std::uint64_t count = 0;  ///< elements
    std::string_view mode;    ///< ATTRIBUTES or TRIANGLES
    std::string_view filter;  ///< EXPONENTIAL, OCTAHEDRAL, or empty
};

/// Encodes the elements of a view. Directions and texture coordinates are rounded to multiples of 2^-11 and 2^-15, the
/// smallest angles and distances that are seen, or to the given bits; rounded values stay as they are. Everything else
/// is lossless, but the corners of a triangle may be rotated.
/// \param bytes   the elements: floats for AccessorUse::directions and texture_coordinates, four 16-bit integers for
///                short_directions
/// \param stride  bytes of an element: a multiple of 4, of indices 2 or 4
/// \param bits    of rounded values
/// \return nothing if the use is not compressed, if nothing is gained, or if faqem was built without meshoptimizer
/// O(bytes)
std::optional<CompressedView> encode_meshopt(std::span<const std::uint8_t> bytes, std::uint64_t stride,
                                             AccessorUse use, const VertexBits& bits);

}  // namespace faqem::detail

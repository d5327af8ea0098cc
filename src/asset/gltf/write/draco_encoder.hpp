#pragma once
/// \file
/// Encoding of primitives with KHR_draco_mesh_compression.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "asset/gltf/accessor.hpp"
#include "faqem/mesh.hpp"

namespace faqem::detail {

/// Steps to which the floats of an attribute are rounded: origin + k * range / (2^bits - 1).
struct DracoRounding {
    std::uint32_t bits = 0;
    /// Unit vectors: of each of two octahedral coordinates, without origin and range.
    bool is_octahedral = false;
    std::vector<float> origin;  ///< per component
    float range = 0;            ///< of all components
};

/// Values of an attribute.
struct DracoValues {
    std::string name;                 ///< as in glTF: POSITION, NORMAL ...
    Json description;                 ///< of the accessor: componentType, type, normalized, count
    std::vector<std::uint8_t> bytes;  ///< contiguous elements
    std::optional<DracoRounding> rounding = {};
};

/// An encoded primitive.
struct DracoBytes {
    std::vector<std::uint8_t> bytes;
    std::uint64_t vertices = 0, corners = 0;  ///< after decoding
};

/// The rounding of values to multiples of `spacing`; nothing if it is not positive, there are no values, or a multiple
/// exceeds 2^24 - 1.
/// \param values      all values
/// \param components  of each
/// \param spacing     of the steps
std::optional<DracoRounding> rounding_to_steps(const std::vector<float>& values, std::size_t components,
                                               double spacing);

/// Encodes the triangles of a primitive. The attributes have the numbers 0, 1 ... in the data.
/// \param attributes   with one value per vertex; floats without rounding stay exact
/// \param corners      three per triangle
/// \param keeps_order  whether vertices and triangles keep their order; takes more bytes
/// \return nothing if Draco cannot encode it, or in a build without Draco
/// O(vertices + corners)
std::optional<DracoBytes> encode_draco(const std::vector<DracoValues>& attributes,
                                       const std::vector<Index>& corners, bool keeps_order);

}  // namespace faqem::detail

#pragma once
/// \file
/// Vertex attributes of an output primitive, made valid: unit normals, tangents with the sign 1 or -1,
/// weights that sum to 1. Valid values are kept bit for bit.

#include <cstdint>
#include <vector>

#include "faqem/asset.hpp"

namespace faqem::detail {

/// Vertices and corners of a primitive. An array is empty if the primitive does not have the attribute.
struct PrimitiveData {
    std::vector<Index> vertices;  ///< used vertices of the part; ascending with FileOrder::given
    std::vector<Index> corners;   ///< indices into `vertices`, three per triangle
    std::vector<Vec3f> positions, normals;
    std::vector<Vec4f> tangents, colors, weights;
    std::vector<std::array<std::uint16_t, 4>> joints;
    std::size_t degenerate_faces =
        0;  ///< triangles of which two distinct corner positions are equal after rounding to float
};

/// Chooses an origin for the positions of all parts, because the precision of floats, which glTF stores, is
/// low far away from 0. The origin is common to all parts, so that positions they share stay equal. Each
/// coordinate is 0 if the bounding box is close enough to 0 on that axis, otherwise a multiple of a power of
/// two of about the size of the bounding box.
Vec3 local_origin(const std::vector<Part>& parts);

/// Gathers the vertices and corners of some faces of a part, in the order of Part::file_order. Zero normals are replaced by the area-weighted
/// mean of the adjacent face normals.
/// \param faces    indices of triangles of the part
/// \param origin   subtracted from the positions
/// \param scratch  one no_index per vertex of the part; restored on return
/// \throws WriteError  if a position exceeds the range of float
PrimitiveData gather_primitive(const Part& part, const std::vector<Index>& faces, const Vec3& origin,
                               std::vector<Index>& scratch);

}  // namespace faqem::detail

#pragma once
/// \file
/// The vertex attributes of one output primitive, made valid: unit normals, tangents with a sign, weights
/// that sum up to 1. Values that are right already keep their bits.

#include <cstdint>
#include <string>
#include <vector>

#include "faqem/asset.hpp"

namespace faqem::detail {

/// Vertices of one primitive. Arrays are empty where the primitive goes without the attribute.
struct PrimitiveData {
    std::vector<Index> vertices;  ///< the part's vertices used, ascending
    std::vector<Index> corners;   ///< three per triangle, into `vertices`
    std::vector<Vec3f> positions, normals;
    std::vector<Vec4f> tangents, colors, weights;
    std::vector<std::array<std::uint16_t, 4>> joints;
    std::size_t degenerate_faces =
        0;  ///< triangles of which two corners are at one place as floats, and were not
};

/// Where positions are best counted from: glTF holds them as floats, which far from the origin are coarse. The
/// same for all parts, so that what they share stays at one place; a multiple of a power of two of about their
/// size, and 0 along axes on which that is near enough.
Vec3 local_origin(const std::vector<Part>& parts);

/// Gathers the triangles `faces` of a part. Zero normals are replaced by ones made from the faces.
/// \param origin   what is taken from the positions
/// \param scratch  one no_index per vertex of the part; is left like that
/// \throws WriteError  a position is too large for a float
PrimitiveData gather_primitive(const Part& part, const std::vector<Index>& faces, const Vec3& origin,
                               std::vector<Index>& scratch);

/// values[vertices[i]] for all i.
template <class T>
std::vector<T> gather(const std::vector<T>& values, const std::vector<Index>& vertices) {
    std::vector<T> result;
    result.reserve(vertices.size());
    for (const Index v : vertices) result.push_back(values[v]);
    return result;
}

}  // namespace faqem::detail

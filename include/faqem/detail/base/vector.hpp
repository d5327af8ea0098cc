#pragma once
/// \file
/// The vectors of the engine, for the whole implementation, and triangles of them.

#include <array>
#include <span>

#include "faqem/engine/mesh/vector.hpp"
#include "faqem/export.hpp"

FAQEM_DETAIL_BEGIN

using engine::to_array;
using engine::to_eigen;
using engine::Vector3;

/// The corners of a triangle.
inline std::array<Vector3, 3> corners_of(std::span<const Vec3> positions, const Triangle& t) {
    return {to_eigen(positions[t[0]]), to_eigen(positions[t[1]]), to_eigen(positions[t[2]])};
}

/// Normal of a triangle by its winding, with twice the area as length.
inline Vector3 area_vector(std::span<const Vec3> positions, const Triangle& t) {
    const auto [a, b, c] = corners_of(positions, t);
    return engine::area_vector(a, b, c);
}

FAQEM_DETAIL_END

#pragma once
/// \file
/// What the accessors of an output document are for.

namespace faqem::detail {

/// Purpose of an accessor. Accessors share a buffer view if and only if they have the same use and stride.
enum class AccessorUse {
    vertices,    ///< attributes that stay as they are
    directions,  ///< normals and tangents of a simplified mesh, as floats: compression may round them
    texture_coordinates,  ///< of a simplified mesh, as floats: compression may round them
    indices,
    triangles,  ///< indices of triangles whose corners compression may rotate
    matrices,
    other,
};

/// Whether the accessor has one element per vertex.
constexpr bool is_vertex_attribute(AccessorUse use) {
    return use == AccessorUse::vertices || use == AccessorUse::directions ||
           use == AccessorUse::texture_coordinates;
}

/// Whether the accessor has vertex indices.
constexpr bool is_index(AccessorUse use) {
    return use == AccessorUse::indices || use == AccessorUse::triangles;
}

}  // namespace faqem::detail

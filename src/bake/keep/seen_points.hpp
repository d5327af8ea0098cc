#pragma once
/// \file
/// Pictures of meshes that tell which point of which face is seen at every pixel.

#include <cstdint>
#include <span>
#include <vector>

#include "faqem/engine/mesh/vector.hpp"
#include "faqem/mesh.hpp"

namespace faqem::detail {

/// A mesh at its place in the scene.
struct PlacedMesh {
    Index part = no_index;
    std::span<const Triangle> triangles;
    std::vector<engine::Vector3> positions;  ///< by vertex
};

/// The point of a mesh that is seen at a pixel.
struct SeenPoint {
    Index mesh = no_index;  ///< index into the meshes of the picture; no_index: nothing is seen
    Index face = 0;
    Vec3 barycentric = {};
};

/// A camera without perspective. `right`, `up` and `back` are orthonormal.
struct View {
    engine::Vector3 right, up, back;
    engine::Vector3 center;
    double pixel = 0;        ///< side of a pixel in the scene
    std::uint32_t size = 0;  ///< width and height of the picture in pixels
};

/// Views from evenly distributed directions that show all of the meshes.
/// \param meshes  not all without vertices
/// \param count   number of views
/// \param size    width and height of the pictures in pixels, > 0
/// Complexity: O(vertices).
std::vector<View> views_around(std::span<const PlacedMesh> meshes, std::size_t count, std::uint32_t size);

/// Draws the meshes; both sides of every face are seen. Of points at the same depth, that of the first face is
/// taken.
/// \return size * size points, top row first
/// Complexity: O(faces + pixels of their bounding boxes).
std::vector<SeenPoint> seen_points(std::span<const PlacedMesh> meshes, const View& view);

}  // namespace faqem::detail

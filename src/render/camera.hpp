#pragma once
/// \file
/// Cameras, and meshes that they see.

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "faqem/engine/mesh/vector.hpp"
#include "faqem/mesh.hpp"

namespace faqem::render {

using engine::Vector3;

/// A mesh in world space.
struct PlacedMesh {
    std::span<const Vector3> positions;  ///< by vertex
    std::span<const Triangle> triangles;
    /// By face: 1 if it is seen from its counter-clockwise side only, -1 if from the other one only, 0 if from both.
    std::span<const std::int8_t> sides = {};  ///< empty: all faces are seen from both sides
};

/// A perspective camera with a square field of view. `right`, `up` and `back` are orthonormal.
struct Camera {
    Vector3 eye = Vector3::Zero();
    Vector3 right = Vector3::UnitX(), up = Vector3::UnitY(), back = Vector3::UnitZ();
    double tan_half_fov = 0.2;  ///< tangent of half the field of view
};

/// Creates a camera that looks at the origin. \param back  unit vector towards the camera, not along the y axis
Camera camera_from(const Vector3& back);

/// Creates a camera that looks at the origin from the horizon or above it.
/// \param azimuth    rotation about the y axis in radians; 0: the camera looks from +z
/// \param elevation  angle above the horizon in radians
Camera orbit_camera(double azimuth, double elevation);

/// Unit vectors along a spiral about the y axis, evenly distributed over the sphere.
std::vector<Vector3> even_directions(std::size_t count);

/// The axis-aligned bounding box of all faces.
Eigen::AlignedBox3d bounding_box(std::span<const PlacedMesh> meshes);

/// Moves cameras to the same distance from the centre of all faces, at which each of them sees all.
/// \return false, without changing anything, if there are no faces
/// Complexity: O(cameras faces).
bool show_all(std::span<const PlacedMesh> meshes, std::span<Camera> cameras);

/// Creates cameras that see all faces, evenly distributed around their centre at the same distance from it; see show_all()
/// if there are no faces.
std::vector<Camera> cameras_around(std::span<const PlacedMesh> meshes, std::size_t count);

/// A point in a picture.
struct ScreenPoint {
    Eigen::Vector2d at;  ///< in pixels, y points down
    /// 1 / distance along the view axis, which is linear in the picture; > 0 if it is seen.
    double inverse_depth = 0;
};

/// The corners of a face in a picture.
using ScreenFace = std::array<ScreenPoint, 3>;

/// Projects a point into a picture with the given side in pixels.
ScreenPoint project(const Camera& camera, const Vector3& point, std::uint32_t size);

}  // namespace faqem::render

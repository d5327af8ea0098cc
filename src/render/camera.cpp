#include "render/camera.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace faqem::render {

namespace {

constexpr double frame_margin = 1.04;

template <class Visit>
void for_each_corner(std::span<const PlacedMesh> meshes, Visit&& visit) {
    for (const PlacedMesh& mesh : meshes)
        for (const Triangle& t : mesh.triangles)
            for (const Index v : t) visit(mesh.positions[v]);
}

// Distance from `centre` at which a camera sees all faces.
double fitting_distance(std::span<const PlacedMesh> meshes, const Camera& camera, const Vector3& centre) {
    double distance = 0;
    for_each_corner(meshes, [&](const Vector3& p) {
        const Vector3 d = p - centre;
        const double off_axis = std::max(std::abs(d.dot(camera.right)), std::abs(d.dot(camera.up)));
        distance = std::max(distance, d.dot(camera.back) + off_axis / camera.tan_half_fov);
    });
    return distance;
}

}  // namespace

Camera camera_from(const Vector3& back) {
    Camera camera;
    camera.back = camera.eye = back;
    camera.right = Vector3::UnitY().cross(back).normalized();
    camera.up = back.cross(camera.right);
    return camera;
}

Camera orbit_camera(double azimuth, double elevation) {
    return camera_from({std::sin(azimuth) * std::cos(elevation), std::sin(elevation),
                        std::cos(azimuth) * std::cos(elevation)});
}

std::vector<Vector3> even_directions(std::size_t count) {
    std::vector<Vector3> result;
    const double golden_angle = std::numbers::pi * (3 - std::sqrt(5.0));
    for (std::size_t i = 0; i < count; ++i) {
        const double height = 1 - (2 * static_cast<double>(i) + 1) / static_cast<double>(count);
        const double radius = std::sqrt(1 - height * height), angle = golden_angle * static_cast<double>(i);
        result.emplace_back(radius * std::sin(angle), height, radius * std::cos(angle));
    }
    return result;
}

Eigen::AlignedBox3d bounding_box(std::span<const PlacedMesh> meshes) {
    Eigen::AlignedBox3d box;
    for_each_corner(meshes, [&](const Vector3& p) { box.extend(p); });
    return box;
}

bool show_all(std::span<const PlacedMesh> meshes, std::span<Camera> cameras) {
    const Eigen::AlignedBox3d box = bounding_box(meshes);
    if (box.isEmpty()) return false;
    const Vector3 centre = 0.5 * box.min() + 0.5 * box.max();
    double distance = 0;
    for (const Camera& camera : cameras)
        distance = std::max(distance, fitting_distance(meshes, camera, centre));
    if (!(distance > 0)) distance = 1;
    for (Camera& camera : cameras) camera.eye = centre + frame_margin * distance * camera.back;
    return true;
}

std::vector<Camera> cameras_around(std::span<const PlacedMesh> meshes, std::size_t count) {
    std::vector<Camera> result;
    for (const Vector3& direction : even_directions(count)) result.push_back(camera_from(direction));
    show_all(meshes, result);
    return result;
}

ScreenPoint project(const Camera& camera, const Vector3& point, std::uint32_t size) {
    const double half = size / 2.0;
    const Vector3 d = point - camera.eye;
    const double depth = -d.dot(camera.back);
    return {{half + half * d.dot(camera.right) / (depth * camera.tan_half_fov),
             half - half * d.dot(camera.up) / (depth * camera.tan_half_fov)},
            1 / depth};
}

}  // namespace faqem::render

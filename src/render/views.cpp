#include "render/views.hpp"

#include <array>
#include <numbers>

#include "faqem/detail/base/parallel.hpp"
#include "faqem/error.hpp"

namespace faqem::render {

namespace {

constexpr double first_azimuth = 0.35;
constexpr std::array<double, 2> elevations = {0.16, 0.42};  // radians: alternating low and higher views

}  // namespace

std::vector<Camera> cameras_around(const Scene& scene, const std::string& file, std::uint32_t views,
                                   bool z_up) {
    std::vector<Camera> result;
    for (std::uint32_t i = 0; i < views; ++i)
        result.push_back(orbit_camera(first_azimuth + 2 * std::numbers::pi * i / views,
                                      elevations[i % elevations.size()]));
    if (z_up)
        for (Camera& camera : result)
            for (Vector3* vector : {&camera.right, &camera.up, &camera.back})
                *vector = {vector->x(), -vector->z(), vector->y()};
    if (!show_all(placed_meshes(scene), result)) throw InputError(file, "", "has no triangles");
    return result;
}

std::vector<ContactSheetRow> draw_rows(const std::vector<Scene>& scenes, const std::vector<Camera>& cameras,
                                       std::uint32_t size, Shading shading, Edges edges) {
    std::vector<ContactSheetRow> rows(scenes.size());
    for (std::size_t r = 0; r < rows.size(); ++r) {
        rows[r].frames.resize(cameras.size());
        rows[r].label = with_commas(scenes[r].faces) + " faces";
    }
    detail::parallel_blocks(scenes.size() * cameras.size(), 1, 0, [&](std::size_t i, std::size_t) {
        const std::size_t r = i / cameras.size(), v = i % cameras.size();
        rows[r].frames[v] = render(scenes[r], cameras[v], size, shading, edges);
    });
    return rows;
}

}  // namespace faqem::render

#include "render/visible_points.hpp"

namespace faqem::render {

std::vector<VisiblePoint> visible_points(std::span<const PlacedMesh> meshes, const Camera& camera,
                                         std::uint32_t size) {
    std::vector<VisiblePoint> result(std::size_t{size} * size);
    std::vector<double> nearest(result.size(), 0);  // inverse depth
    for (Index m = 0; m < meshes.size(); ++m) {
        std::vector<ScreenPoint> points;
        points.reserve(meshes[m].positions.size());
        for (const Vector3& position : meshes[m].positions) points.push_back(project(camera, position, size));
        for (Index f = 0; f < meshes[m].triangles.size(); ++f) {
            const Triangle& t = meshes[m].triangles[f];
            const ScreenFace face = {points[t[0]], points[t[1]], points[t[2]]};
            const double area = twice_area(face);
            if (!(std::abs(area) > 0) || !std::isfinite(area)) continue;
            // y points down in the picture, so the area of counter-clockwise faces is negative.
            if (!meshes[m].sides.empty() && meshes[m].sides[f] * area > 0) continue;
            for_each_pixel(face, area, size, [&](std::size_t pixel, const Vector3& w, double inverse_depth) {
                if (!(inverse_depth > nearest[pixel])) return;
                nearest[pixel] = inverse_depth;
                const Vector3 on_face = perspective_weights(face, w);
                result[pixel] = {m, f, {on_face[0], on_face[1], on_face[2]}};
            });
        }
    }
    return result;
}

}  // namespace faqem::render

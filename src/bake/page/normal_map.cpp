#include "bake/page/normal_map.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "asset/scene/material_textures.hpp"
#include "bake/parts/corner_normals.hpp"
#include "bake/source/source_normals.hpp"
#include "bake/source/tangents.hpp"
#include "scene/vector_conversion.hpp"

namespace faqem::detail {
namespace {

// Smallest normal deviation, in degrees, for which a normal map is made from geometry. Below it the visible difference
// does not justify the size of the image.
constexpr double min_deviation = 3.5;

struct Deviation {
    double sum = 0, area = 0;
};

Deviation face_deviation(const BakePart& part, Index face) {
    const TriangleMesh& mesh = part.simplified->mesh;
    const Vector3 face_normal = oriented_face_normal(part, face);
    double sum = 0;
    for (const Vec3& w : quarter_points) {
        Vector3 other = interpolated_normal(*part.source, part.map->map(face, w));
        if (other.dot(face_normal) < 0) other = -other;
        sum += (unit_or_zero(blended_normal(part, face, w)) - other).squaredNorm();
    }
    const double area = area_vector(mesh.positions, mesh.triangles[face]).norm();
    return {std::isfinite(area) ? sum / 4 * area : 0, std::isfinite(area) ? area : 0};
}

}  // namespace

double normal_deviation(std::span<const BakePart> parts, std::span<const PageFace> faces,
                        const RunContext& context) {
    std::vector<Deviation> each(faces.size());
    parallel_each(faces.size(), 256, context,
                  [&](std::size_t i) { each[i] = face_deviation(parts[faces[i].part], faces[i].face); });
    Deviation all;
    for (const Deviation& d : each) {
        all.sum += d.sum;
        all.area += d.area;
    }
    return all.area > 0 ? std::sqrt(all.sum / all.area) * 180 / std::numbers::pi : 0;
}

bool wants_normal_map(NormalMap choice, const Asset& source, const MaterialGroup& group,
                      std::span<const BakePart> parts, std::span<const PageFace> faces,
                      const RunContext& context) {
    if (choice == NormalMap::off || group.material.unlit || faces.empty()) return false;
    if (choice == NormalMap::on) return true;
    const auto has_any = [&](bool (*has)(const Material&)) {
        return std::any_of(group.materials.begin(), group.materials.end(),
                           [&](Index m) { return has(material_or_default(source, m)); });
    };
    if (has_any([](const Material& m) { return bool(m.normal_texture); })) return true;
    return has_any(has_textures) && normal_deviation(parts, faces, context) > min_deviation;
}

void set_tangents(const BakePart& part, std::span<const Index> faces, std::span<const Vec2f> uvs,
                  std::vector<Vec4f>& tangents) {
    const TriangleMesh& mesh = part.simplified->mesh;
    const auto corner = [&](Index f, std::size_t i) {
        const std::size_t c = std::size_t{3} * f + i;
        const Vec3& position = mesh.positions[mesh.triangles[f][i]];
        return TangentCorner{to_vec3f(to_eigen(position)), part.normals.normals[c], uvs[c]};
    };
    tangents.resize(3 * part.faces(), Vec4f{});
    set_mikk_tangents(faces, corner, tangents);
}

}  // namespace faqem::detail

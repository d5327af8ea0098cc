#include "bake/source/source_normals.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "bake/source/extension_layers.hpp"
#include "bake/source/tangents.hpp"
#include "scene/material_groups.hpp"
#include "scene/vector_conversion.hpp"

namespace faqem::detail {
namespace {

bool has_tangents(const Part& part, std::size_t face) {
    if (part.tangents.empty()) return false;
    const Triangle& t = part.triangles[face];
    return std::all_of(t.begin(), t.end(), [&](Index v) {
        const Vec4f& tangent = part.tangents[v];
        return tangent[0] != 0 || tangent[1] != 0 || tangent[2] != 0;
    });
}

TangentCorner tangent_corner(const Part& part, const TextureRef& texture_ref, std::size_t face,
                             std::size_t corner) {
    const Index v = part.triangles[face][corner];
    TangentCorner result{
        to_vec3f(to_eigen(part.positions[v])), to_vec3f(corner_normal(part, face, corner)), {}};
    if (texture_ref.uv_set < part.uvs.size())
        result.uv = uv_transform(texture_ref).apply(part.uvs[texture_ref.uv_set][v]);
    return result;
}

}  // namespace

Vector3 TangentFrame::from_mesh(const Vector3& v) const {
    const Vector3 across = bitangent.cross(normal);
    const double volume = tangent.dot(across);
    const Vector3 result =
        Vector3(v.dot(across), v.dot(normal.cross(tangent)), v.dot(tangent.cross(bitangent))) / volume;
    return std::abs(volume) > 1e-6 && result.allFinite() ? result : Vector3(0, 0, 1);
}

TangentFrame blend_frames(const std::array<FrameCorner, 3>& corners, const Vec3& weights) {
    Vector3 tangent = Vector3::Zero(), bitangent = Vector3::Zero(), normal = Vector3::Zero();
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec4f& t = corners[i].tangent;
        const Vector3 along(t[0], t[1], t[2]);
        normal += weights[i] * corners[i].normal;
        tangent += weights[i] * along;
        bitangent += weights[i] * t[3] * unit_or_zero(corners[i].normal.cross(along));
    }
    return {unit_or_zero(tangent), unit_or_zero(bitangent), unit_or_zero(normal)};
}

Vector3 winding_normal(const std::vector<Vec3>& positions, const Triangle& t) {
    return unit_or_zero(area_vector(positions, t));
}

Vector3 interpolated_normal(const Part& part, const SurfacePoint& point) {
    const Triangle& t = part.triangles[point.face];
    Vector3 n = Vector3::Zero();
    if (!part.normals.empty()) {
        for (std::size_t i = 0; i < 3; ++i) n += point.barycentric[i] * to_vector(part.normals[t[i]]);
        n = unit_or_zero(n);
    }
    return n.isZero(0) ? winding_normal(part.positions, t) : n;
}

Vector3 corner_normal(const Part& part, std::size_t face, std::size_t corner) {
    const Triangle& t = part.triangles[face];
    Vector3 n = Vector3::Zero();
    if (!part.normals.empty()) n = unit_or_zero(to_vector(part.normals[t[corner]]));
    return n.isZero(0) ? winding_normal(part.positions, t) : n;
}

std::vector<Vec4f> source_tangents(const Asset& asset, const Part& part) {
    std::vector<Vec4f> result;
    std::map<Index, std::vector<Index>> without;  // faces without tangents, by material
    for (Index f = 0; f < part.triangles.size(); ++f) {
        const Index material = face_material(part, f);
        if (!tangent_texture(material_or_default(asset, material))) continue;
        result.resize(3 * part.triangles.size(), Vec4f{});
        if (!has_tangents(part, f)) {
            without[material].push_back(f);
            continue;
        }
        for (std::size_t c = 0; c < 3; ++c) {
            const Vec4f& t = part.tangents[part.triangles[f][c]];
            const Vec3f along = to_vec3f(unit_or_zero(to_vector({t[0], t[1], t[2]})));
            result[std::size_t{3} * f + c] = {along[0], along[1], along[2], t[3] < 0 ? -1.0f : 1.0f};
        }
    }
    for (const auto& [material, faces] : without) {
        const TextureRef& texture_ref = *tangent_texture(material_or_default(asset, material));
        const auto corner = [&](Index f, std::size_t c) { return tangent_corner(part, texture_ref, f, c); };
        set_mikk_tangents(faces, corner, result);
    }
    return result;
}

}  // namespace faqem::detail

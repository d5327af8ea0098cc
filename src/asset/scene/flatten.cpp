#include "asset/scene/flatten.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "asset/scene/repair.hpp"

namespace faqem::detail {
namespace {

using Transform = std::array<double, 16>;

Vec3 transformed(const Transform& m, const Vec3& p) {
    Vec3 q;
    for (std::size_t r = 0; r < 3; ++r) q[r] = m[r] * p[0] + m[4 + r] * p[1] + m[8 + r] * p[2] + m[12 + r];
    return q;
}

/// Cofactors of the upper left 3 x 3 block, row by row: the inverse transpose times the determinant. They are
/// defined for singular transforms too.
std::array<Vec3, 3> cofactors(const Transform& m) {
    std::array<Vec3, 3> c;
    const auto at = [&](std::size_t r, std::size_t col) { return m[4 * (col % 3) + r % 3]; };
    for (std::size_t r = 0; r < 3; ++r)
        for (std::size_t k = 0; k < 3; ++k)
            c[r][k] = at(r + 1, k + 1) * at(r + 2, k + 2) - at(r + 1, k + 2) * at(r + 2, k + 1);
    return c;
}

double determinant(const Transform& m) {
    const auto c = cofactors(m);
    return m[0] * c[0][0] + m[1] * c[1][0] + m[2] * c[2][0];
}

Vec3f transformed_normal(const std::array<Vec3, 3>& cofactor, double sign, const Vec3f& n) {
    Vec3 q;
    for (std::size_t r = 0; r < 3; ++r)
        q[r] = sign * (cofactor[r][0] * n[0] + cofactor[r][1] * n[1] + cofactor[r][2] * n[2]);
    const double length = std::hypot(q[0], q[1], q[2]);
    if (!(length > 0 && std::isfinite(length))) return {0, 0, 0};
    return {static_cast<float>(q[0] / length), static_cast<float>(q[1] / length),
            static_cast<float>(q[2] / length)};
}

/// Vertex attributes of the flattened part.
struct VertexLayout {
    bool normals = false, colors = false;
    std::size_t uv_sets = 0;
};

template <class Value>
void append(std::vector<Value>& to, const std::vector<Value>& values, std::size_t count,
            const Value& neutral) {
    if (values.empty())
        to.insert(to.end(), count, neutral);
    else
        to.insert(to.end(), values.begin(), values.end());
}

void append(Part& flat, const Part& part, const Transform& m, const VertexLayout& layout) {
    const auto first = static_cast<Index>(flat.positions.size());
    const std::size_t vertices = part.positions.size();
    const bool is_identity = m == identity_transform;
    const double sign = determinant(m) < 0 ? -1 : 1;
    for (const Vec3& p : part.positions) flat.positions.push_back(is_identity ? p : transformed(m, p));
    if (layout.normals) {
        const auto cofactor = cofactors(m);
        append(flat.normals, part.normals, vertices, {0, 0, 0});
        for (std::size_t v = first; v < flat.normals.size() && !is_identity; ++v)
            flat.normals[v] = transformed_normal(cofactor, sign, flat.normals[v]);
    }
    if (layout.colors) append(flat.colors, part.colors, vertices, {1, 1, 1, 1});
    static const std::vector<Vec2f> none;
    for (std::size_t set = 0; set < layout.uv_sets; ++set)
        append(flat.uvs[set], set < part.uvs.size() ? part.uvs[set] : none, vertices, {0, 0});
    for (const Triangle& t : part.triangles) {
        const bool is_mirrored = sign < 0;
        flat.triangles.push_back(
            {first + t[0], first + t[is_mirrored ? 2 : 1], first + t[is_mirrored ? 1 : 2]});
    }
    append(flat.face_material, part.face_material, part.triangles.size(), no_index);
}

std::size_t uninstanced_part_count(const Asset& asset) {
    std::vector<std::uint8_t> is_uninstanced;
    for (const Part& part : asset.parts) is_uninstanced.push_back(!part.triangles.empty());
    for (const Instance& instance : instances(asset)) is_uninstanced[instance.part] = 0;
    return static_cast<std::size_t>(std::count(is_uninstanced.begin(), is_uninstanced.end(), 1));
}

}  // namespace

Part flatten(const Asset& asset) { return flatten(asset, instances(asset)); }

Part flatten(const Asset& asset, const std::vector<Instance>& all) {
    Part flat;
    VertexLayout layout;
    std::uint64_t vertices = 0, faces = 0;
    for (const Instance& instance : all) {
        const Part& part = asset.parts[instance.part];
        vertices += part.positions.size();
        faces += part.triangles.size();
        layout.normals |= !part.normals.empty();
        layout.colors |= !part.colors.empty();
        layout.uv_sets = std::max(layout.uv_sets, part.uvs.size());
    }
    check_index_count(vertices, "", "vertices of the flattened scene");
    check_index_count(faces, "", "faces of the flattened scene");
    flat.uvs.resize(layout.uv_sets);
    flat.positions.reserve(vertices);
    flat.triangles.reserve(faces);
    for (const Instance& instance : all) append(flat, asset.parts[instance.part], instance.transform, layout);
    if (all.size() == 1) flat.name = asset.parts[all[0].part].name;
    return flat;
}

std::vector<std::string> flattening_losses(const Asset& asset, const std::string& format) {
    std::vector<std::string> losses;
    const auto any = [&](auto&& test) { return std::any_of(asset.parts.begin(), asset.parts.end(), test); };
    const std::string cannot = format + " cannot hold ";
    if (asset.source)
        losses.push_back(
            cannot + "a scene: all meshes are transformed to world space, the rest of the scene is left out");
    if (const std::size_t uninstanced = uninstanced_part_count(asset))
        losses.push_back("no node of the scene references " + std::to_string(uninstanced) +
                         (uninstanced == 1 ? " mesh, which was left out" : " meshes, which were left out"));
    if (any([](const Part& p) { return !p.joints.empty(); }))
        losses.push_back(cannot + "skins: the mesh keeps its rest pose");
    if (any([](const Part& p) { return !p.morph_targets.empty(); }))
        losses.push_back(cannot + "morph targets");
    if (any([](const Part& p) { return !p.custom_attributes.empty(); }))
        losses.push_back(cannot + "custom attributes");
    if (any([](const Part& p) { return !p.tangents.empty(); })) losses.push_back(cannot + "tangents");
    return losses;
}

bool is_float_representable(const std::vector<Vec3>& positions) {
    return std::all_of(positions.begin(), positions.end(), [](const Vec3& p) {
        return std::all_of(p.begin(), p.end(), [](double x) {
            return std::abs(x) <= std::numeric_limits<float>::max() &&
                   static_cast<double>(static_cast<float>(x)) == x;
        });
    });
}

}  // namespace faqem::detail

#include "bake/onto/onto_target.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "asset/scene/flatten.hpp"
#include "asset/scene/messages.hpp"
#include "asset/scene/part_arrays.hpp"
#include "bake/atlas/triangle_overlap.hpp"
#include "bake/page/normal_map.hpp"
#include "bake/parts/corner_normals.hpp"
#include "bake/source/source_normals.hpp"
#include "faqem/engine/mesh/weld.hpp"
#include "scene/material_groups.hpp"
#include "scene/vector_conversion.hpp"

namespace faqem::detail {
namespace {

// Replaces normals by those that the part has. Its corners at a position with equal normals are a cluster.
void take_normals(const Part& part, const BakePart& mesh, CornerNormals& to) {
    if (part.normals.empty()) return;
    std::map<std::pair<Index, Vec3f>, Index> clusters;
    for (Index f = 0; f < part.triangles.size(); ++f) {
        Vector3 sum = Vector3::Zero();
        for (std::size_t c = 0; c < 3; ++c) {
            const Vector3 own = unit_or_zero(to_vector(part.normals[part.triangles[f][c]]));
            if (own.isZero(0)) continue;
            const auto at = static_cast<Index>(3 * f + c);
            to.normals[at] = to_vec3f(own);
            to.clusters[at] =
                clusters.try_emplace({mesh.simplified->mesh.triangles[f][c], to.normals[at]}, at)
                    .first->second;
            sum += own;
        }
        to.has_reversed_winding[f] = sum.dot(winding_normal(part.positions, part.triangles[f])) < 0;
    }
}

}  // namespace

std::unique_ptr<TargetMesh> target_mesh(const Part& part, const BakeOptions& bake,
                                        const RunContext& context) {
    auto result = std::make_unique<TargetMesh>();
    TriangleMesh& mesh = result->mesh.mesh;
    const std::vector<Index> welded = engine::weld_exact(part.positions);
    mesh.positions = part.positions;
    mesh.triangles = part.triangles;
    for (Triangle& t : mesh.triangles)
        for (Index& v : t) v = welded[v];
    result->part = {.source = &part, .simplified = &result->mesh, .map = nullptr, .writes_normals = false};
    BakeOptions smooth = bake;
    smooth.normals = Normals::smooth;
    // Without the normals of the part, which are those of its source here.
    Part bare;
    result->part.source = &bare;
    result->part.normals = make_normals(result->part, smooth, context);
    result->part.source = &part;
    take_normals(part, result->part, result->part.normals);
    return result;
}

FlatTarget flat_target(const Asset& target) {
    FlatTarget result;
    std::vector<PosedInstance> first;
    std::vector<std::uint8_t> is_placed(target.parts.size(), 0);
    Index faces = 0, vertices = 0;
    for (const PosedInstance& instance : posed_instances(target)) {
        if (std::exchange(is_placed[instance.part], std::uint8_t{1})) continue;
        const Part& part = target.parts[instance.part];
        result.pieces.push_back({instance.part, faces, vertices});
        faces += static_cast<Index>(part.triangles.size());
        vertices += static_cast<Index>(part.positions.size());
        first.push_back(instance);
    }
    result.flat = flatten(target, first);  // throws if the indices overflow
    return result;
}

std::vector<Vec2f> usable_uvs(const Asset& target, const FlatTarget& flat, std::string& fault) {
    for (const FlatTarget::Piece& piece : flat.pieces)
        if (target.parts[piece.part].uvs.empty()) {
            fault = part_title(target, piece.part) + " has none";
            return {};
        }
    std::vector<Vec2f> result;
    std::vector<Triangle2> triangles;  // counter-clockwise
    for (const Triangle& t : flat.flat.triangles) {
        Triangle2 triangle;
        for (std::size_t c = 0; c < 3; ++c) {
            const Vec2f& uv = flat.flat.uvs[0][t[c]];
            if (!(uv[0] >= 0 && uv[0] <= 1 && uv[1] >= 0 && uv[1] <= 1)) {
                fault = "some are outside of [0, 1]";
                return {};
            }
            result.push_back(uv);
            triangle[c] = {uv[0], uv[1]};
        }
        const double area = twice_signed_area(triangle[0], triangle[1], triangle[2]);
        if (area < 0) std::swap(triangle[1], triangle[2]);
        if (area != 0) triangles.push_back(triangle);
    }
    std::uint64_t work = 1000000 + 1000 * triangles.size();
    if (!triangles.empty() && have_disjoint_interiors(triangles, work)) return result;
    fault = "some overlap";
    return {};
}

Part textured_part(const Part& part, const FlatTarget& target, const FlatTarget::Piece& piece,
                   const Part& baked, bool keeps_uvs, const std::vector<Material>& materials,
                   const BakeOptions& bake, const RunContext& context) {
    CornerValues values;
    values.uvs.resize(baked.uvs.size());
    std::vector<Index> with_tangents;  // faces
    Part to = part;
    to.face_material.clear();
    for (Index f = 0; f < part.triangles.size(); ++f) {
        const Index flat_face = piece.first_face + f;
        const Triangle& flat = target.flat.triangles[flat_face];
        const Index material = baked.face_material[flat_face];
        to.face_material.push_back(material);
        if (materials[material].normal_texture) with_tangents.push_back(f);
        if (baked.uvs.empty()) continue;
        for (const Index v : part.triangles[f]) {
            // Mirrored faces have their corners in another order.
            const auto c = std::ranges::find(flat, piece.first_vertex + v) - flat.begin();
            values.uvs[0].push_back(baked.uvs[0][baked.triangles[flat_face][static_cast<std::size_t>(c)]]);
        }
    }
    if (!with_tangents.empty()) {
        std::unique_ptr<TargetMesh> mesh = target_mesh(part, bake, context);
        set_tangents(mesh->part, with_tangents, values.uvs[0], values.tangents);
        if (part.normals.empty()) values.normals = std::move(mesh->part.normals.normals);
    }
    SimplifyResult split;  // with the vertices of the part
    split.mesh.positions = part.positions;
    split.mesh.triangles = part.triangles;
    WeldedPart welded = weld_corners({.source = &part, .simplified = &split, .map = nullptr}, values);
    std::vector<Index> vertices;
    for (const std::uint64_t c : welded.corner) vertices.push_back(part.triangles[c / 3][c % 3]);
    select_vertices(part, vertices, to);
    to.colors.clear();
    to.triangles = std::move(welded.part.triangles);
    if (!keeps_uvs && !baked.uvs.empty()) to.uvs = std::move(welded.part.uvs);
    to.tangents = std::move(welded.part.tangents);
    if (!welded.part.normals.empty()) to.normals = std::move(welded.part.normals);
    return to;
}

}  // namespace faqem::detail

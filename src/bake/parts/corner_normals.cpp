#include "bake/parts/corner_normals.hpp"

#include <algorithm>
#include <cmath>

#include "bake/parts/corner_points.hpp"
#include "bake/source/source_normals.hpp"
#include "faqem/detail/base/parallel.hpp"
#include "scene/vector_conversion.hpp"

namespace faqem::detail {
namespace {

using engine::to_eigen;
using engine::Vector3;

constexpr double corner_inset = 0.02;
// Largest number of clusters of a vertex that are searched for a corner. It bounds the work: if there are
// more creases, the remaining corners are not clustered.
constexpr std::size_t max_clusters = 64;

// Angle times area. With the area, a large flat face keeps its normal next to a narrow bevel; with the angle,
// the result depends little on how a fan is triangulated.
double corner_weight(const TriangleMesh& mesh, std::uint64_t corner) {
    const Triangle& t = mesh.triangles[corner / 3];
    const Vector3 p = to_eigen(mesh.positions[t[corner % 3]]);
    const Vector3 a = to_eigen(mesh.positions[t[(corner + 1) % 3]]) - p;
    const Vector3 b = to_eigen(mesh.positions[t[(corner + 2) % 3]]) - p;
    const double area = a.cross(b).norm();
    return std::atan2(area, a.dot(b)) * area;
}

struct Cluster {
    Vector3 seed, sum;
};

// Clusters the corners of one vertex and writes their mean normals. A cluster has the number of its first
// corner.
void smooth_vertex(const TriangleMesh& mesh, std::span<const std::uint64_t> corners,
                   const std::vector<Vector3>& face_normals, const std::vector<Vector3>& raw,
                   double min_normal_cosine, CornerNormals& result) {
    std::vector<Cluster> clusters;
    std::vector<std::size_t> member(corners.size());
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Vector3& n = raw[corners[i]];
        std::size_t k = 0;
        const std::size_t searched = std::min(clusters.size(), max_clusters);
        while (k < searched && !(clusters[k].seed.dot(n) >= min_normal_cosine)) ++k;
        if (k == searched) {
            k = clusters.size();
            clusters.push_back({n, Vector3::Zero()});
        }
        clusters[k].sum += corner_weight(mesh, corners[i]) * n;
        member[i] = k;
    }
    std::vector<Index> number(clusters.size(), no_index);
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const std::uint64_t c = corners[i];
        const Vector3& face_normal = face_normals[c / 3];
        Vector3 n = unit_or_zero(clusters[member[i]].sum);
        Index& first = number[member[i]];
        Index cluster = first == no_index ? first = static_cast<Index>(c) : first;
        if (n.isZero(0)) n = raw[c];
        if (!face_normal.isZero(0) && !(n.dot(face_normal) > 0)) {
            n = face_normal;
            cluster = static_cast<Index>(c);
        }
        result.normals[c] = to_vec3f(n);
        result.clusters[c] = cluster;
    }
}

// Twice the area of a face: positive if its winding agrees with its vertex normals, negative if it
// contradicts them.
double normal_winding_agreement(const Part& part, std::size_t face) {
    Vector3 normals = Vector3::Zero();
    for (std::size_t c = 0; c < 3; ++c) normals += corner_normal(part, face, c);
    const Vector3 area = area_vector(part.positions, part.triangles[face]);
    const double result = normals.dot(area);
    return result > 0 ? area.norm() : result < 0 ? -area.norm() : 0;
}

std::vector<std::uint8_t> faces_with_reversed_winding(const BakePart& part) {
    std::vector<std::uint8_t> result(part.faces(), 0);
    if (part.source->normals.empty()) return result;
    double total = 0;
    for (std::size_t f = 0; f < part.source->triangles.size(); ++f) {
        total += normal_winding_agreement(*part.source, f);
    }
    if (!(total > 0)) return result;
    for (std::size_t f = 0; f < result.size(); ++f) {
        result[f] = normal_winding_agreement(*part.source, part.simplified->history.kept_faces[f]) < 0;
    }
    return result;
}

// Sets the normals of the corners for which the source has one.
void transfer_normals(const BakePart& part, const RunContext& context, std::vector<Vector3>& normals) {
    const auto set = [&](std::uint64_t corner, const SurfacePoint& point) {
        const Vector3 original = interpolated_normal(*part.source, point);
        if (!original.isZero(0)) normals[corner] = original;
    };
    if (!part.map) return visit_corner_points(part, corner_inset, context, set);
    parallel_blocks(normals.size(), 768, context, [&](std::size_t begin, std::size_t end) {
        for (std::size_t c = begin; c < end; ++c)
            set(c, part.map->map(static_cast<Index>(c / 3), barycentrics_near_corner(c % 3, corner_inset)));
    });
}

}  // namespace

Vector3 oriented_face_normal(const BakePart& part, std::size_t face) {
    const Vector3 face_normal =
        winding_normal(part.simplified->mesh.positions, part.simplified->mesh.triangles[face]);
    return part.normals.has_reversed_winding[face] ? Vector3(-face_normal) : face_normal;
}

bool is_crease(const CornerNormals& normals, std::size_t face, std::size_t corner, std::size_t other,
               std::size_t other_corner) {
    const auto cluster = [&](std::size_t f, std::size_t c) { return normals.clusters[3 * f + c % 3]; };
    return cluster(face, corner + 1) != cluster(other, other_corner + 2) &&
           cluster(face, corner + 2) != cluster(other, other_corner + 1);
}

CornerNormals make_normals(const BakePart& part, const BakeOptions& options, const RunContext& context) {
    const TriangleMesh& mesh = part.simplified->mesh;
    const std::size_t corners = 3 * mesh.triangles.size();
    const bool transfers = options.normals == Normals::transfer;
    std::vector<Vector3> raw(corners), face_normals(mesh.triangles.size());
    CornerNormals result{std::vector<Vec3f>(corners), std::vector<Index>(corners),
                         faces_with_reversed_winding(part)};
    parallel_blocks(mesh.triangles.size(), 256, context, [&](std::size_t begin, std::size_t end) {
        for (std::size_t f = begin; f < end; ++f) {
            face_normals[f] = winding_normal(mesh.positions, mesh.triangles[f]);
            if (transfers && result.has_reversed_winding[f]) face_normals[f] = -face_normals[f];
            for (std::size_t c = 3 * f; c < 3 * f + 3; ++c) raw[c] = face_normals[f];
        }
    });
    if (transfers) transfer_normals(part, context, raw);
    for (std::size_t c = 0; c < corners; ++c) {
        const Vector3& face_normal = face_normals[c / 3];
        if (raw[c].isZero(0)) raw[c] = Vector3(0, 0, 1);
        if (!face_normal.isZero(0) && !(raw[c].dot(face_normal) > 0)) raw[c] = face_normal;
    }
    // The tolerance allows for rounding differences between equal normals.
    const double min_normal_cosine = std::cos(options.crease_angle * (std::acos(-1.0) / 180)) - 1e-6;
    const VertexCorners at = vertex_corners(mesh);
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        smooth_vertex(mesh, at.at(v), face_normals, raw, min_normal_cosine, result);
    }
    if (options.normals == Normals::flat) {
        std::transform(raw.begin(), raw.end(), result.normals.begin(), to_vec3f);
    }
    return result;
}

}  // namespace faqem::detail

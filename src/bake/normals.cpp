#include "bake/normals.hpp"

#include <algorithm>
#include <cmath>

#include "bake/directions.hpp"
#include "bake/source_normals.hpp"
#include "parallel.hpp"

namespace faqem::detail {
namespace {

using engine::to_eigen;
using engine::Vector3;

constexpr double inset = 0.02;
// Vertices with more creases than this keep the rest of their corners apart, so that the work stays bounded.
constexpr std::size_t most_clusters = 64;

// Angle times area: a large flat face keeps its normal next to a narrow bevel, and how a fan is cut up does
// not matter.
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

// Writes the mean normals of one vertex; clusters are numbered by their first corner.
void smooth_vertex(const TriangleMesh& mesh, std::span<const std::uint64_t> corners,
                   const std::vector<Vector3>& raw, double least_cosine, CornerNormals& result) {
    std::vector<Cluster> clusters;
    std::vector<std::size_t> member(corners.size());
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Vector3& n = raw[corners[i]];
        std::size_t k = 0;
        const std::size_t searched = std::min(clusters.size(), most_clusters);
        while (k < searched && !(clusters[k].seed.dot(n) >= least_cosine)) ++k;
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
        const Vector3 side = winding_normal(mesh.positions, mesh.triangles[c / 3]);
        Vector3 n = unit_or_zero(clusters[member[i]].sum);
        Index& first = number[member[i]];
        Index cluster = first == no_index ? first = static_cast<Index>(c) : first;
        if (n.isZero(0)) n = raw[c];
        if (!side.isZero(0) && !(n.dot(side) > 0)) {
            n = side;
            cluster = static_cast<Index>(c);
        }
        result.normals[c] = to_float(n);
        result.clusters[c] = cluster;
    }
}

}  // namespace

CornerNormals make_normals(const SmallPart& part, const BakeOptions& options, std::uint32_t threads) {
    const TriangleMesh& mesh = part.small->mesh;
    const std::size_t corners = 3 * mesh.triangles.size();
    std::vector<Vector3> raw(corners);
    parallel_blocks(mesh.triangles.size(), 256, threads, [&](std::size_t begin, std::size_t end) {
        for (std::size_t c = 3 * begin; c < 3 * end; ++c) {
            const Vector3 side = winding_normal(mesh.positions, mesh.triangles[c / 3]);
            raw[c] = side;
            if (options.normals == Normals::transfer) {
                const SurfacePoint point =
                    part.map->map(static_cast<Index>(c / 3), near_corner(c % 3, inset));
                const Vector3 original = smooth_normal(*part.source, point);
                if (!original.isZero(0)) raw[c] = original;
            }
            if (raw[c].isZero(0)) raw[c] = Vector3(0, 0, 1);
            if (!side.isZero(0) && !(raw[c].dot(side) > 0)) raw[c] = side;
        }
    });
    // The cosine is lowered a little: equal normals differ by rounding.
    const double least_cosine = std::cos(options.crease_angle * (std::acos(-1.0) / 180)) - 1e-6;
    const VertexCorners at = vertex_corners(mesh);
    CornerNormals result{std::vector<Vec3f>(corners), std::vector<Index>(corners)};
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        smooth_vertex(mesh, at.at(v), raw, least_cosine, result);
    }
    if (options.normals == Normals::flat) {
        std::transform(raw.begin(), raw.end(), result.normals.begin(), to_float);
    }
    return result;
}

}  // namespace faqem::detail

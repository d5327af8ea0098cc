#include "bake/parts/corner_normals.hpp"

#include <algorithm>
#include <cmath>

#include "bake/parts/corner_points.hpp"
#include "bake/source/facets.hpp"
#include "bake/source/source_normals.hpp"
#include "scene/vector_conversion.hpp"

namespace faqem::detail {
namespace {

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
    Index facet;
};

// What the normals of the corners come from.
struct RawNormals {
    std::vector<Vector3> face_normals;  // by face
    std::vector<Vector3> normals;       // by corner
    std::vector<Vector3> inner;         // by corner: of the source inside the face; 0: unknown
    std::vector<Index> facets;          // by corner; no_index: of no facet that is as large as the face
    std::vector<Index> source_facets;   // by corner, of any size; no_index: unknown
    std::vector<float> min_cosines;     // by corner: the cosine of the angle to the face must be above
    std::vector<std::uint8_t>
        is_joined;  // by facet: its corners at a vertex have one normal whatever their angle

    bool joins(Index facet) const { return facet != no_index && !is_joined.empty() && is_joined[facet]; }
    bool is_accepted(std::uint64_t corner, const Vector3& normal) const {
        const Vector3& of_face = face_normals[corner / 3];
        return of_face.isZero(0) || normal.dot(of_face) > min_cosines[corner];
    }
};

// Clusters the corners of one vertex and writes their mean normals. A cluster has the number of its first
// corner.
void smooth_vertex(const TriangleMesh& mesh, std::span<const std::uint64_t> corners, const RawNormals& raw,
                   double min_normal_cosine, CornerNormals& result) {
    std::vector<Cluster> clusters;
    std::vector<std::size_t> member(corners.size());
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Vector3& n = raw.normals[corners[i]];
        const Index facet = raw.facets[corners[i]];
        const auto joins = [&](const Cluster& cluster) {
            return cluster.facet == facet && (raw.joins(facet) || cluster.seed.dot(n) >= min_normal_cosine);
        };
        std::size_t k = 0;
        const std::size_t searched = std::min(clusters.size(), max_clusters);
        while (k < searched && !joins(clusters[k])) ++k;
        if (k == searched) {
            k = clusters.size();
            clusters.push_back({n, Vector3::Zero(), facet});
        }
        clusters[k].sum += corner_weight(mesh, corners[i]) * n;
        member[i] = k;
    }
    std::vector<Index> number(clusters.size(), no_index);
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const std::uint64_t c = corners[i];
        Vector3 n = unit_or_zero(clusters[member[i]].sum);
        Index& first = number[member[i]];
        Index cluster = first == no_index ? first = static_cast<Index>(c) : first;
        if (n.isZero(0)) n = raw.normals[c];
        if (!raw.joins(raw.facets[c]) && !raw.is_accepted(c, n)) {
            n = raw.face_normals[c / 3];
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
    for (std::size_t f = 0; f < part.source->triangles.size(); ++f)
        total += normal_winding_agreement(*part.source, f);
    if (!(total > 0)) return result;
    for (std::size_t f = 0; f < result.size(); ++f)
        result[f] = normal_winding_agreement(*part.source, part.simplified->history.remaining_faces[f]) < 0;
    return result;
}

// Least cosine of the angle between a normal of the result and its face. Normals that make a large angle with the faces
// of the source, as those of leaves that all point up, may do so in the result, too.
float min_normal_cosine_at(double source_cosine) {
    const double cosine = std::abs(source_cosine);
    return cosine < 0.5 ? static_cast<float>(-cosine - 0.25) : 0.0f;
}

// Sets the normals of the corners for which the source has one.
// \param keeps_vertices  whether vertices are not split on facets of the source on which its own are not
void transfer_normals(const BakePart& part, bool keeps_vertices, const RunContext& context, RawNormals& raw) {
    const Facets facets = normal_facets(*part.source);
    const TriangleMesh& mesh = part.simplified->mesh;
    if (keeps_vertices && !facets.of_face.empty()) {
        raw.is_joined = facets.is_seamless;
        for (std::size_t c = 0; c < raw.facets.size(); ++c) {
            const Index facet = facets.of_face[part.simplified->history.remaining_faces[c / 3]];
            if (facets.is_seamless[facet]) raw.facets[c] = facet;
        }
    }
    visit_corner_points(
        part, context, [&](std::uint64_t corner, const SurfacePoint& nearby, const SurfacePoint& inner) {
            if (inner.face != no_index) raw.inner[corner] = interpolated_normal(*part.source, inner);
            if (nearby.face == no_index) return;
            Vector3 original = interpolated_normal(*part.source, nearby);
            if (!original.isZero(0)) raw.normals[corner] = original;
            if (original.isZero(0) || facets.of_face.empty()) return;
            // A corner may be beyond the edge of the facet that its face shows.
            const Vector3& of_face = raw.face_normals[corner / 3];
            const bool is_beyond = inner.face != no_index &&
                                   facets.of_face[inner.face] != facets.of_face[nearby.face] &&
                                   raw.inner[corner].dot(of_face) > original.dot(of_face);
            if (is_beyond) raw.normals[corner] = original = raw.inner[corner];
            const Index face = is_beyond ? inner.face : nearby.face, facet = facets.of_face[face];
            raw.min_cosines[corner] = min_normal_cosine_at(
                original.dot(winding_normal(part.source->positions, part.source->triangles[face])));
            raw.source_facets[corner] = facet;
            const double area = triangle_area(mesh.positions, mesh.triangles[corner / 3]);
            if (2 * facets.areas[facet] >= area) raw.facets[corner] = facet;
        });
}

// Fits the normals of the clusters by least squares: the normals that viewers interpolate between the corners shall be
// those of the source all over the faces. A cluster keeps its mean if it is on several facets of the source, whose edges
// it rounds, or if its fitted normal points away from one of its faces.
void fit_normals(const TriangleMesh& mesh, const RawNormals& raw, const RunContext& context,
                 CornerNormals& result) {
    const std::vector<Index>& clusters = result.clusters;
    const std::size_t corners = clusters.size();
    std::vector<Vector3> samples(corners), fitted(corners);
    for (std::size_t c = 0; c < corners; ++c) fitted[c] = to_vector(result.normals[c]);
    // The samples have the weights 2/3, 1/6 and 1/6: their mean has the integral of a product of two weights.
    const auto mixed = [](const std::vector<Vector3>& of, std::size_t c) {
        const std::size_t f = c - c % 3;
        return Vector3((of[c] * 3 + of[f] + of[f + 1] + of[f + 2]) / 6);
    };
    // Where the source has no point, or one on the other side of a thin wall, the normals of the corners remain.
    for (std::size_t c = 0; c < corners; ++c) {
        const Vector3& inner = raw.inner[c];
        samples[c] = !inner.isZero(0) && raw.is_accepted(c, inner) ? inner : mixed(fitted, c);
    }
    // Relative to their diagonal the eigenvalues of the normal equations are in [0.5, 2], so a few Jacobi iterations
    // suffice; they need no sums over all corners, which other vector units would round differently.
    constexpr double relaxation = 0.8;
    constexpr int iterations = 12;
    std::vector<double> areas(corners / 3), weights(corners, 0);  // by face, by cluster
    std::vector<std::uint8_t> is_kept(corners, 0);                // by cluster
    for (std::size_t c = 0; c < corners; ++c) {
        const Index k = clusters[c], facet = raw.source_facets[c];
        areas[c / 3] = triangle_area(mesh.positions, mesh.triangles[c / 3]);
        weights[k] += areas[c / 3] / 2;
        if (facet == no_index || facet != raw.source_facets[k]) is_kept[k] = 1;
    }
    std::vector<Vector3> residuals(corners);
    for (int i = 0; i < iterations; ++i) {
        context.check_now();
        std::ranges::fill(residuals, Vector3::Zero());
        for (std::size_t c = 0; c < corners; ++c) {
            const std::size_t f = c - c % 3;
            const Vector3 sum = fitted[c] + fitted[f] + fitted[f + 1] + fitted[f + 2];
            residuals[clusters[c]] += areas[c / 3] * (mixed(samples, c) - sum / 4);
        }
        for (std::size_t c = 0; c < corners; ++c) {
            const Index k = clusters[c];
            if (!is_kept[k] && weights[k] > 0) fitted[c] += relaxation / weights[k] * residuals[k];
        }
    }
    for (std::size_t c = 0; c < corners; ++c) {
        fitted[c] = unit_or_zero(fitted[c]);
        const bool is_accepted = raw.joins(raw.facets[c]) || raw.is_accepted(c, fitted[c]);
        if (!is_accepted || !fitted[c].allFinite() || fitted[c].isZero(0)) is_kept[clusters[c]] = 1;
    }
    for (std::size_t c = 0; c < corners; ++c)
        if (!is_kept[clusters[c]]) result.normals[c] = to_vec3f(fitted[c]);
}

}  // namespace

Vector3 oriented_face_normal(const BakePart& part, std::size_t face) {
    const Vector3 face_normal =
        winding_normal(part.simplified->mesh.positions, part.simplified->mesh.triangles[face]);
    return part.normals.has_reversed_winding[face] ? Vector3(-face_normal) : face_normal;
}

Vector3 blended_normal(const BakePart& part, Index face, const Vec3& weights) {
    Vector3 sum = Vector3::Zero();
    for (std::size_t i = 0; i < 3; ++i)
        sum += weights[i] * to_vector(part.normals.normals[std::size_t{3} * face + i]);
    return sum;
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
    const bool transfers = options.normals != Normals::smooth && options.normals != Normals::flat;
    const bool keeps_vertices = options.normals == Normals::automatic && !makes_atlas(options.kind);
    RawNormals raw{.face_normals = std::vector<Vector3>(mesh.triangles.size()),
                   .normals = std::vector<Vector3>(corners),
                   .inner = std::vector<Vector3>(corners, Vector3::Zero()),
                   .facets = std::vector<Index>(corners, no_index),
                   .source_facets = std::vector<Index>(corners, no_index),
                   .min_cosines = std::vector<float>(corners, 0.0f),
                   .is_joined = {}};
    CornerNormals result{std::vector<Vec3f>(corners), std::vector<Index>(corners),
                         faces_with_reversed_winding(part)};
    parallel_each(mesh.triangles.size(), 256, context, [&](std::size_t f) {
        Vector3& face_normal = raw.face_normals[f];
        face_normal = winding_normal(mesh.positions, mesh.triangles[f]);
        if (transfers && result.has_reversed_winding[f]) face_normal = -face_normal;
        for (std::size_t c = 3 * f; c < 3 * f + 3; ++c) raw.normals[c] = face_normal;
    });
    if (transfers) transfer_normals(part, keeps_vertices, context, raw);
    for (std::size_t c = 0; c < corners; ++c) {
        Vector3& n = raw.normals[c];
        if (n.isZero(0)) n = Vector3(0, 0, 1);
        if (!raw.is_accepted(c, n)) n = raw.face_normals[c / 3];
    }
    // The tolerance allows for rounding differences between equal normals.
    const double min_normal_cosine = std::cos(options.crease_angle * (std::acos(-1.0) / 180)) - 1e-6;
    const VertexCorners at = vertex_corners(mesh);
    for (std::size_t v = 0; v < mesh.positions.size(); ++v)
        smooth_vertex(mesh, at[v], raw, min_normal_cosine, result);
    if (transfers) fit_normals(mesh, raw, context, result);
    if (options.normals == Normals::flat)
        std::transform(raw.normals.begin(), raw.normals.end(), result.normals.begin(), to_vec3f);
    return result;
}

}  // namespace faqem::detail

#pragma once

#include "faqem/detail/geometry/surface_samples.hpp"

#include <cmath>
#include <cstdint>
#include <utility>

FAQEM_DETAIL_BEGIN

/// The k-th point of a low-discrepancy sequence in the triangle, as barycentric coordinates: the R2 sequence
/// of the unit square (Roberts 2018), whose upper half is folded to the lower one. Its steps are 1/g and
/// 1/g^2, where g is the real root of g^3 = g + 1.
inline Vec3 even_barycentric(std::size_t k) {
    const auto fraction = [&](double step) {
        const double x = 0.5 + step * static_cast<double>(k);
        return x - std::floor(x);
    };
    double v = fraction(0.75487766624669276), w = fraction(0.56984029099805327);
    if (v + w > 1) v = 1 - v, w = 1 - w;
    return {1 - v - w, v, w};
}

FAQEM_INLINE std::vector<Vector3> unit_normals(const MeshRef& mesh) {
    std::vector<Vector3> normals;
    normals.reserve(mesh.triangles.size());
    for (const Triangle& t : mesh.triangles)
        normals.push_back(t[0] == no_index ? Vector3(Vector3::Zero())
                                           : area_vector(mesh.positions, t).normalized());
    return normals;
}

FAQEM_INLINE std::vector<SurfaceSample> area_uniform_samples(const MeshRef& mesh, std::size_t count) {
    std::vector<double> cumulative_area;
    double area = 0;
    for (const Triangle& t : mesh.triangles) {
        if (t[0] != no_index) area += area_vector(mesh.positions, t).norm();
        cumulative_area.push_back(area);
    }
    std::vector<SurfaceSample> samples;
    if (!(area > 0)) return samples;
    Index face = 0;
    for (std::size_t k = 0; k < count; ++k) {
        const double area_position = (static_cast<double>(k) + 0.5) / static_cast<double>(count) * area;
        while (face + 1 < cumulative_area.size() && !(cumulative_area[face] > area_position)) ++face;
        samples.push_back({face, even_barycentric(k)});
    }
    return samples;
}

FAQEM_INLINE std::vector<SurfaceSample> vertex_and_midpoint_samples(std::span<const Triangle> triangles) {
    std::vector<SurfaceSample> samples;
    std::vector<std::uint8_t> seen;
    for (Index f = 0; f < triangles.size(); ++f) {
        const Triangle& t = triangles[f];
        if (t[0] == no_index) continue;
        for (std::size_t k = 0; k < 3; ++k) {
            SurfaceSample corner{f, {0, 0, 0}};
            corner.barycentric[k] = 1;
            if (seen.size() <= t[k]) seen.resize(std::size_t{t[k]} + 1, 0);
            if (!std::exchange(seen[t[k]], std::uint8_t{1})) samples.push_back(corner);
            corner.barycentric[k] = corner.barycentric[(k + 1) % 3] = 0.5;
            samples.push_back(corner);
        }
    }
    return samples;
}

FAQEM_INLINE std::vector<OrientedPoint> oriented_vertices(const MeshRef& mesh) {
    std::vector<Vector3> normal(mesh.positions.size(), Vector3::Zero());
    std::vector<std::uint8_t> used(mesh.positions.size(), 0);
    for (const Triangle& t : mesh.triangles) {
        if (t[0] == no_index) continue;
        const Vector3 n = area_vector(mesh.positions, t);
        for (const Index v : t) normal[v] += n, used[v] = 1;
    }
    std::vector<OrientedPoint> points;
    for (std::size_t v = 0; v < used.size(); ++v)
        if (used[v]) points.push_back({mesh.positions[v], normal[v].normalized()});
    return points;
}

FAQEM_DETAIL_END

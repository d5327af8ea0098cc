#pragma once

#include "faqem/detail/geometry/surface.hpp"

#include <algorithm>
#include <cmath>

#include "faqem/error.hpp"

FAQEM_DETAIL_BEGIN

/// Faces whose height is below this fraction of their longest edge have no reliable normal and are left out.
inline constexpr double min_height_ratio = 1e-12;

/// Merges equal positions, removes unreferenced ones, and updates the indices of the triangles.
inline void weld(Surface& s) {
    std::vector<Index> new_index(s.positions.size(), no_index), order;
    for (const Triangle& t : s.triangles) {
        for (const Index v : t) {
            if (new_index[v] != no_index) continue;
            new_index[v] = 0;
            order.push_back(v);
        }
    }
    std::sort(order.begin(), order.end(), [&](Index a, Index b) {
        if (s.positions[a] != s.positions[b]) return s.positions[a] < s.positions[b];
        return a < b;
    });
    std::vector<Vec3> used;
    for (const Index v : order) {
        if (used.empty() || used.back() != s.positions[v]) used.push_back(s.positions[v]);
        new_index[v] = static_cast<Index>(used.size() - 1);
    }
    for (Triangle& t : s.triangles)
        for (Index& v : t) v = new_index[v];
    s.positions = std::move(used);
}

/// Adds a triangle of `mesh` without area to the slivers, unless one of its corners is no position of the surface or two
/// are equal.
inline void add_sliver(const MeshView& mesh, const Triangle& corners, Surface& s) {
    Triangle sliver;
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec3& p = mesh.positions[corners[k]];
        const auto at = std::lower_bound(s.positions.begin(), s.positions.end(), p);
        if (at == s.positions.end() || *at != p) return;
        sliver[k] = static_cast<Index>(at - s.positions.begin());
    }
    if (sliver[0] != sliver[1] && sliver[1] != sliver[2] && sliver[2] != sliver[0])
        s.slivers.push_back(sliver);
}

FAQEM_INLINE Surface extract_surface(const MeshView& mesh) {
    Surface s;
    std::vector<Triangle> without_area;
    s.positions.resize(mesh.positions.size());
    for (std::size_t v = 0; v < s.positions.size(); ++v) s.positions[v] = mesh.positions[v];
    double area = 0;
    for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
        const Triangle t = mesh.triangles[f];
        check_indices(t, f, s.positions.size());
        const auto [a, b, c] = corners_of(s.positions, t);
        const Vector3 n = engine::area_vector(a, b, c);
        const double longest =
            std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
        const double twice_area = n.norm();
        if (!std::isfinite(twice_area)) continue;
        if (!(twice_area > min_height_ratio * longest)) {
            without_area.push_back(t);
            continue;
        }
        area += twice_area / 2;
        s.triangles.push_back(t);
        s.faces.push_back(static_cast<Index>(f));
        s.normals.push_back(n / twice_area);
        s.cumulative_area.push_back(area);
    }
    weld(s);
    for (const Triangle& t : without_area) add_sliver(mesh, t, s);
    if (s.positions.empty()) return s;
    s.low = s.high = to_eigen(s.positions.front());
    for (const Vec3& p : s.positions) {
        s.low = s.low.cwiseMin(to_eigen(p));
        s.high = s.high.cwiseMax(to_eigen(p));
    }
    return s;
}

FAQEM_INLINE Surface extract_nonempty_surface(const MeshView& mesh, const char* name) {
    Surface s = extract_surface(mesh);
    if (s.triangles.empty()) throw InputError({}, name, "has no face with area");
    return s;
}

FAQEM_INLINE double max_normal_cosine(const Bvh& tree, std::span<const Vector3> normals, const Vec3& p,
                                      const Bvh::Hit& hit, const Vector3& normal, double tolerance) {
    double best = normal.dot(normals[hit.face]);
    const double reach = std::sqrt(hit.distance_squared) + tolerance;
    tree.visit_within(p, reach * reach, [&](Index face, const ClosestPoint&) {
        best = std::max(best, normal.dot(normals[face]));
    });
    return std::min(best, 1.0);
}

FAQEM_DETAIL_END

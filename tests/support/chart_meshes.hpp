#pragma once
/// \file
/// Input meshes for the chart atlas, and independent checks of its results.

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "bake/atlas/chart.hpp"
#include "support/meshes.hpp"

namespace faqem::test {

/// The faces of a mesh with their neighbours across edges of exactly two consistently oriented faces.
/// \param density  texels per unit of length
inline std::vector<detail::PageTriangle> chart_faces(const TriangleMesh& mesh, double density) {
    std::vector<detail::PageTriangle> result(mesh.triangles.size());
    std::map<std::pair<Index, Index>, std::vector<std::pair<Index, std::uint8_t>>> edges;
    for (Index f = 0; f < result.size(); ++f) {
        const Triangle& t = mesh.triangles[f];
        result[f].density = density;
        for (std::uint8_t c = 0; c < 3; ++c) {
            result[f].corners[c] = mesh.positions[t[c]];
            const Index a = t[(c + 1) % 3], b = t[(c + 2) % 3];
            edges[{std::min(a, b), std::max(a, b)}].push_back({f, c});
        }
    }
    for (const auto& [edge, sides] : edges) {
        if (sides.size() != 2 || sides[0].first == sides[1].first) continue;
        const auto& [f, c] = sides[0];
        const auto& [g, d] = sides[1];
        if (mesh.triangles[f][(c + 1) % 3] != mesh.triangles[g][(d + 2) % 3]) continue;
        result[f].adjacent[c] = {g, d};
        result[g].adjacent[d] = {f, c};
    }
    return result;
}

/// Area of the intersection of two triangles, by clipping (Sutherland and Hodgman 1974).
inline double shared_area(const detail::Triangle2& a, const detail::Triangle2& b) {
    std::vector<detail::Point2> polygon(a.begin(), a.end());
    for (std::size_t i = 0; i < 3; ++i) {
        const detail::Point2 p = b[i], q = b[(i + 1) % 3];
        std::vector<detail::Point2> inside;
        for (std::size_t k = 0; k < polygon.size(); ++k) {
            const auto &s = polygon[k], &e = polygon[(k + 1) % polygon.size()];
            const double at_s = detail::twice_signed_area(p, q, s), at_e = detail::twice_signed_area(p, q, e);
            if (at_s >= 0) inside.push_back(s);
            if ((at_s > 0 && at_e < 0) || (at_s < 0 && at_e > 0)) {
                inside.push_back(s + (e - s) * (at_s / (at_s - at_e)));
            }
        }
        polygon = std::move(inside);
    }
    double twice = 0;
    for (std::size_t k = 2; k < polygon.size(); ++k)
        twice += detail::twice_signed_area(polygon[0], polygon[k - 1], polygon[k]);
    return twice / 2;
}

/// The largest overlap of two triangles, relative to the smaller one of the two. Brute force over all pairs.
inline double worst_overlap(const std::vector<detail::Triangle2>& triangles) {
    double worst = 0;
    std::vector<detail::Box2> boxes;
    for (const detail::Triangle2& t : triangles) boxes.push_back(detail::bounding_box(t));
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        for (std::size_t j = i + 1; j < triangles.size(); ++j) {
            const detail::Triangle2 &a = triangles[i], &b = triangles[j];
            const detail::Box2 &p = boxes[i], &q = boxes[j];
            if (p.high.x < q.low.x || q.high.x < p.low.x) continue;
            if (p.high.y < q.low.y || q.high.y < p.low.y) continue;
            const double least = std::min(detail::twice_signed_area(a[0], a[1], a[2]),
                                          detail::twice_signed_area(b[0], b[1], b[2])) /
                                 2;
            worst = std::max(worst, shared_area(a, b) / least);
        }
    }
    return worst;
}

}  // namespace faqem::test

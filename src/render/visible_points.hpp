#pragma once
/// \file
/// The pixels of a face, and pictures that tell which point of which face is seen at every pixel.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "render/camera.hpp"

namespace faqem::render {

/// Cross product: positive if b is counter-clockwise from a in a right-handed plane.
inline double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return a.x() * b.y() - a.y() * b.x();
}

/// Twice the signed area of a face in a picture; 0 if it is not completely in front of the camera.
inline double twice_area(const ScreenFace& face) {
    for (const ScreenPoint& corner : face)
        if (!(corner.inverse_depth > 0)) return 0;
    return cross(face[1].at - face[0].at, face[2].at - face[0].at);
}

/// Converts barycentric coordinates in a picture to those on the face.
inline Vector3 perspective_weights(const ScreenFace& face, const Vector3& screen_weights) {
    Vector3 w;
    for (int k = 0; k < 3; ++k) w[k] = screen_weights[k] * face[static_cast<std::size_t>(k)].inverse_depth;
    return w / w.sum();
}

/// Calls visit(pixel, weights, inverse_depth) for the pixels whose centres a face covers, row by row.
/// \param area   twice_area(face), not 0
/// \param size   width and height of the picture in pixels
/// \param visit  is given the index of the pixel, and barycentric coordinates in the picture
template <class Visit>
void for_each_pixel(const ScreenFace& face, double area, std::uint32_t size, const Visit& visit) {
    const Eigen::Vector2d &a = face[0].at, &b = face[1].at, &c = face[2].at;
    const auto range = [size](double low, double high) {
        return std::pair(static_cast<std::uint32_t>(std::clamp<double>(std::floor(low), 0, size)),
                         static_cast<std::uint32_t>(std::clamp<double>(std::ceil(high), 0, size)));
    };
    const auto [x0, x1] = range(std::min({a.x(), b.x(), c.x()}), std::max({a.x(), b.x(), c.x()}));
    const auto [y0, y1] = range(std::min({a.y(), b.y(), c.y()}), std::max({a.y(), b.y(), c.y()}));
    for (std::uint32_t y = y0; y < y1; ++y) {
        for (std::uint32_t x = x0; x < x1; ++x) {
            const Eigen::Vector2d p(x + 0.5, y + 0.5);
            const Vector3 w = Vector3(cross(b - p, c - p), cross(c - p, a - p), cross(a - p, b - p)) / area;
            if (!(w.minCoeff() >= 0)) continue;
            double inverse_depth = 0;
            for (std::size_t k = 0; k < 3; ++k)
                inverse_depth += w[static_cast<Eigen::Index>(k)] * face[k].inverse_depth;
            visit(std::size_t{y} * size + x, w, inverse_depth);
        }
    }
}

/// The point of a mesh that is seen at a pixel.
struct VisiblePoint {
    Index mesh = no_index;  ///< index into the meshes of the picture; no_index: nothing is seen
    Index face = 0;
    Vec3 barycentric = {};
};

/// Draws meshes. Of points at the same depth, that of the first face is taken.
/// \param size     width and height of the picture in pixels
/// \param behind   null, or set to what would be seen without the piece in front
/// \param piece_of piece_of(mesh, face): number of a set of faces; used for `behind` only
/// \return size * size points, top row first
/// Complexity: O(faces + pixels of their bounding boxes).
template <class PieceOf>
std::vector<VisiblePoint> visible_points(std::span<const PlacedMesh> meshes, const Camera& camera,
                                         std::uint32_t size, std::vector<VisiblePoint>* behind,
                                         const PieceOf& piece_of) {
    std::vector<VisiblePoint> result(std::size_t{size} * size);
    std::vector<double> nearest(result.size(), 0), next;  // inverse depths
    if (behind) {
        behind->assign(result.size(), {});
        next.assign(result.size(), 0);
    }
    const auto same_piece = [&](const VisiblePoint& a, const VisiblePoint& b) {
        return a.mesh != no_index && piece_of(a.mesh, a.face) == piece_of(b.mesh, b.face);
    };
    for (Index m = 0; m < meshes.size(); ++m) {
        std::vector<ScreenPoint> points;
        points.reserve(meshes[m].positions.size());
        for (const Vector3& position : meshes[m].positions) points.push_back(project(camera, position, size));
        for (Index f = 0; f < meshes[m].triangles.size(); ++f) {
            const Triangle& t = meshes[m].triangles[f];
            const ScreenFace face = {points[t[0]], points[t[1]], points[t[2]]};
            const double area = twice_area(face);
            if (!(std::abs(area) > 0) || !std::isfinite(area)) continue;
            // y points down in the picture, so the area of counter-clockwise faces is negative.
            if (!meshes[m].sides.empty() && meshes[m].sides[f] * area > 0) continue;
            for_each_pixel(face, area, size, [&](std::size_t pixel, const Vector3& w, double inverse_depth) {
                const bool is_front = inverse_depth > nearest[pixel];
                if (!is_front && !(behind && inverse_depth > next[pixel])) return;
                const Vector3 on_face = perspective_weights(face, w);
                const VisiblePoint point = {m, f, {on_face[0], on_face[1], on_face[2]}};
                VisiblePoint& front = result[pixel];
                if (behind && !same_piece(front, point)) {
                    (*behind)[pixel] = is_front ? front : point;
                    next[pixel] = is_front ? nearest[pixel] : inverse_depth;
                }
                if (!is_front) return;
                front = point;
                nearest[pixel] = inverse_depth;
            });
        }
    }
    return result;
}

/// As above, without what is behind.
inline std::vector<VisiblePoint> visible_points(std::span<const PlacedMesh> meshes, const Camera& camera,
                                                std::uint32_t size) {
    return visible_points(meshes, camera, size, nullptr, [](Index mesh, Index) { return mesh; });
}

}  // namespace faqem::render

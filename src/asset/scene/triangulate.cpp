#include "asset/scene/triangulate.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "asset/scene/reflex_corner_tree.hpp"
#include "asset/scene/repair.hpp"

namespace faqem::detail {
namespace {

using Point = PlanarPoint;

/// Projects the polygon along the dominant axis of its Newell normal, so that it is counter-clockwise. The
/// coordinates are scaled to [-1, 1]. Returns an empty array if the polygon has no area.
std::vector<Point> project(std::span<const Vec3> ring) {
    double extent = 0;
    for (const Vec3& p : ring)
        for (int k = 0; k < 3; ++k) extent = std::max(extent, std::abs(p[k] - ring[0][k]));
    if (!(extent > 0) || !std::isfinite(extent)) return {};
    const auto local = [&](std::size_t i) {
        const Vec3& p = ring[i];
        return Vec3{(p[0] - ring[0][0]) / extent, (p[1] - ring[0][1]) / extent, (p[2] - ring[0][2]) / extent};
    };
    Vec3 normal = {0, 0, 0};
    Vec3 a = local(ring.size() - 1);
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const Vec3 b = local(i);
        for (int k = 0; k < 3; ++k)
            normal[k] += (a[(k + 1) % 3] - b[(k + 1) % 3]) * (a[(k + 2) % 3] + b[(k + 2) % 3]);
        a = b;
    }
    int axis = 0;
    for (int k = 1; k < 3; ++k)
        if (std::abs(normal[k]) > std::abs(normal[axis])) axis = k;
    if (!(std::abs(normal[axis]) > 0)) return {};
    const int u = normal[axis] > 0 ? (axis + 1) % 3 : (axis + 2) % 3;
    const int v = 3 - axis - u;
    std::vector<Point> points(ring.size());
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const Vec3 p = local(i);
        points[i] = {p[u], p[v]};
    }
    return points;
}

/// Whether all corners are convex and the polygon has winding number 1. The latter holds if the edges reverse
/// their direction along x at most twice.
bool is_strictly_convex(const std::vector<Point>& points) {
    const std::size_t n = points.size();
    int reversals = 0;
    double last = 0, first = 0;
    for (std::size_t i = 0; i < n; ++i) {
        const Point &a = points[i], &b = points[(i + 1) % n], &c = points[(i + 2) % n];
        if (!(orient2d(a, b, c) > 0)) return false;
        const double step = b[0] - a[0];
        if (step == 0) continue;
        if (last != 0 && (step > 0) != (last > 0)) ++reversals;
        if (first == 0) first = step;
        last = step;
    }
    if ((first > 0) != (last > 0)) ++reversals;
    return reversals <= 2;
}

/// Ear clipping: a pass over the ring, and then repeatedly the neighbours of the clipped ears.
///
/// A corner that is no ear is tested again when one of its neighbours changes. In a simple polygon nothing else can
/// make it an ear: what blocks it is outside the polygon, and stays there. A polygon that touches itself may have other
/// ears left, also because of rounding, so that a few further passes test all corners.
class EarClipper {
public:
    explicit EarClipper(const std::vector<Point>& points)
        : points_(points),
          next_(points.size()),
          prev_(points.size()),
          remaining_(points.size()),
          is_candidate_(points.size(), 1),
          reflex_(link_corners()) {}

    void run(std::vector<Triangle>& triangles) {
        std::size_t retests = 8 * remaining_ + 1000;  // limit, so that the time remains near-linear
        for (int forced = 0; remaining_ > 3;) {
            const std::size_t before = remaining_;
            clip_ears(triangles);
            if (remaining_ == before) {
                // No ear was found: the polygon intersects itself or is too thin for the precision of double.
                if (++forced > max_forced_clips) break;
                clip(start_corner_, triangles);
            }
            if (remaining_ > retests) continue;
            retests -= remaining_;
            std::ranges::fill(is_candidate_, 1);
        }
        const Index apex = start_corner_;
        for (Index i = next_[apex]; next_[i] != apex; i = next_[i]) triangles.push_back({apex, i, next_[i]});
    }

private:
    static constexpr int max_forced_clips = 64;

    ReflexCornerTree link_corners() {
        const std::size_t n = points_.size();
        for (std::size_t i = 0; i < n; ++i) {
            next_[i] = static_cast<Index>(i + 1 == n ? 0 : i + 1);
            prev_[i] = static_cast<Index>(i == 0 ? n - 1 : i - 1);
        }
        std::vector<Index> corners;
        for (Index i = 0; i < n; ++i)
            if (!is_convex_corner(i)) corners.push_back(i);
        return ReflexCornerTree(points_, corners);
    }

    bool is_remaining(Index i) const { return next_[i] != no_index; }
    bool is_convex_corner(Index i) const {
        return orient2d(points_[prev_[i]], points_[i], points_[next_[i]]) > 0;
    }

    bool is_ear(Index i) const {
        // A corner at the position of the ear's corners is an end of a bridge to a hole and does not block it.
        return is_convex_corner(i) &&
               reflex_.find_in({points_[prev_[i]], points_[i], points_[next_[i]]}) == no_index;
    }

    void clip_ears(std::vector<Triangle>& triangles) {
        std::vector<Index> neighbours;  // of the clipped ears
        const auto clip_if_ear = [&](Index i) {
            if (!is_remaining(i) || !is_candidate_[i]) return;
            is_candidate_[i] = 0;
            if (!is_ear(i)) return;
            neighbours.insert(neighbours.end(), {prev_[i], next_[i]});
            clip(i, triangles);
        };
        Index i = start_corner_;
        for (std::size_t left = remaining_; left > 0 && remaining_ > 3; --left) {
            const Index next = next_[i];
            clip_if_ear(i);
            i = next;
        }
        for (std::size_t q = 0; q < neighbours.size() && remaining_ > 3; ++q) clip_if_ear(neighbours[q]);
    }

    void clip(Index i, std::vector<Triangle>& triangles) {
        const Index before = prev_[i], after = next_[i];
        triangles.push_back({before, i, after});
        next_[before] = after;
        prev_[after] = before;
        start_corner_ = after;
        next_[i] = no_index;
        --remaining_;
        reflex_.set_active(i, false);
        for (const Index neighbour : {before, after}) {
            reflex_.set_active(neighbour, !is_convex_corner(neighbour));
            is_candidate_[neighbour] = 1;
        }
    }

    const std::vector<Point>& points_;
    std::vector<Index> next_, prev_;  // ring of the remaining corners; next_ is no_index for clipped corners
    std::size_t remaining_;
    Index start_corner_ = 0;                  // one of the remaining corners
    std::vector<std::uint8_t> is_candidate_;  // per corner: it may have become an ear since its last test
    ReflexCornerTree reflex_;
};

}  // namespace

void triangulate(std::span<const Vec3> ring, std::vector<Triangle>& triangles) {
    if (ring.size() < 3) return;
    if (ring.size() > 3) {
        const std::vector<Point> points = project(ring);
        if (!points.empty() && !is_strictly_convex(points)) return EarClipper(points).run(triangles);
    }
    for (Index i = 1; i + 1 < ring.size(); ++i) triangles.push_back({0, i, i + 1});
}

TriangulatedPolygons triangulate_polygons(const Polygons& polygons, std::span<const Vec3> positions) {
    TriangulatedPolygons split;
    split.triangles.reserve(polygons.sizes.size());
    split.source_polygon.reserve(polygons.sizes.size());
    std::vector<Vec3> ring;
    std::vector<Triangle> local;
    std::size_t first = 0;
    for (std::size_t p = 0; p < polygons.sizes.size(); ++p) {
        const std::span<const Index> corners(polygons.vertices.data() + first, polygons.sizes[p]);
        first += corners.size();
        const bool finite = std::ranges::all_of(corners, [&](Index v) { return is_finite(positions[v]); });
        split.too_few_corners += corners.size() < 3;
        split.non_finite += corners.size() >= 3 && !finite;
        if (corners.size() < 3 || !finite) continue;
        if (corners.size() == 3) {  // fast path: nearly all polygons of large files are triangles
            local.assign(1, {0, 1, 2});
        } else {
            ring.clear();
            local.clear();
            for (const Index v : corners) ring.push_back(positions[v]);
            triangulate(ring, local);
        }
        for (const Triangle& t : local) {
            split.triangles.push_back({corners[t[0]], corners[t[1]], corners[t[2]]});
            split.source_polygon.push_back(static_cast<Index>(p));
        }
    }
    return split;
}

}  // namespace faqem::detail

#include "asset/formats/triangulate.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace faqem::detail {
namespace {

using Point = std::array<double, 2>;

/// Twice the signed area of the triangle abc; positive if it is counter-clockwise.
double orient2d(const Point& a, const Point& b, const Point& c) {
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

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

/// Uniform grid of the reflex and straight corners. Only these can lie inside a candidate ear.
class ReflexCornerGrid {
public:
    ReflexCornerGrid(const std::vector<Point>& points, std::span<const Index> corners) {
        for (int k = 0; k < 2; ++k) {
            const auto [low, high] = std::minmax_element(
                points.begin(), points.end(), [k](const Point& a, const Point& b) { return a[k] < b[k]; });
            low_[k] = (*low)[k];
            high_[k] = (*high)[k];
        }
        resolution_ = std::clamp<std::size_t>(static_cast<std::size_t>(std::sqrt(corners.size())), 1, 2048);
        start_.assign(resolution_ * resolution_ + 1, 0);
        for (const Index i : corners) ++start_[cell(points[i]) + 1];
        for (std::size_t c = 0; c < resolution_ * resolution_; ++c) start_[c + 1] += start_[c];
        corners_.resize(corners.size());
        std::vector<std::size_t> cursor(start_.begin(), start_.end() - 1);
        for (const Index i : corners) corners_[cursor[cell(points[i])]++] = i;
    }

    /// Whether `test` holds for a corner in one of the cells that a triangle overlaps.
    template <class Test>
    bool any_of(const std::array<Point, 3>& triangle, Test&& test) const {
        const auto [low, high] = std::minmax({triangle[0][1], triangle[1][1], triangle[2][1]});
        for (std::size_t y = cell_coordinate(low - margin, 1); y <= cell_coordinate(high + margin, 1); ++y) {
            // Only the part of the row that the triangle overlaps: most of the bounding box of a long, thin
            // triangle lies outside the triangle.
            const double height = (high_[1] - low_[1]) / static_cast<double>(resolution_);
            const double bottom = low_[1] + height * static_cast<double>(y);
            const auto [left, right] = x_range_between(triangle, bottom - margin, bottom + height + margin);
            const auto row = start_.begin() + static_cast<std::ptrdiff_t>(y * resolution_);
            const std::size_t first = row[static_cast<std::ptrdiff_t>(cell_coordinate(left - margin, 0))];
            const std::size_t last = row[static_cast<std::ptrdiff_t>(cell_coordinate(right + margin, 0)) + 1];
            for (std::size_t i = first; i < last; ++i)
                if (test(corners_[i])) return true;
        }
        return false;
    }

private:
    static constexpr double margin = 1e-12;  // far above the rounding errors of coordinates in [-1, 1]

    /// Range in x of the part of a triangle with y in [bottom, top].
    static Point x_range_between(const std::array<Point, 3>& triangle, double bottom, double top) {
        Point range = {2, -2};
        for (std::size_t i = 0; i < 3; ++i) {
            const Point &a = triangle[i], &b = triangle[(i + 1) % 3];
            if (std::max(a[1], b[1]) < bottom || std::min(a[1], b[1]) > top) continue;
            for (const Point& end : {a, b}) {
                const double t = a[1] == b[1] ? 0 : (std::clamp(end[1], bottom, top) - a[1]) / (b[1] - a[1]);
                const double x = a[1] == b[1] ? end[0] : a[0] + std::clamp(t, 0.0, 1.0) * (b[0] - a[0]);
                range = {std::min(range[0], x), std::max(range[1], x)};
            }
        }
        return range;
    }

    std::size_t cell_coordinate(double x, int k) const {
        const double at = (x - low_[k]) / (high_[k] - low_[k]) * static_cast<double>(resolution_);
        if (!(at > 0)) return 0;
        return at < static_cast<double>(resolution_) ? static_cast<std::size_t>(at) : resolution_ - 1;
    }
    std::size_t cell(const Point& p) const {
        return cell_coordinate(p[1], 1) * resolution_ + cell_coordinate(p[0], 0);
    }

    Point low_, high_;
    std::size_t resolution_ = 1;
    std::vector<std::size_t> start_;
    std::vector<Index> corners_;
};

/// Ear clipping with a queue of candidate corners and a grid of reflex corners.
class EarClipper {
public:
    explicit EarClipper(const std::vector<Point>& points)
        : points_(points),
          next_(points.size()),
          prev_(points.size()),
          remaining_(points.size()),
          grid_(link_corners()) {}

    void run(std::vector<Triangle>& triangles) {
        std::vector<Index> queue;
        for (int forced = 0; remaining_ > 3;) {
            collect_ring(queue);
            const std::size_t before = remaining_;
            for (std::size_t q = 0; q < queue.size() && remaining_ > 3; ++q) {
                const Index i = queue[q];
                if (!is_remaining(i) || !is_ear(i)) continue;
                queue.push_back(prev_[i]);
                queue.push_back(next_[i]);
                clip(i, triangles);
            }
            if (remaining_ != before) continue;
            // No ear was found: the polygon intersects itself or is too thin for the precision of double.
            if (++forced > max_forced_clips) break;
            clip(start_corner_, triangles);
        }
        const Index apex = start_corner_;
        for (Index i = next_[apex]; next_[i] != apex; i = next_[i]) triangles.push_back({apex, i, next_[i]});
    }

private:
    static constexpr int max_forced_clips = 64;

    ReflexCornerGrid link_corners() {
        const std::size_t n = points_.size();
        std::vector<Index> corners;
        for (std::size_t i = 0; i < n; ++i) {
            next_[i] = static_cast<Index>(i + 1 == n ? 0 : i + 1);
            prev_[i] = static_cast<Index>(i == 0 ? n - 1 : i - 1);
        }
        for (std::size_t i = 0; i < n; ++i)
            if (!is_convex_corner(static_cast<Index>(i))) corners.push_back(static_cast<Index>(i));
        return ReflexCornerGrid(points_, corners);
    }

    bool is_remaining(Index i) const { return next_[i] != no_index; }
    bool is_convex_corner(Index i) const {
        return orient2d(points_[prev_[i]], points_[i], points_[next_[i]]) > 0;
    }

    bool is_ear(Index i) const {
        if (!is_convex_corner(i)) return false;
        const Point &a = points_[prev_[i]], &b = points_[i], &c = points_[next_[i]];
        // A corner at the position of a, b or c is an end of a bridge to a hole and does not block the ear.
        return !grid_.any_of({a, b, c}, [&](Index r) {
            const Point& p = points_[r];
            return is_remaining(r) && p != a && p != b && p != c && orient2d(a, b, p) >= 0 &&
                   orient2d(b, c, p) >= 0 && orient2d(c, a, p) >= 0 && !is_convex_corner(r);
        });
    }

    void clip(Index i, std::vector<Triangle>& triangles) {
        triangles.push_back({prev_[i], i, next_[i]});
        next_[prev_[i]] = next_[i];
        prev_[next_[i]] = prev_[i];
        start_corner_ = next_[i];
        next_[i] = no_index;
        --remaining_;
    }

    void collect_ring(std::vector<Index>& ring) const {
        ring.clear();
        Index i = start_corner_;
        do {
            ring.push_back(i);
            i = next_[i];
        } while (i != start_corner_);
    }

    const std::vector<Point>& points_;
    std::vector<Index> next_, prev_;  // ring of the remaining corners; next_ is no_index for clipped corners
    std::size_t remaining_;
    Index start_corner_ = 0;  // one of the remaining corners
    ReflexCornerGrid grid_;
};

bool is_finite(const Vec3& p) { return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]); }

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
        if (corners.size() == 3) {  // fast path: nearly all polygons of large files are triangles
            if (is_finite(positions[corners[0]]) && is_finite(positions[corners[1]]) &&
                is_finite(positions[corners[2]])) {
                split.triangles.push_back({corners[0], corners[1], corners[2]});
                split.source_polygon.push_back(static_cast<Index>(p));
            } else {
                ++split.non_finite;
            }
            continue;
        }
        ring.clear();
        for (const Index v : corners) ring.push_back(positions[v]);
        const bool finite = std::all_of(ring.begin(), ring.end(), is_finite);
        split.too_few_corners += corners.size() < 3;
        split.non_finite += corners.size() >= 3 && !finite;
        if (corners.size() < 3 || !finite) continue;
        local.clear();
        triangulate(ring, local);
        for (const Triangle& t : local) {
            split.triangles.push_back({corners[t[0]], corners[t[1]], corners[t[2]]});
            split.source_polygon.push_back(static_cast<Index>(p));
        }
    }
    return split;
}

}  // namespace faqem::detail

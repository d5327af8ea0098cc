#include "asset/formats/triangulate.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "asset/formats/reflex_corner_tree.hpp"
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

/// Ear clipping in passes over the ring. A pass tests the remaining corners in the order of the ring and then,
/// repeatedly, the neighbours of the clipped ears.
///
/// A corner that is no ear is tested again only when this can change the answer: when one of its neighbours
/// changes, or when the reflex corner that was found in its triangle is clipped or becomes convex.
class EarClipper {
public:
    explicit EarClipper(const std::vector<Point>& points)
        : points_(points),
          next_(points.size()),
          prev_(points.size()),
          remaining_(points.size()),
          blocked_(points.size()),
          is_candidate_(points.size(), 0),
          reflex_(link_corners()) {}

    void run(std::vector<Triangle>& triangles) {
        for (std::size_t i = 0; i < points_.size(); ++i) add_candidate(static_cast<Index>(i));
        for (int forced = 0; remaining_ > 3;) {
            const std::size_t before = remaining_;
            clip_ears(triangles);
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

    /// Corners that wait for a reflex corner to change: a linked list for each reflex corner.
    class BlockedCorners {
    public:
        explicit BlockedCorners(std::size_t corners) : first_(corners, no_index), links_(corners) {}

        void add(Index corner, Index blocker) {
            remove(corner);
            const Index next = first_[blocker];
            links_[corner] = {blocker, no_index, next};
            if (next != no_index) links_[next].prev = corner;
            first_[blocker] = corner;
        }
        void remove(Index corner) {
            const Link link = links_[corner];
            if (link.blocker == no_index) return;
            (link.prev == no_index ? first_[link.blocker] : links_[link.prev].next) = link.next;
            if (link.next != no_index) links_[link.next].prev = link.prev;
            links_[corner] = {};
        }
        /// One of the corners that wait for this one; no_index if there is none.
        Index first(Index blocker) const { return first_[blocker]; }

    private:
        struct Link {
            Index blocker = no_index, prev = no_index, next = no_index;
        };
        std::vector<Index> first_;
        std::vector<Link> links_;
    };

    ReflexCornerTree link_corners() {
        const std::size_t n = points_.size();
        std::vector<Index> corners;
        for (std::size_t i = 0; i < n; ++i) {
            next_[i] = static_cast<Index>(i + 1 == n ? 0 : i + 1);
            prev_[i] = static_cast<Index>(i == 0 ? n - 1 : i - 1);
        }
        for (std::size_t i = 0; i < n; ++i)
            if (!is_convex_corner(static_cast<Index>(i))) corners.push_back(static_cast<Index>(i));
        return ReflexCornerTree(points_, corners);
    }

    bool is_remaining(Index i) const { return next_[i] != no_index; }
    bool is_convex_corner(Index i) const {
        return orient2d(points_[prev_[i]], points_[i], points_[next_[i]]) > 0;
    }

    /// Whether a corner is an ear. If not, the corner is no candidate until this can change.
    bool is_ear(Index i) {
        is_candidate_[i] = 0;
        if (!is_convex_corner(i)) return false;
        // A corner at the position of the ear's corners is an end of a bridge to a hole and does not block it.
        const Index blocker = reflex_.find_in({points_[prev_[i]], points_[i], points_[next_[i]]});
        if (blocker == no_index) return true;
        blocked_.add(i, blocker);
        return false;
    }

    /// Number of corners from the beginning of the current pass to corner i.
    std::size_t steps_to(Index i) const {
        return i >= pass_begin_ ? i - pass_begin_ : i + points_.size() - pass_begin_;
    }
    /// Order of a heap whose first element is the first corner of the pass.
    auto later_in_pass() const {
        return [this](Index a, Index b) { return steps_to(a) > steps_to(b); };
    }

    /// Lets a corner be tested again: in this pass if its turn has yet to come, otherwise in the next one.
    void add_candidate(Index i) {
        blocked_.remove(i);
        if (is_candidate_[i]) return;
        is_candidate_[i] = 1;
        if (pass_at_ == no_index || steps_to(i) <= steps_to(pass_at_)) {
            next_pass_.push_back(i);
        } else {
            this_pass_.push_back(i);
            std::push_heap(this_pass_.begin(), this_pass_.end(), later_in_pass());
        }
    }

    void clip_ears(std::vector<Triangle>& triangles) {
        pass_begin_ = start_corner_;
        std::sort(next_pass_.begin(), next_pass_.end(), later_in_pass());
        next_pass_.erase(std::unique(next_pass_.begin(), next_pass_.end()), next_pass_.end());
        this_pass_.assign(next_pass_.rbegin(), next_pass_.rend());
        next_pass_.clear();
        neighbours_.clear();
        while (!this_pass_.empty() && remaining_ > 3) {
            pass_at_ = this_pass_.front();
            std::pop_heap(this_pass_.begin(), this_pass_.end(), later_in_pass());
            this_pass_.pop_back();
            clip_if_ear(pass_at_, triangles);
        }
        pass_at_ = no_index;
        for (std::size_t q = 0; q < neighbours_.size() && remaining_ > 3; ++q)
            clip_if_ear(neighbours_[q], triangles);
    }

    void clip_if_ear(Index i, std::vector<Triangle>& triangles) {
        if (!is_remaining(i) || !is_candidate_[i] || !is_ear(i)) return;
        neighbours_.push_back(prev_[i]);
        neighbours_.push_back(next_[i]);
        clip(i, triangles);
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
        unblock(i);
        for (const Index neighbour : {before, after}) {
            const bool is_convex = is_convex_corner(neighbour);
            reflex_.set_active(neighbour, !is_convex);
            if (is_convex) unblock(neighbour);
            add_candidate(neighbour);
        }
    }

    void unblock(Index blocker) {
        while (blocked_.first(blocker) != no_index) add_candidate(blocked_.first(blocker));
    }

    const std::vector<Point>& points_;
    std::vector<Index> next_, prev_;  // ring of the remaining corners; next_ is no_index for clipped corners
    std::size_t remaining_;
    Index start_corner_ = 0;  // one of the remaining corners
    BlockedCorners blocked_;
    std::vector<std::uint8_t> is_candidate_;     // per corner: it may be an ear
    std::vector<Index> this_pass_;               // heap of candidates whose turn in this pass has yet to come
    std::vector<Index> next_pass_;               // candidates for the next pass
    std::vector<Index> neighbours_;              // of the ears clipped in this pass
    Index pass_begin_ = 0, pass_at_ = no_index;  // first and current corner; no_index: not within the ring
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
        const bool finite = std::all_of(ring.begin(), ring.end(), is_finite<double, 3>);
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

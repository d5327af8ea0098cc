#pragma once
/// \file
/// Bounding volume hierarchy for closest-point and ray queries on a triangle mesh. It is implemented
/// here because CGAL's AABB tree is GPL, Embree computes in single precision, and no other library that
/// computes distances in double precision is packaged.

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "faqem/detail/geometry/triangle.hpp"
#include "faqem/engine/util/run_context.hpp"
#include "faqem/export.hpp"
#include "faqem/mesh.hpp"

FAQEM_DETAIL_BEGIN

/// Bounding volume hierarchy: a tree of axis-aligned bounding boxes over triangles, with four children per
/// node. The boxes are stored in single precision and rounded outwards; distances are computed in double
/// precision, so that results are exact except for the rounding of doubles. Queries are const and may be made
/// by several threads at once. The tree depends on the mesh only: the same input gives the same tree.
class FAQEM_EXPORT Bvh {
public:
    /// A tree without triangles.
    Bvh() = default;

    /// Builds the tree by the surface area heuristic. Keeps copies of the corner positions.
    /// \param positions  finite, in model units
    /// \param triangles  vertex indices < positions.size(), fewer than 2^31 triangles. Triangles with a
    ///                   corner no_index are left out. Triangles of zero area count as the segment or
    ///                   point that they degenerate to.
    /// \param context    checked during construction; exceptions pass through
    /// O(n log n) time, about 140 bytes per face
    Bvh(std::span<const Vec3> positions, std::span<const Triangle> triangles,
        const engine::RunContext& context = {});
    Bvh(std::span<const Vector3> positions, std::span<const Triangle> triangles,
        const engine::RunContext& context = {});

    /// Replaces the positions and recomputes the boxes; the topology of the tree is kept. Queries stay
    /// correct, but become slower if the vertices have moved far.
    /// \param positions  finite, as many as were passed to the constructor
    /// \param triangles  the triangles that were passed to the constructor
    /// O(n)
    void refit(std::span<const Vector3> positions, std::span<const Triangle> triangles);

    /// Corner positions of a triangle, and its index in the constructor's triangles.
    struct Corners {
        Vector3 a, b, c;
        Index face = no_index;
    };

    /// Result of a closest-point query.
    struct Hit {
        Index face = no_index;  ///< index into the constructor's triangles; no_index: no face in range
        Vec3 barycentric = {};  ///< barycentric coordinates of `point` in the face; >= 0, sum 1
        Vec3 point = {};        ///< the closest point
        double distance_squared = std::numeric_limits<double>::infinity();
    };

    bool empty() const { return triangles_.empty(); }

    /// Finds the point of the mesh that is closest to p. If several faces are at the same distance, the
    /// result is the one with the smallest index.
    /// \param p                     finite
    /// \param max_distance_squared  the search radius squared, inclusive; in squared model units
    /// \return the closest point, or a Hit without a face if none is within the radius
    /// O(log n) typically
    Hit closest(const Vec3& p, double max_distance_squared = std::numeric_limits<double>::infinity()) const {
        return closest_if(
            p, [](const Corners&) { return true; }, max_distance_squared);
    }

    /// Same as closest() without a limit, for callers that know a face near p. The nearer the face, the
    /// faster the query.
    /// \param face   a face of the tree
    /// \param a,b,c  positions of its corners
    Hit closest_with_hint(const Vec3& p, Index face, const Vector3& a, const Vector3& b,
                          const Vector3& c) const {
        const ClosestPoint near = closest_point_on_triangle(to_eigen(p), a, b, c);
        const Hit hit = closest(p, near.distance_squared);
        if (hit.face != no_index) return hit;
        // Because of rounding, the box may appear slightly farther away than the triangle in it.
        return {face, to_array(near.barycentric), to_array(near.point), near.distance_squared};
    }

    /// Same as closest(), restricted to the faces for which filter() returns true.
    /// \param filter          bool(const Corners&); called only for faces closer than the best one so far
    /// \param max_rejections  after this many rejections by the filter, the best face so far is returned
    template <class Filter>
    Hit closest_if(const Vec3& p, Filter&& filter,
                   double max_distance_squared = std::numeric_limits<double>::infinity(),
                   std::size_t max_rejections = std::numeric_limits<std::size_t>::max()) const;

    /// Calls visit(face, const ClosestPoint&) for every face within sqrt(distance_squared) of p (inclusive).
    /// The order of the calls is unspecified, but the same for the same tree and query.
    template <class Visit>
    void visit_within(const Vec3& p, double distance_squared, Visit&& visit) const;

    /// Calls visit(const Corners&, double) for the faces whose bounding box is at most sqrt(limit()) from p, with a
    /// lower bound of the squared distance of the box, nearer boxes first, in an order that is always the same. The
    /// limit is read again after each call, so that it may shrink.
    /// \param limit  () -> double, a squared distance, rounded outwards
    template <class Limit, class Visit>
    void visit_near(const Vec3& p, Limit&& limit, Visit&& visit) const {
        const double unit = 1 / (frame_.scale * frame_.scale);
        traverse(to_eigen(p), limit,
                 [&](const Corners& t, float in_frame) { visit(t, double{in_frame} * unit); });
    }

    /// Which side of a triangle a ray comes from: seen from the front its corners go counter-clockwise.
    enum class Side { front, back };

    /// Returns whether a ray intersects a triangle that is accepted. Edges and corners belong to the
    /// triangle. Triangles that are coplanar with the ray are not hit.
    /// \param origin     start of the ray, finite; the ray has no end
    /// \param direction  finite, of approximately unit length
    /// \param accepts    bool(Index face, Side side); called for intersected triangles until it returns true
    /// O(log n) typically. Source: Moeller and Trumbore 1997
    template <class Accepts>
    bool any_hit(const Vec3& origin, const Vec3& direction, Accepts&& accepts) const;

private:
    static constexpr int width = 4;
    using Lanes = Eigen::Array<float, width, 1>;

    /// Normalized coordinates, in which the bounding box of the mesh is centred at 0 and the largest
    /// coordinate is about 1, so that single precision is sufficient. The mapping is monotone in each
    /// coordinate, also with rounding.
    struct Frame {
        Vector3 centre = Vector3::Zero();
        double scale = 1;
        Vector3 operator()(const Vector3& p) const { return (p - centre) * scale; }
    };

    /// A query point in the frame, as an interval per axis that certainly contains it.
    struct Query {
        Query(const Vector3& p, const Frame& frame);
        std::array<float, 3> low, high;
    };

    /// A ray in the frame.
    struct Ray {
        Ray(const Query& from, const Vector3& direction);
        Query origin;
        std::array<float, 3> inverse;  ///< reciprocal of the direction; large but finite where that is zero
    };

    /// The bounding boxes of up to four children, rounded outwards.
    struct Node {
        std::array<Lanes, 3> low, high;
        std::array<std::uint32_t, width> child = {};  ///< a node, or with `leaf_bit` a triangle
        std::uint32_t count = 0;                      ///< number of children
        /// Lower bounds of the squared distances of p to the children's boxes.
        Lanes distance_squared(const Query& p) const {
            Lanes sum = Lanes::Zero();
            for (std::size_t i = 0; i < 3; ++i)
                sum += (low[i] - p.high[i]).max(p.low[i] - high[i]).max(0.0f).square();
            return sum * (1 - 1e-6f);
        }
        /// For each child, whether the ray may intersect its box. Because of rounding, this may also be true
        /// for boxes that the ray narrowly misses.
        Eigen::Array<bool, width, 1> intersected_boxes(const Ray& ray) const {
            Lanes enter = Lanes::Zero(), leave = Lanes::Constant(std::numeric_limits<float>::max());
            for (std::size_t i = 0; i < 3; ++i) {
                const bool up = ray.inverse[i] > 0;
                const Lanes& entry = up ? low[i] : high[i];
                const Lanes& exit = up ? high[i] : low[i];
                const float far = up ? ray.origin.high[i] : ray.origin.low[i];
                const float near = up ? ray.origin.low[i] : ray.origin.high[i];
                enter = enter.max((entry - far) * ray.inverse[i]);
                leave = leave.min((exit - near) * ray.inverse[i]);
            }
            return enter <= leave * (1 + 1e-6f);
        }
    };
    /// A child that has not been visited yet.
    struct Pending {
        std::uint32_t child;
        float distance_squared;
    };
    static constexpr std::uint32_t leaf_bit = 1u << 31;
    /// From depth `sah_levels` on, ranges are split at the median, which limits the depth of the tree to
    /// `max_depth`.
    static constexpr std::size_t sah_levels = 48, max_depth = sah_levels + 32;

    template <class Positions>
    static std::vector<Corners> corners(const Positions& positions, std::span<const Triangle> triangles);

    struct Build;

    Bvh(std::vector<Corners> triangles, const engine::RunContext& context);
    void fit_boxes();

    /// Converts a squared distance to the frame, rounded up.
    float limit_in_frame(double distance_squared) const;

    /// Calls leaf(corners, squared distance of the box in the frame) for the triangles whose bounding box is within the
    /// squared distance limit() of p, nearest box first. limit() is evaluated again after each call.
    template <class Limit, class Leaf>
    void traverse(const Vector3& p, Limit&& limit, Leaf&& leaf) const;

    Frame frame_;
    std::vector<Corners> triangles_;  ///< the triangles of one node are contiguous
    std::vector<Node> nodes_;
};

template <class Limit, class Leaf>
void Bvh::traverse(const Vector3& p, Limit&& limit, Leaf&& leaf) const {
    if (nodes_.empty()) return;
    const Query query(p, frame_);
    std::array<Pending, (width - 1) * max_depth + 1> stack;
    std::size_t size = 0;
    stack[size++] = {0, 0};
    float bound = limit_in_frame(limit());
    while (size > 0) {
        const Pending top = stack[--size];
        if (!(top.distance_squared <= bound)) continue;
        if (top.child & leaf_bit) {
            leaf(triangles_[top.child & ~leaf_bit], top.distance_squared);
            bound = limit_in_frame(limit());
            continue;
        }
        const Node& node = nodes_[top.child];
        const Lanes distances = node.distance_squared(query);
        const std::size_t first = size;
        for (std::uint32_t k = 0; k < node.count; ++k) {
            const float distance = distances[k];
            if (!(distance <= bound)) continue;
            std::size_t at = size++;
            for (; at > first && stack[at - 1].distance_squared < distance; --at) stack[at] = stack[at - 1];
            stack[at] = {node.child[k], distance};
        }
    }
}

template <class Filter>
Bvh::Hit Bvh::closest_if(const Vec3& p, Filter&& filter, double max_distance_squared,
                         std::size_t max_rejections) const {
    const Vector3 query = to_eigen(p);
    ClosestPoint best;
    best.distance_squared = max_distance_squared;
    Index face = no_index;
    std::size_t rejections = 0;
    constexpr double stop_search = -1;
    traverse(
        query, [&] { return rejections < max_rejections ? best.distance_squared : stop_search; },
        [&](const Corners& t, float) {
            const ClosestPoint hit = closest_point_on_triangle(query, t.a, t.b, t.c);
            const bool nearer = hit.distance_squared < best.distance_squared;
            if (!nearer && !(hit.distance_squared == best.distance_squared && t.face < face)) return;
            if (rejections == max_rejections) return;
            if (!filter(t)) {
                ++rejections;
                return;
            }
            best = hit;
            face = t.face;
        });
    if (face == no_index) return {};
    return {face, to_array(best.barycentric), to_array(best.point), best.distance_squared};
}

template <class Visit>
void Bvh::visit_within(const Vec3& p, double distance_squared, Visit&& visit) const {
    const Vector3 query = to_eigen(p);
    traverse(
        query, [&] { return distance_squared; },
        [&](const Corners& t, float) {
            const ClosestPoint hit = closest_point_on_triangle(query, t.a, t.b, t.c);
            if (hit.distance_squared <= distance_squared) visit(t.face, hit);
        });
}

template <class Accepts>
bool Bvh::any_hit(const Vec3& origin, const Vec3& direction, Accepts&& accepts) const {
    if (nodes_.empty()) return false;
    const Vector3 from = to_eigen(origin), ray_direction = to_eigen(direction);
    const Ray ray(Query(from, frame_), ray_direction);
    const auto is_accepted_hit = [&](const Corners& t) {
        const Vector3 e = t.b - t.a, g = t.c - t.a, h = ray_direction.cross(g), s = from - t.a;
        const double determinant = e.dot(h), sign = determinant < 0 ? -1 : 1;
        const double size = sign * determinant;
        if (!(size > 0)) return false;
        const double u = sign * s.dot(h);
        if (!(u >= 0 && u <= size)) return false;
        const Vector3 q = s.cross(e);
        const double v = sign * ray_direction.dot(q);
        if (!(v >= 0 && u + v <= size)) return false;
        return sign * g.dot(q) > 0 && accepts(t.face, determinant > 0 ? Side::front : Side::back);
    };
    std::array<std::uint32_t, (width - 1) * max_depth + 1> stack;
    std::size_t size = 0;
    stack[size++] = 0;
    while (size > 0) {
        const std::uint32_t top = stack[--size];
        if (top & leaf_bit) {
            if (is_accepted_hit(triangles_[top & ~leaf_bit])) return true;
            continue;
        }
        const Node& node = nodes_[top];
        const Eigen::Array<bool, width, 1> intersected_boxes = node.intersected_boxes(ray);
        for (std::uint32_t k = 0; k < node.count; ++k)
            if (intersected_boxes[k]) stack[size++] = node.child[k];
    }
    return false;
}

FAQEM_DETAIL_END

#ifdef FAQEM_HEADER_ONLY
#include "faqem/detail/geometry/bvh-inl.hpp"
#endif

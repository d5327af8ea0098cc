#pragma once
/// \file
/// Exact closest points on a triangle mesh, and what a ray meets, by a tree of boxes. Own code, because CGAL's
/// AABB tree is GPL, Embree computes in single precision, and no other library with exact double distances is
/// packaged.

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "faqem/detail/geometry/triangle.hpp"
#include "faqem/engine/util/cancellation.hpp"
#include "faqem/export.hpp"
#include "faqem/mesh.hpp"

FAQEM_NAMESPACE_BEGIN
namespace detail {

/// Tree of axis-aligned boxes over triangles, four children to a node. The boxes are in single precision and
/// only ever too large; distances are in double, so that answers are exact but for double's rounding. Queries
/// may come from several threads at once. Depends on nothing but the mesh: same input, same tree.
class FAQEM_EXPORT Bvh {
public:
    /// Of no triangles.
    Bvh() = default;

    /// \param positions  finite
    /// \param triangles  corners < positions.size(); faces with a corner no_index are left out. Faces without
    ///                   area count as the segment or point that they are.
    /// Keeps copies. O(n log n) time, about 140 bytes per face.
    /// \pre fewer than 2^31 triangles
    /// \throws what the poll throws
    Bvh(std::span<const Vec3> positions, std::span<const Triangle> triangles,
        engine::CancellationCheck check_cancelled = {});
    Bvh(std::span<const engine::Vector3> positions, std::span<const Triangle> triangles,
        engine::CancellationCheck check_cancelled = {});

    /// Takes over new positions; the tree's shape stays, and is good as long as little has moved.
    /// \param triangles  those of the constructor
    /// \throws what the poll throws: then the tree is of no use any more.
    /// O(n)
    void refit(std::span<const engine::Vector3> positions, std::span<const Triangle> triangles,
               engine::CancellationCheck check_cancelled = {});

    /// A point of the mesh.
    struct Hit {
        Index face = no_index;  ///< index into the constructor's triangles; no_index: nothing in range
        Vec3 barycentric = {};  ///< weights of the face's corners, >= 0, sum 1
        Vec3 point = {};
        double distance_squared = std::numeric_limits<double>::infinity();
    };

    bool empty() const { return triangles_.empty(); }

    /// The point of the mesh closest to p, if it is at most sqrt(max_distance_squared) away (inclusive). Of
    /// faces at the same distance the one with the smallest index. O(log n) typically.
    Hit closest(const Vec3& p, double max_distance_squared = std::numeric_limits<double>::infinity()) const {
        return closest_if(
            p, [](Index) { return true; }, max_distance_squared);
    }

    /// As closest() without limit, for one who knows a face near p; the nearer, the faster.
    /// \param face     of the tree
    /// \param a,b,c    its corners
    Hit closest_with_hint(const Vec3& p, Index face, const engine::Vector3& a, const engine::Vector3& b,
                          const engine::Vector3& c) const {
        const ClosestPoint near = closest_point_on_triangle(engine::to_eigen(p), a, b, c);
        const Hit hit = closest(p, near.distance_squared);
        if (hit.face != no_index) return hit;
        // Rounding: the box may seem a last digit farther than what is in it.
        return {face, engine::to_array(near.barycentric), engine::to_array(near.point),
                near.distance_squared};
    }

    /// As closest(), over the faces f with filter(f) only. The filter is asked for faces that would be the
    /// best so far.
    /// \param max_rejections  that many times the filter may say no; then the best so far is the answer
    template <class Filter>
    Hit closest_if(const Vec3& p, Filter&& filter,
                   double max_distance_squared = std::numeric_limits<double>::infinity(),
                   std::size_t max_rejections = std::numeric_limits<std::size_t>::max()) const;

    /// Calls visit(face, const ClosestPoint&) for every face at most sqrt(distance_squared) from p, in no
    /// particular but always the same order.
    template <class Visit>
    void visit_within(const Vec3& p, double distance_squared, Visit&& visit) const;

    /// Which side of a triangle a ray comes from: seen from the front its corners go counter-clockwise.
    enum class Side { front, back };

    /// Whether a ray meets a triangle that counts; edges and corners are of the triangle. One that the ray
    /// lies in is not met.
    /// \param origin     finite; the ray goes on without end
    /// \param direction  finite, of about unit length
    /// \param accepts     (face, Side) -> bool, asked for triangles that are met
    /// O(log n) typically. Source: Moeller and Trumbore 1997
    template <class Accepts>
    bool any_hit(const Vec3& origin, const Vec3& direction, Accepts&& accepts) const;

private:
    using Vector3 = engine::Vector3;
    static constexpr int width = 4;
    using Lanes = Eigen::Array<float, width, 1>;

    /// Where single precision is good enough: the whole mesh is about [-1, 1]^3. Both steps are monotone.
    struct Frame {
        Vector3 centre = Vector3::Zero();
        double scale = 1;
        Vector3 operator()(const Vector3& p) const { return (p - centre) * scale; }
    };

    /// A query in the frame, as an interval that has it for certain.
    struct Query {
        Query(const Vector3& p, const Frame& frame);
        std::array<float, 3> low, high;
    };

    /// A ray in the frame.
    struct Ray {
        Ray(const Query& from, const Vector3& direction);
        Query origin;
        std::array<float, 3> inverse;  ///< of the direction; large where that is zero
    };

    /// The boxes of up to four children, rounded outwards.
    struct Node {
        std::array<Lanes, 3> low, high;
        std::array<std::uint32_t, width> child = {};  ///< a node, or with `leaf_bit` one of `triangles_`
        std::uint32_t count = 0;                      ///< of children
        /// Of the children's boxes from p; less by rounding, but never more.
        Lanes distance_squared(const Query& p) const {
            Lanes sum = Lanes::Zero();
            for (std::size_t i = 0; i < 3; ++i) {
                sum += (low[i] - p.high[i]).max(p.low[i] - high[i]).max(0.0f).square();
            }
            return sum * (1 - 1e-6f);
        }
        /// Which of the children's boxes a ray goes through; by rounding some that it passes by.
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
    struct Corners {
        Vector3 a, b, c;
        Index face = no_index;
    };
    struct Pending {
        std::uint32_t child;
        float distance_squared;
    };
    static constexpr std::uint32_t leaf_bit = 1u << 31;
    /// Splits halve the range from `sah_levels` on, so that no tree is deeper.
    static constexpr std::size_t sah_levels = 48, max_depth = sah_levels + 32;

    template <class Positions>
    static std::vector<Corners> corners(const Positions& positions, std::span<const Triangle> triangles,
                                        engine::CancellationCheck check_cancelled);

    struct Build;

    Bvh(std::vector<Corners> triangles, engine::CancellationCheck check_cancelled);
    void fit_boxes(engine::CancellationCheck check_cancelled);

    /// A squared distance in the frame, rounded up.
    float limit_in_frame(double distance_squared) const;

    /// Visits triangles, nearest box first, while their box is within limit() of p.
    template <class Limit, class Leaf>
    void traverse(const Vector3& p, Limit&& limit, Leaf&& leaf) const;

    Frame frame_;
    std::vector<Corners> triangles_;  ///< those of a node lie together
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
            leaf(triangles_[top.child & ~leaf_bit]);
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
    const Vector3 query = engine::to_eigen(p);
    ClosestPoint best;
    best.distance_squared = max_distance_squared;
    Index face = no_index;
    std::size_t rejections = 0;
    constexpr double stop_search = -1;
    traverse(
        query, [&] { return rejections < max_rejections ? best.distance_squared : stop_search; },
        [&](const Corners& t) {
            const ClosestPoint hit = closest_point_on_triangle(query, t.a, t.b, t.c);
            const bool nearer = hit.distance_squared < best.distance_squared;
            if (!nearer && !(hit.distance_squared == best.distance_squared && t.face < face)) return;
            if (rejections == max_rejections) return;
            if (!filter(t.face)) {
                ++rejections;
                return;
            }
            best = hit;
            face = t.face;
        });
    if (face == no_index) return {};
    return {face, engine::to_array(best.barycentric), engine::to_array(best.point), best.distance_squared};
}

template <class Visit>
void Bvh::visit_within(const Vec3& p, double distance_squared, Visit&& visit) const {
    const Vector3 query = engine::to_eigen(p);
    traverse(
        query, [&] { return distance_squared; },
        [&](const Corners& t) {
            const ClosestPoint hit = closest_point_on_triangle(query, t.a, t.b, t.c);
            if (hit.distance_squared <= distance_squared) visit(t.face, hit);
        });
}

template <class Accepts>
bool Bvh::any_hit(const Vec3& origin, const Vec3& direction, Accepts&& accepts) const {
    if (nodes_.empty()) return false;
    const Vector3 from = engine::to_eigen(origin), ray_direction = engine::to_eigen(direction);
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
        for (std::uint32_t k = 0; k < node.count; ++k) {
            if (intersected_boxes[k]) stack[size++] = node.child[k];
        }
    }
    return false;
}

}  // namespace detail
FAQEM_NAMESPACE_END

#ifdef FAQEM_HEADER_ONLY
#include "faqem/detail/geometry/bvh-inl.hpp"
#endif

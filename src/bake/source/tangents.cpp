#include "bake/source/tangents.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "asset/scene/value_numbers.hpp"
#include "faqem/detail/geometry/halfedges.hpp"

namespace faqem::detail {
namespace {

using Eigen::Vector3f;

constexpr std::uint32_t absent = std::numeric_limits<std::uint32_t>::max();

Vector3f to_vector3f(const Vec3f& v) { return {v[0], v[1], v[2]}; }

bool is_not_zero(float x) { return std::abs(x) > std::numeric_limits<float>::min(); }

// The order of the sum in Eigen's dot products depends on the processor.
float dot(const Vector3f& a, const Vector3f& b) { return a.x() * b.x() + (a.y() * b.y() + a.z() * b.z()); }
float length(const Vector3f& v) { return std::sqrt(dot(v, v)); }

Vector3f unit(const Vector3f& v) {
    const float norm = length(v);
    return is_not_zero(norm) && std::isfinite(norm) ? Vector3f(v / norm) : Vector3f::Zero();
}

Vector3f project_and_normalize(const Vector3f& v, const Vector3f& normal) {
    return unit(v - dot(normal, v) * normal);
}

Vec4f any_tangent(const Vector3f& normal) {
    const Vector3f axis = std::abs(normal.x()) < 0.7f ? Vector3f::UnitX() : Vector3f::UnitY();
    Vector3f tangent = project_and_normalize(axis, normal);
    if (tangent.isZero(0)) tangent = axis;
    return {tangent.x(), tangent.y(), tangent.z(), 1};
}

// By corner: the number of its vertex, in the order of the first corners. -0 and 0 are equal.
std::vector<std::uint32_t> weld(std::span<const TangentCorner> corners) {
    UniqueValues<std::array<float, 8>> vertices;
    std::vector<std::uint32_t> result;
    for (const auto& [p, n, uv] : corners) {
        std::array key = {p[0], p[1], p[2], n[0], n[1], n[2], uv[0], uv[1]};
        for (float& x : key) x += 0.0f;
        result.push_back(vertices.insert(key));
    }
    return result;
}

class Tangents {
public:
    explicit Tangents(std::span<const TangentCorner> corners)
        : corners_(corners),
          vertex_(weld(corners)),
          faces_(corners.size() / 3),
          adjacent_face_(corners.size(), absent),
          group_(corners.size(), absent) {
        for (std::size_t f = 0; f < faces_.size(); ++f) measure(f);
        find_neighbours();
    }

    std::vector<Vec4f> operator()() {
        for (std::uint32_t c = 0; c < group_.size(); ++c) {
            const Face& face = faces_[c / 3];
            if (face.is_degenerate || !face.has_tangent || group_[c] != absent) continue;
            grow_group(c);
        }
        std::vector<Vec4f> result(corners_.size());
        for (std::size_t c = 0; c < result.size(); ++c)
            result[c] = group_[c] == absent ? any_tangent(normal(c)) : tangents_[group_[c]];
        copy_to_degenerate_faces(result);
        return result;
    }

private:
    struct Face {
        Vector3f along_u = Vector3f::Zero();     // unit vector
        bool is_orientation_preserving = false;  // the UVs have the winding of the corners, with v down
        bool has_tangent = false;                // the area in the UVs is not zero
        bool is_degenerate = false;              // two corners have equal positions
    };

    Vector3f position(std::size_t c) const { return to_vector3f(corners_[c].position); }
    Vector3f normal(std::size_t c) const { return to_vector3f(corners_[c].normal); }
    static std::size_t next(std::size_t c) { return c % 3 == 2 ? c - 2 : c + 1; }
    static std::size_t previous(std::size_t c) { return c % 3 == 0 ? c + 2 : c - 1; }

    void measure(std::size_t f) {
        const std::size_t c = 3 * f;
        Face& face = faces_[f];
        const Vec3f &p0 = corners_[c].position, &p1 = corners_[c + 1].position,
                    &p2 = corners_[c + 2].position;
        face.is_degenerate = p0 == p1 || p0 == p2 || p1 == p2;
        const Vec2f &a = corners_[c].uv, &b = corners_[c + 1].uv, &d = corners_[c + 2].uv;
        const float u1 = b[0] - a[0], v1 = b[1] - a[1], u2 = d[0] - a[0], v2 = d[1] - a[1];
        const Vector3f e1 = position(c + 1) - position(c), e2 = position(c + 2) - position(c);
        const float area = u1 * v2 - v1 * u2;
        face.is_orientation_preserving = area > 0;
        if (!is_not_zero(area)) return;
        const Vector3f along_u = e1 * v2 - e2 * v1, along_v = e2 * u1 - e1 * u2;
        const float norm = length(along_u);
        face.along_u = (face.is_orientation_preserving ? 1.0f : -1.0f) * unit(along_u);
        face.has_tangent = is_not_zero(norm / std::abs(area)) &&
                           is_not_zero(length(along_v) / std::abs(area)) && std::isfinite(norm);
    }

    // Pairs faces across edges. A face has at most one neighbour per edge: the first one with consistent
    // winding that has no neighbour yet.
    void find_neighbours() {
        std::vector<Triangle> triangles;
        triangles.reserve(faces_.size());
        for (std::size_t f = 0; f < faces_.size(); ++f) {
            const bool is_left_out = faces_[f].is_degenerate;
            triangles.push_back(
                {is_left_out ? no_index : vertex_[3 * f], vertex_[3 * f + 1], vertex_[3 * f + 2]});
        }
        std::vector<std::uint32_t> waiting;
        for_each_edge(sorted_halfedges(triangles), [&](std::span<const Halfedge> on) {
            // All waiting half-edges have the same direction.
            waiting.clear();
            std::size_t first = 0;
            for (const Halfedge& halfedge : on) {
                const std::uint32_t c = 3 * halfedge.face + halfedge.corner;
                if (first < waiting.size() && vertex_[waiting[first]] != vertex_[c]) {
                    adjacent_face_[c] = waiting[first] / 3;
                    adjacent_face_[waiting[first]] = c / 3;
                    ++first;
                } else {
                    waiting.push_back(c);
                }
            }
        });
    }

    // Makes a group of the corners around a vertex that share a tangent with the corner `seed`.
    void grow_group(std::uint32_t seed) {
        const bool is_orientation_preserving = faces_[seed / 3].is_orientation_preserving;
        const auto number = static_cast<std::uint32_t>(tangents_.size());
        const std::uint32_t vertex = vertex_[seed];
        Vector3f sum = Vector3f::Zero();
        std::vector<std::uint32_t> stack = {seed / 3};
        while (!stack.empty()) {
            const std::uint32_t f = stack.back();
            stack.pop_back();
            std::size_t c = 3 * std::size_t{f};
            while (vertex_[c] != vertex) ++c;
            if (group_[c] != absent) continue;
            Face& face = faces_[f];
            if (!face.has_tangent && has_no_group(f))
                face.is_orientation_preserving = is_orientation_preserving;
            if (face.is_orientation_preserving != is_orientation_preserving) continue;
            group_[c] = number;
            if (face.has_tangent) sum += weighted_tangent(c);
            // Depth-first, in the order of the reference implementation: the order decides which group faces
            // without a tangent join.
            for (const std::uint32_t other : {adjacent_face_[previous(c)], adjacent_face_[c]})
                if (other != absent) stack.push_back(other);
        }
        const Vector3f tangent = unit(sum);
        // v points down in glTF and up in MikkTSpace: UVs with the winding of the corners are mirrored.
        tangents_.push_back(tangent.isZero(0) ? any_tangent(normal(seed))
                                              : Vec4f{tangent.x(), tangent.y(), tangent.z(),
                                                      is_orientation_preserving ? -1.0f : 1.0f});
    }

    bool has_no_group(std::size_t f) const {
        return group_[3 * f] == absent && group_[3 * f + 1] == absent && group_[3 * f + 2] == absent;
    }

    // The direction of u on the face of corner c, in the tangent plane of the corner's normal, weighted by
    // the angle of the corner in this plane.
    Vector3f weighted_tangent(std::size_t c) const {
        const Vector3f n = normal(c);
        const Vector3f a = project_and_normalize(position(previous(c)) - position(c), n);
        const Vector3f b = project_and_normalize(position(next(c)) - position(c), n);
        const auto angle = static_cast<float>(std::acos(std::clamp(double(dot(a, b)), -1.0, 1.0)));
        return angle * project_and_normalize(faces_[c / 3].along_u, n);
    }

    // Degenerate triangles get the tangents of other triangles at the same vertices.
    void copy_to_degenerate_faces(std::vector<Vec4f>& result) const {
        std::vector<std::uint32_t> donor(corners_.size(), absent);
        for (std::uint32_t c = 0; c < corners_.size(); ++c)
            if (!faces_[c / 3].is_degenerate && donor[vertex_[c]] == absent) donor[vertex_[c]] = c;
        for (std::size_t c = 0; c < corners_.size(); ++c)
            if (faces_[c / 3].is_degenerate && donor[vertex_[c]] != absent)
                result[c] = result[donor[vertex_[c]]];
    }

    std::span<const TangentCorner> corners_;
    std::vector<std::uint32_t> vertex_;  // by corner
    std::vector<Face> faces_;
    std::vector<std::uint32_t> adjacent_face_;  // by corner: across the edge from the corner to the next one
    std::vector<std::uint32_t> group_;          // by corner
    std::vector<Vec4f> tangents_;               // by group
};

}  // namespace

std::vector<Vec4f> mikk_tangents(std::span<const TangentCorner> corners) { return Tangents(corners)(); }

}  // namespace faqem::detail

#pragma once
/// \file
/// An upper bound of the distance of a triangle from a surface of many faces: the faces above and below it.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "faqem/detail/geometry/halfedges.hpp"
#include "faqem/detail/geometry/surface.hpp"
#include "faqem/export.hpp"

FAQEM_DETAIL_BEGIN

/// A surface with the faces at each edge, to cover triangles with its faces.
///
/// A set of faces is grown from one face until each edge above the triangle (along its normal, on either side) belongs to
/// an even number of them. The number of faces of the set above a point, modulo 2, is then the same for all points of the
/// triangle in general position. If it is odd at one of them, a face lies above every point, and the largest height of the
/// faces above the triangle is an upper bound of its distance. Two rims that coincide would be undecidable; therefore the
/// triangle is first shrunk by an eighth of the limit, which the bound includes.
///
/// Immutable; const functions may be called by several threads.
class Covering {
public:
    /// \param surface  not empty; must outlive this object
    /// O(n log n) time, 50 bytes per face
    explicit Covering(const Surface& surface);

    /// Memory of the searches of one thread.
    class Scratch {
    public:
        explicit Scratch(const Covering& covering) : is_in_set_(covering.triangles_.size(), 0) {}

    private:
        friend class Covering;
        std::vector<std::uint8_t> is_in_set_;  // all 0 between searches
        std::vector<Index> set_;
    };

    /// An upper bound of the distance from a triangle to the surface, model units, up to rounding.
    /// \param corner  of the triangle
    /// \param first   a face near its middle
    /// \param limit   largest bound that is of interest
    /// \return infinity if no bound up to the limit was found
    /// O(faces above the triangle)
    double bound(const std::array<Vector3, 3>& corner, Index first, double limit, Scratch& scratch) const;

private:
    struct Prism;
    struct Edge {
        Index begin, count;
    };

    double grow(const Prism& prism, Index first, double limit, Scratch& scratch) const;
    bool covers(const Prism& prism, const std::vector<Index>& set) const;
    std::array<Vector3, 3> projected(const Prism& prism, Index f) const;

    const Surface& surface_;
    std::vector<Triangle> triangles_;  // of the surface, then the slivers
    std::vector<Edge> edges_;          // three per triangle: its range in faces_
    std::vector<Index> faces_;         // by edge
    double size_ = 0;                  // largest coordinate
};

/// Share of the limit by which a triangle is shrunk.
inline constexpr double shrunk_share = 1.0 / 8;
/// Rounding errors of distances, as a fraction of the largest coordinate, with a margin.
inline constexpr double covering_rounding = 64 * std::numeric_limits<double>::epsilon();

/// The part of space above and below a triangle. Its coordinates: two in the plane of the triangle, and the height.
struct Covering::Prism {
    struct Wall {
        double x, y, offset;  // unit normal, inwards
        /// Distance from the wall, which is moved outwards by the rounding errors; negative outside.
        double operator()(const Vector3& p) const { return x * p.x() + y * p.y() - offset; }
    };

    Vector3 middle, across, along, normal;
    std::array<Vector3, 3> corner;
    std::array<Wall, 3> walls;
    double rounding;
    bool is_valid = false;  // false if the triangle is too small or too narrow

    Prism(const std::array<Vector3, 3>& at, double shrunk, double size) {
        middle = (at[0] + at[1] + at[2]) / 3;
        double reach = 0;
        for (const Vector3& p : at) {
            reach = std::max(reach, (p - middle).norm());
            size = std::max(size, p.cwiseAbs().maxCoeff());
        }
        rounding = covering_rounding * size;
        normal = engine::area_vector(at[0], at[1], at[2]);
        across = at[1] - at[0];
        if (!(reach > shrunk && normal.norm() > 0)) return;
        normal.normalize();
        across.normalize();
        along = normal.cross(across);
        for (std::size_t k = 0; k < 3; ++k) corner[k] = (1 - shrunk / reach) * (*this)(at[k]);
        for (std::size_t k = 0; k < 3; ++k) {
            const Vector3 &a = corner[k], &b = corner[(k + 1) % 3];
            const double dx = b.x() - a.x(), dy = b.y() - a.y(), length = std::sqrt(dx * dx + dy * dy);
            if (!(length > rounding)) return;
            walls[k] = {-dy / length, dx / length, 0};
            walls[k].offset = walls[k](a) - rounding;
        }
        is_valid = true;
    }

    Vector3 operator()(const Vector3& p) const {
        const Vector3 from_middle = p - middle;
        return {across.dot(from_middle), along.dot(from_middle), normal.dot(from_middle)};
    }

    /// Largest difference of height between the triangle and a face inside the prism; negative: the face is outside.
    double height(const std::array<Vector3, 3>& face) const {
        std::array<Vector3, 8> polygon, clipped;
        std::copy(face.begin(), face.end(), polygon.begin());
        std::size_t size = 3;
        for (const Wall& wall : walls) {
            std::size_t kept = 0;
            for (std::size_t k = 0; k < size; ++k) {
                const Vector3 &a = polygon[k], &b = polygon[(k + 1) % size];
                const double from_a = wall(a), from_b = wall(b);
                if (from_a >= 0) clipped[kept++] = a;
                if ((from_a >= 0) != (from_b >= 0))
                    clipped[kept++] = a + from_a / (from_a - from_b) * (b - a);
            }
            polygon = clipped;
            size = kept;
        }
        // Because of rounding, the heights of the corners of a narrow triangle may differ.
        double result = -1;
        for (std::size_t k = 0; k < size; ++k)
            for (const Vector3& p : corner) result = std::max(result, std::abs(polygon[k].z() - p.z()));
        return result;
    }

    bool is_entered_by(const Vector3& a, const Vector3& b) const {
        double begin = 0, end = 1;
        for (const Wall& wall : walls) {
            const double from_a = wall(a), from_b = wall(b);
            if (from_a < 0 && from_b < 0) return false;
            if (from_a < 0) begin = std::max(begin, from_a / (from_a - from_b));
            if (from_b < 0) end = std::min(end, from_a / (from_a - from_b));
        }
        return begin <= end;
    }
};

inline Covering::Covering(const Surface& surface)
    : surface_(surface),
      triangles_(surface.triangles),
      size_(surface.low.cwiseAbs().cwiseMax(surface.high.cwiseAbs()).maxCoeff()) {
    triangles_.insert(triangles_.end(), surface.slivers.begin(), surface.slivers.end());
    edges_.resize(3 * triangles_.size());
    faces_.reserve(edges_.size());
    for_each_edge(sorted_halfedges(triangles_), [&](std::span<const Halfedge> edge) {
        const Edge range{static_cast<Index>(faces_.size()), static_cast<Index>(edge.size())};
        for (const Halfedge& h : edge) {
            edges_[std::size_t{3} * h.face + h.corner] = range;
            faces_.push_back(h.face);
        }
    });
}

inline std::array<Vector3, 3> Covering::projected(const Prism& prism, Index f) const {
    const Triangle& t = triangles_[f];
    const auto at = [&](Index v) { return prism(to_eigen(surface_.positions[v])); };
    return {at(t[0]), at(t[1]), at(t[2])};
}

// The largest height of the faces of the set, which is not finished if it is above the limit or infinite.
inline double Covering::grow(const Prism& prism, Index first, double limit, Scratch& scratch) const {
    const auto add = [&](Index f) {
        if (scratch.is_in_set_[f]) return;
        scratch.is_in_set_[f] = 1;
        scratch.set_.push_back(f);
    };
    add(first);
    double highest = 0;
    for (std::size_t i = 0; i < scratch.set_.size(); ++i) {
        const Index f = scratch.set_[i];
        const std::array<Vector3, 3> face = projected(prism, f);
        const double height = prism.height(face);
        if (height < 0) continue;
        highest = std::max(highest, height);
        if (!(highest <= limit)) return highest;
        for (std::size_t k = 0; k < 3; ++k) {
            if (!prism.is_entered_by(face[k], face[(k + 1) % 3])) continue;
            const Edge& edge = edges_[std::size_t{3} * f + k];
            if (edge.count % 2 != 0) return std::numeric_limits<double>::infinity();
            for (Index j = edge.begin; j < edge.begin + edge.count; ++j) add(faces_[j]);
        }
    }
    return highest;
}

// Whether an odd number of faces lies above a point that is not near an edge of them.
inline bool Covering::covers(const Prism& prism, const std::vector<Index>& set) const {
    const auto is_odd = [&](const Vector3& p, bool& is_general) {
        bool odd = false;
        for (const Index f : set) {
            const std::array<Vector3, 3> face = projected(prism, f);
            int left = 0;
            for (std::size_t k = 0; k < 3; ++k) {
                const Vector3 &a = face[k], &b = face[(k + 1) % 3];
                const double x = b.x() - a.x(), y = b.y() - a.y();
                const double area = x * (p.y() - a.y()) - y * (p.x() - a.x());
                is_general = is_general && std::abs(area) > prism.rounding * std::sqrt(x * x + y * y);
                left += area > 0;
            }
            odd ^= left == 0 || left == 3;
        }
        return odd;
    };
    // Arbitrary points. A face that is seen as a line has an edge near each point of this line only.
    for (const auto& [a, b] :
         {std::array{0.3141, 0.2718}, {0.1732, 0.5772}, {0.6180, 0.1414}, {0.4142, 0.4669}}) {
        bool is_general = true;
        const bool odd =
            is_odd(a * prism.corner[0] + b * prism.corner[1] + (1 - a - b) * prism.corner[2], is_general);
        if (is_general) return odd;
    }
    return false;
}

inline double Covering::bound(const std::array<Vector3, 3>& corner, Index first, double limit,
                              Scratch& scratch) const {
    const double shrunk = shrunk_share * limit;
    const Prism prism(corner, shrunk, size_);
    if (!prism.is_valid) return std::numeric_limits<double>::infinity();
    const double height = grow(prism, first, limit - shrunk, scratch);
    const bool is_covered = height <= limit - shrunk && covers(prism, scratch.set_);
    for (const Index f : scratch.set_) scratch.is_in_set_[f] = 0;
    scratch.set_.clear();
    return is_covered ? height + shrunk : std::numeric_limits<double>::infinity();
}

FAQEM_DETAIL_END

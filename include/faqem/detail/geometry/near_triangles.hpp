#pragma once
/// \file
/// The triangles near a ball, for many closest-point queries inside it.

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

#include "faqem/detail/base/vector.hpp"
#include "faqem/detail/geometry/triangle.hpp"
#include "faqem/export.hpp"
#include "faqem/mesh.hpp"

FAQEM_DETAIL_BEGIN

/// A short list of triangles that is searched for the one closest to a point. For each triangle, single precision
/// gives a lower bound of the distance, from the distances to its plane and to its edges. Bounds are compared with a
/// tolerance for their rounding, and only triangles that may be the closest are evaluated in double precision, so
/// that the result is that of closest_point_on_triangle() for all of them.
class FAQEM_EXPORT NearTriangles {
public:
    /// A triangle of the list.
    struct Entry {
        Vector3 a, b, c;        ///< corners
        Index face = no_index;  ///< in the caller's numbering; different for all entries
    };
    /// Result of a query.
    struct Hit {
        const Entry* entry = nullptr;  ///< valid until the next call of reset()
        ClosestPoint at;
    };

    /// Largest number of triangles in a list.
    static constexpr std::size_t max_size = 256;

    /// Coordinates in the plane of a triangle.
    struct Plane {
        Vector3 origin;               ///< the first corner
        Vector3 normal;               ///< of unit length; zero if the triangle is too thin
        std::array<Vector3, 2> axes;  ///< gradients of the weights of the second and the third corner
    };

    /// What a query leaves for the next ones near it.
    struct Recent {
        /// Place in the list of the triangle closest to `at`; max_size: unknown.
        std::size_t entry = max_size;
        Vector3 at = Vector3::Zero();
        double others = 0;  ///< lower bound of the distance of all other triangles of the list from `at`
        std::optional<Plane> plane;  ///< of the triangle, if projection() has needed it
    };

    /// The reach of a list with which most points of a ball have a result. It is complete for all of them with
    /// `distance` + 2 `radius`, but then it has up to three times as many triangles.
    /// \param distance  of the centre from the closest triangle, in model units
    /// \param radius    of the ball, in model units
    static double usual_reach(double distance, double radius) {
        return std::min(distance + 2 * radius, 2 * distance + 1.25 * radius);
    }

    /// Empties the list: closest() finds nothing.
    void clear() { entries_.clear(), groups_.clear(); }

    /// Replaces the list.
    /// \param centre   of the ball, finite
    /// \param reach    radius within which the list is complete: every triangle at most that far from the centre
    ///                 is in it; in model units. The list stays empty if it is not a positive normal number.
    /// \param entries  at most max_size; otherwise the list stays empty
    /// O(entries)
    void reset(const Vector3& centre, double reach, std::vector<Entry> entries);

    /// Makes the list for a smaller ball from this one, with the usual reach or a smaller one.
    /// \param centre  of the smaller ball, finite
    /// \param radius  of the smaller ball, in model units
    /// \param to      another list; empty if this list is not complete for the smaller ball
    /// O(entries)
    void narrow(const Vector3& centre, double radius, NearTriangles& to) const;

    /// Number of triangles.
    std::size_t size() const { return entries_.size(); }
    bool empty() const { return entries_.empty(); }

    /// The triangle closest to p; of several at the same distance, the one with the smallest `face`.
    /// \param p  finite
    /// \return nothing if the list is empty, or if a triangle that is not in it may be as close
    /// O(entries)
    std::optional<Hit> closest(const Vector3& p) const {
        Recent recent;
        return closest(p, recent);
    }
    /// The same in O(1) where the triangle of a query nearby is certainly the closest.
    /// \param recent  of the last query of this list, or of none; receives that of this query
    std::optional<Hit> closest(const Vector3& p, Recent& recent) const;

    /// Projects p to the plane of the triangle `recent.entry`, if the result is certainly the closest point of the list.
    /// It is that of closest() up to rounding, in a fraction of the time. O(1)
    /// \param p       finite
    /// \param recent  of the last query of this list, or of none; receives the plane
    /// \return barycentric coordinates in that triangle; nothing if it may not be the closest one, or if the projection
    ///         is outside it
    std::optional<Vec3> projection(const Vector3& p, Recent& recent) const;

    /// Whether the list contains a face. O(entries)
    bool contains(Index face) const;

private:
    static constexpr int width = 4;
    using Lanes = Eigen::Array<float, width, 1>;
    /// Values of an affine function for several triangles, in coordinates relative to origin_, multiplied by scale_.
    struct Affine {
        Lanes x = Lanes::Zero(), y = Lanes::Zero(), z = Lanes::Zero(), constant = Lanes::Zero();
        Lanes at(float px, float py, float pz) const { return x * px + y * py + z * pz + constant; }
        void set(int lane, const Vector3& gradient, double value_at_zero);
        void copy_lane(int lane, const Affine& from, int other) {
            x[lane] = from.x[other], y[lane] = from.y[other], z[lane] = from.z[other];
            constant[lane] = from.constant[other];
        }
    };
    /// Signed distances of up to four triangles: to the plane, and within it to the edges, positive inside. All are 0
    /// for a triangle without a reliable normal.
    struct Group {
        Affine plane;
        std::array<Affine, 3> edges;
        void copy_lane(int lane, const Group& from, int other) {
            plane.copy_lane(lane, from.plane, other);
            for (std::size_t i = 0; i < 3; ++i) edges[i].copy_lane(lane, from.edges[i], other);
        }
    };
    using Bounds = std::array<Lanes, max_size / width>;

    /// The two smallest bounds.
    struct Smallest {
        float first, second;
    };

    static Plane plane_of(const Entry& entry);
    void fill_last_group();
    Smallest find_bounds(const Vector3& p, Bounds& bounds) const;
    float bound_of(double distance) const;
    double distance_of(float bound) const;
    /// Whether every triangle within a distance of a point is in the list.
    /// \param from_centre  distance of the point from the centre of the ball
    bool is_complete(double from_centre, double distance) const {
        return (from_centre + distance) * scale_ + tolerance_ < reach_ * scale_;
    }
    template <class Visit>
    void for_each_within(const Bounds& bounds, float from, float to, Visit&& visit) const;
    void describe(const Entry& entry, Group& group, int lane) const;

    Vector3 origin_ = Vector3::Zero();  ///< of the coordinates in single precision
    double scale_ = 0;                  ///< factor to these coordinates, in which distances are small
    double tolerance_ = 0;              ///< of distances in these coordinates
    Vector3 centre_ = Vector3::Zero();  ///< of the ball
    double reach_ = 0;                  ///< radius in which the list is complete
    std::vector<Entry> entries_;
    std::vector<Group> groups_;
};

FAQEM_DETAIL_END

#ifdef FAQEM_HEADER_ONLY
#include "faqem/detail/geometry/near_triangles-inl.hpp"
#endif

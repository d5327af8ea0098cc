#pragma once
/// \file
/// How far points of two surfaces are from the other one, kept up while the vertices of one of them move. The
/// closest points are looked for everywhere at first. Later they are followed from face to face while they
/// come nearer: a gap is never too short, and what it leads to is rarely not the closest point of all.

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "faqem/export.hpp"
#include "faqem/detail/geometry/bvh.hpp"
#include "faqem/detail/geometry/vertex_faces.hpp"
#include "faqem/detail/fitting/gauss_newton.hpp"
#include "faqem/detail/base/parallel.hpp"
#include "faqem/detail/geometry/surface_samples.hpp"

FAQEM_NAMESPACE_BEGIN
namespace detail {

/// A surface that stays, with what is asked of it again and again. Refers to its arguments.
struct StillSurface {
    /// \throws what the poll throws
    explicit StillSurface(const Patchwork& surface, Workers workers = {}) : mesh(surface) {
        parallel_blocks(2, 1, workers, [&](std::size_t part, std::size_t, Poll poll) {
            if (part == 0) {
                tree = Bvh(surface.positions, surface.triangles, poll);
            } else {
                normals = unit_normals(surface, poll);
                around = faces_around(surface.positions.size(), surface.triangles, poll);
            }
        });
    }

    Patchwork mesh;
    Bvh tree;
    std::vector<engine::Vector3> normals;
    FacesAround around;
};

/// Gaps from spots of a mesh that moves to one that stays.
class GapsThere {
public:
    /// \param original   refers to it
    /// \param triangles  of the moving mesh; refers to them
    /// \param spots      on these triangles
    GapsThere(const StillSurface& original, std::span<const Triangle> triangles, std::vector<Spot> spots)
        : original_(original),
          triangles_(triangles),
          spots_(std::move(spots)),
          gaps_(spots_.size()),
          squared_(spots_.size()) {}

    /// Measures where the mesh has moved since the last time; all of it at first.
    /// \param workers  the result does not depend on how many
    /// O(spots log faces) at first, typically; then O(1) for each spot whose face has moved, where it has
    /// moved by few faces
    void move_to(std::span<const engine::Vector3> positions, Workers workers);

    /// Searches anew where a gap is longer than a share of the longest, until all of those are what a search
    /// finds: what was followed may lead to a false farthest point.
    /// O(spots), and O(log faces) for each of them
    void search_farthest(double share, Workers workers);

    /// Takes other spots on some faces, whose corners may be others too.
    /// \param faces  of each triangle: nonzero has other spots now
    /// \param spots  on these faces
    void replace(std::span<const std::uint8_t> faces, std::span<const Spot> spots);

    std::size_t size() const { return spots_.size(); }
    const Spot& spot(std::size_t i) const { return spots_[i]; }
    /// From spot i to its closest point.
    const engine::Vector3& gap(std::size_t i) const { return gaps_[i].gap; }
    /// Its squared length.
    double squared(std::size_t i) const { return squared_[i]; }
    /// With the normal of the moving face: where the closest face is one of several, its own would be chance.
    Pull pull(std::size_t i) const;

    /// Distance between the unit normals at spot i and at its closest point; there, of all faces that are as
    /// near but for `tolerance`, the one with the nearest normal counts. Remembered until the face moves.
    void measure_turns(double tolerance, Workers workers);
    double turn(std::size_t i) const { return gaps_[i].turn; }

private:
    struct Gap {
        engine::Vector3 gap = engine::Vector3::Zero();
        Index face = no_index;    ///< of the original
        std::uint8_t corner = 0;  ///< the nearest one of the face, or 3: the closest point is inside
        double turn = -1;         ///< < 0: not measured
        bool is_found = false;    ///< by a search, not followed
    };
    void search(std::size_t i, Index near);
    void set(std::size_t i, const engine::Vector3& p, const Bvh::Hit& hit);
    engine::Vector3 normal(std::size_t i) const;

    const StillSurface& original_;
    std::span<const Triangle> triangles_;
    std::vector<Spot> spots_;
    std::vector<Gap> gaps_;
    std::vector<double> squared_;  ///< lengths of the gaps, apart: the longest is looked for often
    std::vector<engine::Vector3> positions_;
};

/// Gaps from points that stay to a mesh that moves.
class GapsBack {
public:
    /// \param triangles  of the moving mesh; refers to them
    GapsBack(std::vector<OrientedPoint> points, std::span<const Triangle> triangles)
        : triangles_(triangles),
          points_(std::move(points)),
          gaps_(points_.size()),
          squared_(points_.size()) {}

    /// As GapsThere::move_to(), of the points whose closest face or a neighbour of it has moved. O(faces)
    /// more.
    /// \param swapped  of each triangle, or empty: nonzero has other corners than the last time
    void move_to(std::span<const engine::Vector3> positions, Workers workers,
                 std::span<const std::uint8_t> swapped = {});

    /// As GapsThere::search_farthest(). O(faces) more.
    void search_farthest(double share, Workers workers);

    std::size_t size() const { return points_.size(); }
    const OrientedPoint& point(std::size_t i) const { return points_[i]; }
    /// Where on the moving mesh the point nearest to point i is.
    const Spot& spot(std::size_t i) const { return gaps_[i].spot; }
    /// From there to point i.
    const engine::Vector3& gap(std::size_t i) const { return gaps_[i].gap; }
    /// Its squared length.
    double squared(std::size_t i) const { return squared_[i]; }
    Pull pull(std::size_t i) const { return {gaps_[i].spot, gaps_[i].gap, points_[i].normal}; }

private:
    struct Gap {
        Spot spot;
        engine::Vector3 gap = engine::Vector3::Zero();
        bool is_found = false;  ///< by a search, not followed
    };
    void start_at(std::span<const engine::Vector3> positions, Workers workers);
    void search(std::size_t i, Index near);
    void set(std::size_t i, const Bvh::Hit& hit);

    std::span<const Triangle> triangles_;
    std::vector<OrientedPoint> points_;
    std::vector<Gap> gaps_;
    std::vector<double> squared_;  ///< lengths of the gaps, apart: the longest is looked for often
    std::vector<engine::Vector3> positions_;
    FacesAround around_;
    std::optional<Bvh> tree_;
    bool tree_is_behind_ = false;  ///< the triangles have moved since
};

}  // namespace detail
FAQEM_NAMESPACE_END

#ifdef FAQEM_HEADER_ONLY
#include "faqem/detail/fitting/closest_point_tracker-inl.hpp"
#endif

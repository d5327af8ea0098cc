#pragma once
/// \file
/// How far points of two surfaces are from the other one, kept up while the vertices of one of them move. The
/// closest points are looked for everywhere at first. Later they are followed from face to face while they
/// come nearer: a residual is never too short, and what it leads to is rarely not the closest point of all.

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "faqem/detail/base/parallel.hpp"
#include "faqem/detail/fitting/gauss_newton.hpp"
#include "faqem/detail/geometry/bvh.hpp"
#include "faqem/detail/geometry/surface_samples.hpp"
#include "faqem/detail/geometry/vertex_faces.hpp"
#include "faqem/export.hpp"

FAQEM_NAMESPACE_BEGIN
namespace detail {

/// A surface that stays, with what is asked of it again and again. Refers to its arguments.
struct ReferenceSurface {
    /// \throws what the poll throws
    explicit ReferenceSurface(const MeshRef& surface, Workers workers = {}) : mesh(surface) {
        parallel_blocks(2, 1, workers, [&](std::size_t part, std::size_t, CancellationCheck check_cancelled) {
            if (part == 0) {
                tree = Bvh(surface.positions, surface.triangles, check_cancelled);
            } else {
                normals = unit_normals(surface, check_cancelled);
                vertex_faces =
                    make_vertex_faces(surface.positions.size(), surface.triangles, check_cancelled);
            }
        });
    }

    MeshRef mesh;
    Bvh tree;
    std::vector<engine::Vector3> normals;
    VertexFaces vertex_faces;
};

/// Gaps from samples of a mesh that moves to one that stays.
class MeshToReferenceTracker {
public:
    /// \param original   refers to it
    /// \param triangles  of the moving mesh; refers to them
    /// \param samples      on these triangles
    MeshToReferenceTracker(const ReferenceSurface& original, std::span<const Triangle> triangles,
                           std::vector<SurfaceSample> samples)
        : original_(original),
          triangles_(triangles),
          samples_(std::move(samples)),
          residuals_(samples_.size()),
          squared_distances_(samples_.size()) {}

    /// Measures where the mesh has moved since the last time; all of it at first.
    /// \param workers  the result does not depend on how many
    /// O(samples log faces) at first, typically; then O(1) for each sample whose face has moved, where it has
    /// moved by few faces
    void update(std::span<const engine::Vector3> positions, Workers workers);

    /// Searches anew where a residual is longer than a share of the longest, until all of those are what a search
    /// finds: what was followed may lead to a false farthest point.
    /// O(samples), and O(log faces) for each of them
    void search_farthest(double share, Workers workers);

    /// Takes other samples on some faces, whose corners may be others too.
    /// \param faces  of each triangle: nonzero has other samples now
    /// \param samples  on these faces
    void replace_samples(std::span<const std::uint8_t> faces, std::span<const SurfaceSample> samples);

    std::size_t size() const { return samples_.size(); }
    const SurfaceSample& sample(std::size_t i) const { return samples_[i]; }
    /// From sample i to its closest point.
    const engine::Vector3& residual(std::size_t i) const { return residuals_[i].residual; }
    /// Its squared length.
    double squared_distance(std::size_t i) const { return squared_distances_[i]; }
    /// With the normal of the moving face: where the closest face is one of several, its own would be chance.
    Correspondence correspondence(std::size_t i) const;

    /// Distance between the unit normals at sample i and at its closest point; there, of all faces that are as
    /// near but for `tolerance`, the one with the nearest normal counts. Remembered until the face moves.
    void measure_normal_deviations(double tolerance, Workers workers);
    double normal_deviation(std::size_t i) const { return residuals_[i].normal_deviation; }

private:
    struct Residual {
        engine::Vector3 residual = engine::Vector3::Zero();
        Index face = no_index;         ///< of the original
        std::uint8_t corner = 0;       ///< the nearest one of the face, or 3: the closest point is inside
        double normal_deviation = -1;  ///< < 0: not measured
        bool is_exact = false;         ///< by a search, not followed
    };
    void search(std::size_t i, Index near);
    void set_residual(std::size_t i, const engine::Vector3& p, const Bvh::Hit& hit);
    engine::Vector3 normal(std::size_t i) const;

    const ReferenceSurface& original_;
    std::span<const Triangle> triangles_;
    std::vector<SurfaceSample> samples_;
    std::vector<Residual> residuals_;
    std::vector<double>
        squared_distances_;  ///< lengths of the residuals, apart: the longest is looked for often
    std::vector<engine::Vector3> positions_;
};

/// Gaps from points that stay to a mesh that moves.
class ReferenceToMeshTracker {
public:
    /// \param triangles  of the moving mesh; refers to them
    ReferenceToMeshTracker(std::vector<OrientedPoint> points, std::span<const Triangle> triangles)
        : triangles_(triangles),
          points_(std::move(points)),
          residuals_(points_.size()),
          squared_distances_(points_.size()) {}

    /// As MeshToReferenceTracker::update(), of the points whose closest face or a neighbour of it has moved. O(faces)
    /// more.
    /// \param flipped  of each triangle, or empty: nonzero has other corners than the last time
    void update(std::span<const engine::Vector3> positions, Workers workers,
                std::span<const std::uint8_t> flipped = {});

    /// As MeshToReferenceTracker::search_farthest(). O(faces) more.
    void search_farthest(double share, Workers workers);

    std::size_t size() const { return points_.size(); }
    const OrientedPoint& point(std::size_t i) const { return points_[i]; }
    /// Where on the moving mesh the point nearest to point i is.
    const SurfaceSample& sample(std::size_t i) const { return residuals_[i].sample; }
    /// From there to point i.
    const engine::Vector3& residual(std::size_t i) const { return residuals_[i].residual; }
    /// Its squared length.
    double squared_distance(std::size_t i) const { return squared_distances_[i]; }
    Correspondence correspondence(std::size_t i) const {
        return {residuals_[i].sample, residuals_[i].residual, points_[i].normal};
    }

private:
    struct Residual {
        SurfaceSample sample;
        engine::Vector3 residual = engine::Vector3::Zero();
        bool is_exact = false;  ///< by a search, not followed
    };
    void initialise(std::span<const engine::Vector3> positions, Workers workers);
    void search(std::size_t i, Index near);
    void set_residual(std::size_t i, const Bvh::Hit& hit);

    std::span<const Triangle> triangles_;
    std::vector<OrientedPoint> points_;
    std::vector<Residual> residuals_;
    std::vector<double>
        squared_distances_;  ///< lengths of the residuals, apart: the longest is looked for often
    std::vector<engine::Vector3> positions_;
    VertexFaces vertex_faces_;
    std::optional<Bvh> tree_;
    bool is_tree_outdated_ = false;  ///< the triangles have moved since
};

}  // namespace detail
FAQEM_NAMESPACE_END

#ifdef FAQEM_HEADER_ONLY
#include "faqem/detail/fitting/closest_point_tracker-inl.hpp"
#endif

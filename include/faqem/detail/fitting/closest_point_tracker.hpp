#pragma once
/// \file
/// Residuals between two surfaces, updated while the vertices of one of them move. The closest points are
/// first found by a global search. Later they are tracked: from the previous closest face, a local search
/// moves to adjacent faces while the distance decreases. A tracked residual is never too short, and rarely
/// longer than that of the global closest point.

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

FAQEM_DETAIL_BEGIN

/// A surface that does not move, with its search tree, normals and adjacency.
struct ReferenceSurface {
    /// \param surface  not copied; its arrays must outlive this object
    /// O(n log n)
    explicit ReferenceSurface(const MeshRef& surface, const RunContext& context = {}) : mesh(surface) {
        parallel_blocks(2, 1, context, [&](std::size_t part, std::size_t, const RunContext& block_context) {
            if (part == 0) {
                tree = Bvh(surface.positions, surface.triangles, block_context);
            } else {
                normals = unit_normals(surface);
                vertex_faces = make_vertex_faces(surface.positions.size(), surface.triangles);
            }
        });
    }

    MeshRef mesh;
    Bvh tree;
    std::vector<Vector3> normals;  ///< unit normal of each triangle
    VertexFaces vertex_faces;
};

/// Residuals from sample points of a moving mesh to the reference surface.
class MeshToReferenceTracker {
public:
    /// \param original   the reference surface; must outlive this object
    /// \param triangles  triangles of the moving mesh; must outlive this object
    /// \param samples    sample points on these triangles
    MeshToReferenceTracker(const ReferenceSurface& original, std::span<const Triangle> triangles,
                           std::vector<SurfaceSample> samples)
        : original_(original),
          triangles_(triangles),
          samples_(std::move(samples)),
          residuals_(samples_.size()),
          squared_distances_(samples_.size()) {}

    /// Updates the residuals of samples whose face has moved since the last call. The first call searches
    /// globally, later ones track.
    /// \param positions  current vertex positions of the moving mesh
    /// \param context    the result does not depend on the number of threads
    /// First call: O(samples log faces) typically. Later: O(1) for each sample whose face has moved, if its
    /// closest point has moved by a few faces only.
    void update(std::span<const Vector3> positions, const RunContext& context);

    /// Repeats the global search for all residuals longer than a fraction of the longest one, until all of
    /// these are exact. Otherwise a tracked residual that is too long could determine the maximum distance.
    /// \param share    fraction of the longest residual, in [0, 1]
    /// \param context  the result does not depend on the number of threads
    /// O(samples), plus O(log faces) for each searched residual
    void search_farthest(double share, const RunContext& context);

    /// Replaces the samples on some faces, whose corners may have changed as well.
    /// \param faces    one per triangle; nonzero: the samples of this face are replaced
    /// \param samples  new samples on these faces
    void replace_samples(std::span<const std::uint8_t> faces, std::span<const SurfaceSample> samples);

    std::size_t size() const { return samples_.size(); }
    const SurfaceSample& sample(std::size_t i) const { return samples_[i]; }
    /// Vector from sample i to its closest point.
    const Vector3& residual(std::size_t i) const { return residuals_[i].residual; }
    /// Squared length of residual i.
    double squared_distance(std::size_t i) const { return squared_distances_[i]; }
    /// Correspondence of sample i. It has the normal of the moving face, because the closest face is
    /// arbitrary if several are equally close.
    Correspondence correspondence(std::size_t i) const;

    /// Measures the distances between the unit normals at the samples and at their closest points. Of all
    /// faces that are equally close, the one with the most similar normal is used. Results are kept until the
    /// face moves.
    /// \param tolerance  distances that differ by at most this count as equal
    void measure_normal_deviations(double tolerance, const RunContext& context);
    /// Result for sample i, in [0, 2]; negative if it has not been measured.
    double normal_deviation(std::size_t i) const { return residuals_[i].normal_deviation; }

private:
    struct Residual {
        Vector3 residual = Vector3::Zero();
        Index face = no_index;    ///< closest face of the reference surface
        std::uint8_t corner = 0;  ///< nearest corner of the face; 3: the closest point is in its interior
        double normal_deviation = -1;  ///< negative: not measured
        bool is_exact = false;         ///< result of a global search, not tracked
    };
    /// Finds residual i by a global search. \param near  a face that is probably near, or no_index
    void search(std::size_t i, Index near);
    void set_residual(std::size_t i, const Vector3& p, const Bvh::Hit& hit);
    Vector3 normal(std::size_t i) const;

    const ReferenceSurface& original_;
    std::span<const Triangle> triangles_;
    std::vector<SurfaceSample> samples_;
    std::vector<Residual> residuals_;
    /// Squared lengths of the residuals, in an array of their own because the maximum is needed often.
    std::vector<double> squared_distances_;
    std::vector<Vector3> positions_;
};

/// Residuals from fixed points of the reference surface to a moving mesh.
class ReferenceToMeshTracker {
public:
    /// \param points     the fixed points
    /// \param triangles  triangles of the moving mesh; must outlive this object
    ReferenceToMeshTracker(std::vector<OrientedPoint> points, std::span<const Triangle> triangles)
        : triangles_(triangles),
          points_(std::move(points)),
          residuals_(points_.size()),
          squared_distances_(points_.size()) {}

    /// Same as MeshToReferenceTracker::update(), for the points whose closest face or one of its neighbours
    /// has moved. Takes O(faces) in addition.
    /// \param flipped  one per triangle, or empty; nonzero: the corners of this triangle have changed since
    ///                 the last call
    void update(std::span<const Vector3> positions, const RunContext& context,
                std::span<const std::uint8_t> flipped = {});

    /// Same as MeshToReferenceTracker::search_farthest(). Takes O(faces) in addition.
    void search_farthest(double share, const RunContext& context);

    std::size_t size() const { return points_.size(); }
    const OrientedPoint& point(std::size_t i) const { return points_[i]; }
    /// The point of the moving mesh that is closest to point i.
    const SurfaceSample& sample(std::size_t i) const { return residuals_[i].sample; }
    /// Vector from that point to point i.
    const Vector3& residual(std::size_t i) const { return residuals_[i].residual; }
    /// Squared length of residual i.
    double squared_distance(std::size_t i) const { return squared_distances_[i]; }
    /// Correspondence of point i, with the normal of the reference surface.
    Correspondence correspondence(std::size_t i) const {
        return {residuals_[i].sample, residuals_[i].residual, points_[i].normal};
    }

private:
    struct Residual {
        SurfaceSample sample;
        Vector3 residual = Vector3::Zero();
        bool is_exact = false;  ///< result of a global search, not tracked
    };
    void initialize(std::span<const Vector3> positions, const RunContext& context);
    void search(std::size_t i, Index near);
    void set_residual(std::size_t i, const Bvh::Hit& hit);

    std::span<const Triangle> triangles_;
    std::vector<OrientedPoint> points_;
    std::vector<Residual> residuals_;
    /// Squared lengths of the residuals, in an array of their own because the maximum is needed often.
    std::vector<double> squared_distances_;
    std::vector<Vector3> positions_;
    VertexFaces vertex_faces_;
    std::optional<Bvh> tree_;
    bool is_tree_outdated_ = false;  ///< the mesh has moved since the tree was built or refitted
};

FAQEM_DETAIL_END

#ifdef FAQEM_HEADER_ONLY
#include "faqem/detail/fitting/closest_point_tracker-inl.hpp"
#endif

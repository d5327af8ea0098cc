#pragma once
/// \file
/// Deviation between a moving mesh and a reference surface, measured per face from sample points on both.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "faqem/detail/base/parallel.hpp"
#include "faqem/detail/fitting/closest_point_tracker.hpp"
#include "faqem/detail/fitting/gauss_newton.hpp"
#include "faqem/detail/geometry/surface_samples.hpp"
#include "faqem/export.hpp"

FAQEM_DETAIL_BEGIN

/// Deviation of one or more faces, over the sample points that belong to them.
struct FaceDeviation {
    double max_squared_distance = 0;  ///< square of the maximum distance
    double squared_distance_sum = 0;  ///< sum of the squared distances
    double normal_deviation = 0;      ///< sum of the distances between corresponding unit normals

    void add(const FaceDeviation& other) {
        max_squared_distance = std::max(max_squared_distance, other.max_squared_distance);
        squared_distance_sum += other.squared_distance_sum;
        normal_deviation += other.normal_deviation;
    }
};

/// Sample points on a moving mesh and on a reference surface, with their residuals to the other surface. A
/// point of the reference surface belongs to the face of the mesh that is closest to it.
class TwoSidedError {
public:
    /// \param original   the reference surface, scaled to a bounding box diagonal of 1; must outlive this
    ///                   object
    /// \param triangles  triangles of the mesh; must outlive this object. Edges may be flipped in them later,
    ///                   see resample_flipped().
    /// \param positions  current vertex positions of the mesh
    /// \param context    the results do not depend on the number of threads
    /// \throws whatever `context` throws, here and in the other functions
    TwoSidedError(const ReferenceSurface& original, std::span<const Triangle> triangles,
                  std::span<const Vector3> positions, const RunContext& context);

    /// True if one of the surfaces has no area, so that there is nothing to measure.
    bool empty() const { return from_mesh_.size() == 0 || from_reference_.size() == 0; }

    /// Measures the deviation of each face for the given positions. The longest residuals are found by a
    /// global search and the others are tracked; all are searched if the mesh is much coarser than the
    /// reference surface.
    /// \param positions  current vertex positions of the mesh
    /// \return one entry per triangle
    /// \pre not empty()
    /// O(points log faces) if all residuals are searched
    std::vector<FaceDeviation> measure(std::span<const Vector3> positions);

    /// Same as measure(), for small changes: only the longest residuals are searched.
    std::vector<FaceDeviation> remeasure(std::span<const Vector3> positions);

    /// Updates the residuals that correspondences() returns. Faster than measure(): residuals are tracked
    /// without any search, unless the mesh is much coarser than the reference surface.
    void update_correspondences(std::span<const Vector3> positions);

    /// The correspondences of all points except the vertices of the reference surface. Valid until the next
    /// call of this function.
    std::span<const Correspondence> correspondences();

    /// The correspondences of all points that belong to some faces, including the vertices of the reference
    /// surface.
    /// \param faces  one per triangle; nonzero: include its points
    std::vector<Correspondence> correspondences_at(std::span<const std::uint8_t> faces) const;

    /// Replaces the sample points on triangles that were changed by edge flips.
    /// \param positions  current vertex positions of the mesh
    /// \param flipped    one per triangle; nonzero: its corners have changed since the last call
    void resample_flipped(std::span<const Vector3> positions, std::span<const std::uint8_t> flipped);

    /// Residuals from uniform samples of the reference surface.
    const ReferenceToMeshTracker& from_reference() const { return from_reference_; }
    /// Residuals from the vertices of the reference surface.
    const ReferenceToMeshTracker& from_reference_vertices() const { return from_reference_vertices_; }

private:
    template <class Visit>
    void for_each_tracker(Visit&& visit);
    template <class Visit>
    void for_each_tracker_in_parallel(Visit&& visit);
    std::vector<FaceDeviation> deviations();
    std::size_t point_count() const;
    std::vector<OrientedPoint> even_points() const;

    const ReferenceSurface& original_;
    std::span<const Triangle> triangles_;
    const engine::RunContext& context_;
    std::size_t faces_;                 // number of faces of the mesh
    bool is_coarse_;                    // the mesh is much coarser than the reference surface
    MeshToReferenceTracker from_mesh_;  // from uniform samples
    std::optional<MeshToReferenceTracker> from_mesh_corners_;  // from vertices and edge midpoints
    ReferenceToMeshTracker from_reference_;                    // from uniform samples
    ReferenceToMeshTracker from_reference_vertices_;           // from vertices, for the maximum distance
    std::vector<Correspondence> correspondences_;
};

inline constexpr std::size_t samples_per_face = 10, min_samples = 5000, max_samples = 2'000'000;
/// Number of samples on the original per sample on the mesh. The original has more detail that could be
/// missed.
inline constexpr std::size_t reference_sample_factor = 2;
/// Residuals longer than this fraction of the longest one are searched globally, the others are tracked.
inline constexpr double sample_far_share = 0.9;
/// If the original has at least this many times as many faces as the mesh, tracking fails more often. All
/// residuals are then searched globally if the number of points is the minimum, so that this costs little.
inline constexpr std::size_t coarse_face_ratio = 33;
/// Added to the normal deviation of each point, so that differences of a fraction of a degree have no
/// influence.
inline constexpr double normal_deviation_offset = 0.005;
/// Faces of the original whose distances differ by less than this count as equally close.
inline constexpr double tie_tolerance = 1e-9;

/// Number of the tracker of the original's vertices in for_each_tracker().
inline constexpr std::size_t reference_vertex_tracker = 3;

/// Updates a tracker. Residuals longer than a fraction of the longest are searched globally; 1: none.
template <class Tracker>
void move(Tracker& tracker, std::span<const Vector3> positions, double searched_share,
          const RunContext& context) {
    tracker.update(positions, context);
    if (searched_share < 1) tracker.search_farthest(searched_share, context);
}

inline TwoSidedError::TwoSidedError(const ReferenceSurface& original, std::span<const Triangle> triangles,
                                    std::span<const Vector3> positions, const RunContext& context)
    : original_(original),
      triangles_(triangles),
      context_(context),
      faces_(face_count(triangles)),
      is_coarse_(point_count() == min_samples &&
                 coarse_face_ratio * faces_ <= face_count(original.mesh.triangles)),
      from_mesh_(original, triangles, area_uniform_samples({positions, triangles}, point_count())),
      from_mesh_corners_(std::in_place, original, triangles, vertex_and_midpoint_samples(triangles)),
      from_reference_(even_points(), triangles),
      from_reference_vertices_(oriented_vertices(original.mesh), triangles) {}

inline std::size_t TwoSidedError::point_count() const {
    return std::clamp(samples_per_face * faces_, min_samples, max_samples);
}

inline std::vector<OrientedPoint> TwoSidedError::even_points() const {
    context_.check_now();
    const MeshRef& mesh = original_.mesh;
    std::vector<OrientedPoint> points;
    for (const SurfaceSample& sample : area_uniform_samples(mesh, reference_sample_factor * point_count()))
        points.push_back({sample.position(mesh.positions, mesh.triangles), original_.normals[sample.face]});
    context_.check_now();
    return points;
}

// Calls visit(tracker, number) for the four trackers. The one with the most points is first, so that two
// threads get about the same amount of work.
template <class Visit>
void TwoSidedError::for_each_tracker(Visit&& visit) {
    visit(from_reference_, 0), visit(from_mesh_, 1), visit(*from_mesh_corners_, 2),
        visit(from_reference_vertices_, 3);
}

// Calls visit(tracker, number, context) for the four trackers in parallel.
template <class Visit>
void TwoSidedError::for_each_tracker_in_parallel(Visit&& visit) {
    parallel_blocks(4, 1, context_, [&](std::size_t wanted, std::size_t, const RunContext& block_context) {
        for_each_tracker([&](auto& tracker, std::size_t kind) {
            if (kind == wanted) visit(tracker, kind, block_context);
        });
    });
}

inline void TwoSidedError::update_correspondences(std::span<const Vector3> positions) {
    for_each_tracker([&](auto& tracker, std::size_t kind) {
        if (kind != reference_vertex_tracker) move(tracker, positions, is_coarse_ ? 0 : 1, context_);
    });
}

inline std::vector<FaceDeviation> TwoSidedError::measure(std::span<const Vector3> positions) {
    for_each_tracker([&](auto& tracker, std::size_t) {
        move(tracker, positions, is_coarse_ ? 0 : sample_far_share, context_);
    });
    return deviations();
}

inline std::vector<FaceDeviation> TwoSidedError::remeasure(std::span<const Vector3> positions) {
    for_each_tracker_in_parallel([&](auto& tracker, std::size_t, const RunContext& context) {
        move(tracker, positions, sample_far_share, context.on_one_thread());
    });
    return deviations();
}

inline std::vector<FaceDeviation> TwoSidedError::deviations() {
    for (MeshToReferenceTracker* there : {&from_mesh_, &*from_mesh_corners_})
        there->measure_normal_deviations(tie_tolerance, context_);
    std::array<std::vector<FaceDeviation>, 4> by_tracker;
    for_each_tracker_in_parallel([&](const auto& tracker, std::size_t kind, const RunContext&) {
        by_tracker[kind].resize(triangles_.size());
        for (std::size_t i = 0; i < tracker.size(); ++i) {
            FaceDeviation deviation{tracker.squared_distance(i),
                                    kind == reference_vertex_tracker ? 0 : tracker.squared_distance(i), 0};
            if constexpr (std::is_same_v<std::remove_cvref_t<decltype(tracker)>, MeshToReferenceTracker>)
                deviation.normal_deviation = normal_deviation_offset + tracker.normal_deviation(i);
            by_tracker[kind][tracker.sample(i).face].add(deviation);
        }
    });
    for (std::size_t kind = 1; kind < by_tracker.size(); ++kind)
        for (std::size_t f = 0; f < triangles_.size(); ++f) by_tracker[0][f].add(by_tracker[kind][f]);
    return std::move(by_tracker[0]);
}

inline std::span<const Correspondence> TwoSidedError::correspondences() {
    const std::size_t count = from_mesh_.size() + from_mesh_corners_->size() + from_reference_.size();
    if (count > correspondences_.capacity()) {
        std::vector<Correspondence>().swap(correspondences_);  // avoids copying the old ones
        correspondences_.reserve(count + count / 16);          // edge flips may increase the count slightly
    }
    correspondences_.resize(count);
    std::size_t first = 0;
    const auto add = [&](const auto& tracker) {
        parallel_each(tracker.size(), 4096, context_,
                      [&](std::size_t i) { correspondences_[first + i] = tracker.correspondence(i); });
        first += tracker.size();
    };
    add(from_mesh_), add(*from_mesh_corners_), add(from_reference_);
    return correspondences_;
}

inline std::vector<Correspondence> TwoSidedError::correspondences_at(
    std::span<const std::uint8_t> faces) const {
    std::vector<Correspondence> all;
    const auto add = [&](const auto& tracker) {
        for (std::size_t i = 0; i < tracker.size(); ++i)
            if (faces[tracker.sample(i).face]) all.push_back(tracker.correspondence(i));
    };
    add(from_mesh_), add(*from_mesh_corners_), add(from_reference_), add(from_reference_vertices_);
    return all;
}

inline void TwoSidedError::resample_flipped(std::span<const Vector3> positions,
                                            std::span<const std::uint8_t> flipped) {
    std::vector<Triangle> those(triangles_.begin(), triangles_.end());
    for (std::size_t f = 0; f < those.size(); ++f)
        if (!flipped[f]) those[f].fill(no_index);
    const MeshRef part{positions, those};
    const double share = area(part) / area({positions, triangles_});
    const auto count = std::llround(share * static_cast<double>(point_count()));
    from_mesh_.replace_samples(flipped, area_uniform_samples(part, static_cast<std::size_t>(count)));
    from_mesh_corners_.emplace(original_, triangles_, vertex_and_midpoint_samples(triangles_));
    from_reference_.update(positions, context_, flipped);
    from_reference_vertices_.update(positions, context_, flipped);
}

FAQEM_DETAIL_END

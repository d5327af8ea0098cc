#pragma once

#include "faqem/detail/fitting/two_sided_error.hpp"
#include "faqem/export.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <type_traits>
#include <utility>

#include "faqem/detail/base/parallel.hpp"

FAQEM_NAMESPACE_BEGIN
namespace detail {

using engine::Vector3;

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

/// Number of triangles without no_index corners.
inline std::size_t face_count(std::span<const Triangle> triangles) {
    return static_cast<std::size_t>(std::count_if(triangles.begin(), triangles.end(),
                                                  [](const Triangle& t) { return t[0] != no_index; }));
}

/// Updates a tracker. Residuals longer than a fraction of the longest are searched globally; 1: none.
template <class Tracker>
void move(Tracker& tracker, std::span<const Vector3> positions, double searched_share,
          const RunContext& context) {
    tracker.update(positions, context);
    if (searched_share < 1) tracker.search_farthest(searched_share, context);
}

FAQEM_INLINE double area(const MeshRef& mesh) {
    double twice = 0;
    for (const Triangle& t : mesh.triangles) {
        if (t[0] != no_index) twice += area_vector(mesh.positions, t).norm();
    }
    return twice / 2;
}

FAQEM_INLINE TwoSidedError::TwoSidedError(const ReferenceSurface& original,
                                          std::span<const Triangle> triangles,
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

FAQEM_INLINE std::size_t TwoSidedError::point_count() const {
    return std::clamp(samples_per_face * faces_, min_samples, max_samples);
}

FAQEM_INLINE std::vector<OrientedPoint> TwoSidedError::even_points() const {
    context_.check_now();
    const MeshRef& mesh = original_.mesh;
    std::vector<OrientedPoint> points;
    for (const SurfaceSample& sample : area_uniform_samples(mesh, reference_sample_factor * point_count())) {
        points.push_back({sample.position(mesh.positions, mesh.triangles), original_.normals[sample.face]});
    }
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

FAQEM_INLINE void TwoSidedError::update_correspondences(std::span<const Vector3> positions) {
    for_each_tracker([&](auto& tracker, std::size_t kind) {
        if (kind != reference_vertex_tracker) move(tracker, positions, is_coarse_ ? 0 : 1, context_);
    });
}

FAQEM_INLINE std::vector<FaceDeviation> TwoSidedError::measure(std::span<const Vector3> positions) {
    for_each_tracker([&](auto& tracker, std::size_t) {
        move(tracker, positions, is_coarse_ ? 0 : sample_far_share, context_);
    });
    return deviations();
}

FAQEM_INLINE std::vector<FaceDeviation> TwoSidedError::remeasure(std::span<const Vector3> positions) {
    for_each_tracker_in_parallel([&](auto& tracker, std::size_t, const RunContext& context) {
        move(tracker, positions, sample_far_share, context.on_one_thread());
    });
    return deviations();
}

FAQEM_INLINE std::vector<FaceDeviation> TwoSidedError::deviations() {
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
    for (std::size_t kind = 1; kind < by_tracker.size(); ++kind) {
        for (std::size_t f = 0; f < triangles_.size(); ++f) by_tracker[0][f].add(by_tracker[kind][f]);
    }
    return std::move(by_tracker[0]);
}

FAQEM_INLINE std::span<const Correspondence> TwoSidedError::correspondences() {
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

FAQEM_INLINE std::vector<Correspondence> TwoSidedError::correspondences_at(
    std::span<const std::uint8_t> faces) const {
    std::vector<Correspondence> all;
    const auto add = [&](const auto& tracker) {
        for (std::size_t i = 0; i < tracker.size(); ++i) {
            if (faces[tracker.sample(i).face]) all.push_back(tracker.correspondence(i));
        }
    };
    add(from_mesh_), add(*from_mesh_corners_), add(from_reference_), add(from_reference_vertices_);
    return all;
}

FAQEM_INLINE void TwoSidedError::resample_flipped(std::span<const Vector3> positions,
                                                  std::span<const std::uint8_t> flipped) {
    std::vector<Triangle> those(triangles_.begin(), triangles_.end());
    for (std::size_t f = 0; f < those.size(); ++f) {
        if (!flipped[f]) those[f].fill(no_index);
    }
    const MeshRef part{positions, those};
    const double share = area(part) / area({positions, triangles_});
    const auto count = std::llround(share * static_cast<double>(point_count()));
    from_mesh_.replace_samples(flipped, area_uniform_samples(part, static_cast<std::size_t>(count)));
    from_mesh_corners_.emplace(original_, triangles_, vertex_and_midpoint_samples(triangles_));
    from_reference_.update(positions, context_, flipped);
    from_reference_vertices_.update(positions, context_, flipped);
}

}  // namespace detail
FAQEM_NAMESPACE_END

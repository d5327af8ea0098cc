#pragma once

#include "faqem/export.hpp"
#include "faqem/detail/fitting/two_sided_error.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <type_traits>
#include <utility>

#include "faqem/detail/base/parallel.hpp"

FAQEM_NAMESPACE_BEGIN
namespace detail {

using engine::Vector3;

inline constexpr std::size_t points_per_face = 10, least_points = 5000, most_points = 2'000'000;
/// The original has more that could be missed: so many times as many points there.
inline constexpr std::size_t more_back = 2;
/// Distances beyond this share of the longest are searched for, the others are followed.
inline constexpr double sample_far_share = 0.9;
/// Where the original has so many times as many faces or more, what is followed gets lost more often. All are
/// searched for there, as long as the points are the fewest there are: that costs little.
inline constexpr std::size_t coarse = 33;
/// Added to each point's distance between the normals: a fraction of a degree does not matter.
inline constexpr double least_turn_counted = 0.005;
/// Original faces whose distances differ by less are tied.
inline constexpr double tie_tolerance = 1e-9;

/// The original's vertices: the last of the kinds of gaps.
inline constexpr std::size_t corner_kind = 3;

inline std::size_t face_count(std::span<const Triangle> triangles) {
    return static_cast<std::size_t>(std::count_if(triangles.begin(), triangles.end(),
                                                  [](const Triangle& t) { return t[0] != no_index; }));
}

/// Those beyond a share of the longest are searched for.
template <class Gaps>
void move(Gaps& gaps, std::span<const Vector3> positions, double searched_share, Workers workers) {
    gaps.move_to(positions, workers);
    if (searched_share < 1) gaps.search_farthest(searched_share, workers);
}

FAQEM_INLINE double area(const Patchwork& mesh) {
    double twice = 0;
    for (const Triangle& t : mesh.triangles) {
        if (t[0] != no_index) twice += area_vector(mesh.positions, t).norm();
    }
    return twice / 2;
}

FAQEM_INLINE TwoSidedGaps::TwoSidedGaps(const StillSurface& original, std::span<const Triangle> triangles,
                           std::span<const Vector3> positions, Workers workers)
    : original_(original),
      triangles_(triangles),
      workers_(workers),
      faces_(face_count(triangles)),
      is_coarse_(point_count() == least_points && coarse * faces_ <= face_count(original.mesh.triangles)),
      there_(original, triangles, evenly_spread({positions, triangles}, point_count(), workers.poll)),
      ends_(std::in_place, original, triangles, corners_and_middles(triangles, workers.poll)),
      back_(even_points(), triangles),
      corners_(oriented_vertices(original.mesh, workers.poll), triangles) {}

FAQEM_INLINE std::size_t TwoSidedGaps::point_count() const {
    return std::clamp(points_per_face * faces_, least_points, most_points);
}

FAQEM_INLINE std::vector<OrientedPoint> TwoSidedGaps::even_points() const {
    const Patchwork& mesh = original_.mesh;
    std::vector<OrientedPoint> points;
    for (const Spot& spot : evenly_spread(mesh, more_back * point_count(), workers_.poll)) {
        workers_.poll();
        points.push_back({spot.on(mesh.positions, mesh.triangles), original_.normals[spot.face]});
    }
    return points;
}

// The one with most points first: two threads have about as much to do.
template <class Visit>
void TwoSidedGaps::for_each_kind(Visit&& visit) {
    visit(back_, 0), visit(there_, 1), visit(*ends_, 2), visit(corners_, 3);
}

// Calls visit(gaps, poll) for the four, side by side.
template <class Visit>
void TwoSidedGaps::side_by_side(Visit&& visit) {
    parallel_blocks(4, 1, workers_, [&](std::size_t wanted, std::size_t, Poll poll) {
        for_each_kind([&](auto& gaps, std::size_t kind) {
            if (kind == wanted) visit(gaps, kind, poll);
        });
    });
}

FAQEM_INLINE void TwoSidedGaps::measure_pulls(std::span<const Vector3> positions) {
    for_each_kind([&](auto& gaps, std::size_t kind) {
        if (kind != corner_kind) move(gaps, positions, is_coarse_ ? 0 : 1, workers_);
    });
}

FAQEM_INLINE std::vector<Fit> TwoSidedGaps::measure(std::span<const Vector3> positions) {
    for_each_kind(
        [&](auto& gaps, std::size_t) { move(gaps, positions, is_coarse_ ? 0 : sample_far_share, workers_); });
    return fits();
}

FAQEM_INLINE std::vector<Fit> TwoSidedGaps::measure_again(std::span<const Vector3> positions) {
    side_by_side([&](auto& gaps, std::size_t, Poll poll) { move(gaps, positions, sample_far_share, {1, poll}); });
    return fits();
}

FAQEM_INLINE std::vector<Fit> TwoSidedGaps::fits() {
    for (GapsThere* there : {&there_, &*ends_}) there->measure_turns(tie_tolerance, workers_);
    std::array<std::vector<Fit>, 4> of_kind;
    side_by_side([&](const auto& gaps, std::size_t kind, Poll poll) {
        of_kind[kind].resize(triangles_.size());
        for (std::size_t i = 0; i < gaps.size(); ++i) {
            poll();
            Fit fit{gaps.squared(i), kind == corner_kind ? 0 : gaps.squared(i), 0};
            if constexpr (std::is_same_v<std::remove_cvref_t<decltype(gaps)>, GapsThere>)
                fit.turn = least_turn_counted + gaps.turn(i);
            of_kind[kind][gaps.spot(i).face].add(fit);
        }
    });
    for (std::size_t kind = 1; kind < of_kind.size(); ++kind) {
        for (std::size_t f = 0; f < triangles_.size(); ++f) of_kind[0][f].add(of_kind[kind][f]);
    }
    return std::move(of_kind[0]);
}

FAQEM_INLINE std::span<const Pull> TwoSidedGaps::pulls() {
    const std::size_t count = there_.size() + ends_->size() + back_.size();
    if (count > pulls_.capacity()) {
        std::vector<Pull>().swap(pulls_);    // they need not be copied,
        pulls_.reserve(count + count / 16);  // and other edges have some more
    }
    pulls_.resize(count);
    std::size_t first = 0;
    const auto add = [&](const auto& gaps) {
        parallel_blocks(gaps.size(), 4096, workers_, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) pulls_[first + i] = gaps.pull(i);
        });
        first += gaps.size();
    };
    add(there_), add(*ends_), add(back_);
    return pulls_;
}

FAQEM_INLINE std::vector<Pull> TwoSidedGaps::pulls_at(std::span<const std::uint8_t> faces) const {
    std::vector<Pull> all;
    const auto add = [&](const auto& gaps) {
        for (std::size_t i = 0; i < gaps.size(); ++i) {
            workers_.poll();
            if (faces[gaps.spot(i).face]) all.push_back(gaps.pull(i));
        }
    };
    add(there_), add(*ends_), add(back_), add(corners_);
    return all;
}

FAQEM_INLINE void TwoSidedGaps::swap(std::span<const Vector3> positions, std::span<const std::uint8_t> swapped) {
    std::vector<Triangle> those(triangles_.begin(), triangles_.end());
    for (std::size_t f = 0; f < those.size(); ++f) {
        if (!swapped[f]) those[f].fill(no_index);
    }
    const Patchwork part{positions, those};
    const double share = area(part) / area({positions, triangles_});
    const auto count = std::llround(share * static_cast<double>(point_count()));
    there_.replace(swapped, evenly_spread(part, static_cast<std::size_t>(count), workers_.poll));
    ends_.emplace(original_, triangles_, corners_and_middles(triangles_, workers_.poll));
    back_.move_to(positions, workers_, swapped);
    corners_.move_to(positions, workers_, swapped);
}

}  // namespace detail
FAQEM_NAMESPACE_END

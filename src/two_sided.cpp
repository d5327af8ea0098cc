#include "two_sided.hpp"

#include <algorithm>
#include <cmath>

#include "parallel.hpp"

namespace faqem::detail {

namespace {

using engine::Vector3;

constexpr std::size_t points_per_face = 10, least_points = 5000, most_points = 2'000'000;
/// The original has more that could be missed: so many times as many points there.
constexpr std::size_t more_back = 2;
/// Distances beyond this share of the longest are searched for, the others are followed.
constexpr double far_share = 0.9;
/// Where the original has so many times as many faces or more, what is followed gets lost more often. All are
/// searched for there, as long as the points are the fewest there are: that costs little.
constexpr std::size_t coarse = 33;
/// Added to each point's distance between the normals: a fraction of a degree does not matter.
constexpr double least_turn_counted = 0.005;
/// Original faces whose distances differ by less are tied.
constexpr double tie_tolerance = 1e-9;

std::size_t face_count(std::span<const Triangle> triangles) {
    return static_cast<std::size_t>(std::count_if(triangles.begin(), triangles.end(),
                                                  [](const Triangle& t) { return t[0] != no_index; }));
}

}  // namespace

double area(const Patchwork& mesh) {
    double twice = 0;
    for (const Triangle& t : mesh.triangles) {
        if (t[0] != no_index) twice += area_vector(mesh.positions, t).norm();
    }
    return twice / 2;
}

TwoSidedGaps::TwoSidedGaps(const StillSurface& original, std::span<const Triangle> triangles,
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

std::size_t TwoSidedGaps::point_count() const {
    return std::clamp(points_per_face * faces_, least_points, most_points);
}

std::vector<OrientedPoint> TwoSidedGaps::even_points() const {
    const Patchwork& mesh = original_.mesh;
    std::vector<OrientedPoint> points;
    for (const Spot& spot : evenly_spread(mesh, more_back * point_count(), workers_.poll)) {
        workers_.poll();
        points.push_back({spot.on(mesh.positions, mesh.triangles), original_.normals[spot.face]});
    }
    return points;
}

// Those beyond a share of the longest are searched for.
void TwoSidedGaps::move_to(std::span<const Vector3> positions, double searched_share) {
    const auto move = [&](auto& gaps) {
        gaps.move_to(positions, workers_);
        if (searched_share < 1) gaps.search_farthest(searched_share, workers_);
    };
    move(there_), move(*ends_), move(back_);
}

void TwoSidedGaps::measure_pulls(std::span<const Vector3> positions) {
    move_to(positions, is_coarse_ ? 0 : 1);
}

std::vector<Fit> TwoSidedGaps::measure(std::span<const Vector3> positions) {
    return measure(positions, is_coarse_ ? 0 : far_share);
}

std::vector<Fit> TwoSidedGaps::measure_again(std::span<const Vector3> positions) {
    return measure(positions, far_share);
}

std::vector<Fit> TwoSidedGaps::measure(std::span<const Vector3> positions, double searched_share) {
    move_to(positions, searched_share);
    corners_.move_to(positions, workers_);
    corners_.search_farthest(searched_share, workers_);
    std::vector<Fit> fits(triangles_.size());
    for (GapsThere* there : {&there_, &*ends_}) {
        there->measure_turns(tie_tolerance, workers_);
        for (std::size_t i = 0; i < there->size(); ++i) {
            workers_.poll();
            const double distance = there->gap(i).squaredNorm();
            fits[there->spot(i).face].add({distance, distance, least_turn_counted + there->turn(i)});
        }
    }
    for (std::size_t i = 0; i < back_.size(); ++i) {
        workers_.poll();
        const double distance = back_.gap(i).squaredNorm();
        fits[back_.spot(i).face].add({distance, distance, 0});
    }
    for (std::size_t i = 0; i < corners_.size(); ++i) {
        workers_.poll();
        fits[corners_.spot(i).face].add({corners_.gap(i).squaredNorm(), 0, 0});
    }
    return fits;
}

std::span<const Pull> TwoSidedGaps::pulls() {
    pulls_.resize(there_.size() + ends_->size() + back_.size());
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

std::vector<Pull> TwoSidedGaps::pulls_at(std::span<const std::uint8_t> faces) const {
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

void TwoSidedGaps::swap(std::span<const Vector3> positions, std::span<const std::uint8_t> swapped) {
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

}  // namespace faqem::detail

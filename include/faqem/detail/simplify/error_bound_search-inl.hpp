#pragma once

#include "faqem/detail/simplify/error_bound_search.hpp"

#include <iterator>
#include <limits>
#include <string>

#include "faqem/compare.hpp"
#include "faqem/detail/measure/hausdorff.hpp"
#include "faqem/detail/simplify/preprocess.hpp"
#include "faqem/detail/simplify/presets.hpp"

FAQEM_DETAIL_BEGIN

/// A place that takes more work than this for FarFaceSearch counts as too far: it is cheaper to undo a collapse.
inline constexpr std::uint64_t max_pieces_of_far = 100000;

FAQEM_INLINE DistanceReference::DistanceReference(const MeshView& mesh, const Options& options,
                                                  const RunContext& context)
    : surface_(extract_surface({mesh.positions, unpruned_triangles(mesh, options, context)})),
      tree_(surface_.positions, surface_.triangles, context) {}

FAQEM_INLINE MeasuredDistance DistanceReference::distance(const MeshView& result, double allowed,
                                                          MeasureMode mode, const RunContext& context) const {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    if (surface_.triangles.empty()) return {};
    const Surface simplified = extract_surface(result);
    if (simplified.triangles.empty()) return {infinity, infinity};
    const Bvh tree(simplified.positions, simplified.triangles, context);
    SearchLimits limits{.absolute_tolerance = min_relative_gap * surface_.diagonal(),
                        .max_pieces = HausdorffOptions{}.max_pieces};
    MeasuredDistance found{0, infinity};
    const auto search = [&] {
        const HausdorffBounds most = two_sided_hausdorff(surface_, tree_, simplified, tree, limits, context);
        found.value = std::max(found.value, most.value);
        found.bound = std::min(found.bound, most.bound);
    };
    const auto undecided = [&] { return found.value <= allowed && !found.within(allowed); };
    if (mode == MeasureMode::full) search();
    if (undecided()) {
        limits.tolerance = 0;
        limits.stop_above = limits.stop_below = allowed;
        search();
    }
    found.undecided_count = undecided() && found.bound - found.value > limits.absolute_tolerance;
    return found;
}

/// Some faces of a surface, with their positions.
inline Surface part_of(const Surface& surface, std::vector<Index> faces) {
    Surface part;
    std::vector<Index> number(surface.positions.size(), no_index);
    for (const Index f : faces) {
        Triangle t = surface.triangles[f];
        for (Index& v : t) {
            if (number[v] == no_index) {
                number[v] = static_cast<Index>(part.positions.size());
                part.positions.push_back(surface.positions[v]);
            }
            v = number[v];
        }
        part.triangles.push_back(t);
    }
    part.faces = std::move(faces);
    return part;
}

/// The faces of the original that are too far from the last result, or may be near a face that only that result has.
FAQEM_INLINE std::vector<Index> FarFaceSearch::faces_to_search(const std::vector<Corners>& now) const {
    std::vector<Index> found = far_originals_;
    std::vector<Corners> gone;
    std::set_difference(faces_.begin(), faces_.end(), now.begin(), now.end(), std::back_inserter(gone));
    for (const Corners& corners : gone) {
        const Vector3 a = to_eigen(corners[0]), b = to_eigen(corners[1]), c = to_eigen(corners[2]),
                      middle = (a + b + c) / 3;
        const double radius = std::max({(a - middle).norm(), (b - middle).norm(), (c - middle).norm()});
        const double reach = (radius + allowed_) * (1 + 1e-6);
        original_->tree().visit_within(to_array(middle), reach * reach,
                                       [&](Index f, const ClosestPoint&) { found.push_back(f); });
    }
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
}

FAQEM_INLINE std::vector<FarFaces> FarFaceSearch::operator()(const MeshView& result,
                                                             const RunContext& context) {
    const Surface& original = original_->surface();
    const Surface simplified = extract_surface(result);
    std::vector<FarFaces> far;
    if (original.triangles.empty()) return far;
    if (simplified.triangles.empty()) {
        for (Index f = 0; f < result.triangles.size(); ++f) far.push_back({f, original.faces.front()});
        return far;
    }
    std::vector<Corners> now;
    std::vector<Index> changed;
    for (Index f = 0; f < simplified.triangles.size(); ++f) {
        const Triangle& t = simplified.triangles[f];
        now.push_back({simplified.positions[t[0]], simplified.positions[t[1]], simplified.positions[t[2]]});
        if (!std::binary_search(near_.begin(), near_.end(), now.back())) changed.push_back(f);
    }
    near_ = now;
    std::sort(now.begin(), now.end());
    std::vector<Index> unknown = std::exchange(is_first_, false)
                                     ? engine::all_indices(original.triangles.size())
                                     : faces_to_search(now);

    const Bvh tree(simplified.positions, simplified.triangles, context);
    std::vector<std::array<Index, 2>> beyond;
    const SearchLimits limits{
        .tolerance = 0, .stop_below = allowed_, .max_pieces = max_pieces_of_far, .beyond = &beyond};
    const auto search = [&](const Surface& from, const Surface& to, const Bvh& tree_of_to) {
        beyond.clear();
        const auto nearest = nearest_faces_of_vertices(from, to, tree_of_to, context);
        one_sided_hausdorff(from, to, tree_of_to, nearest, 0, limits, context);
    };
    far_originals_.clear();
    const Surface from_original = part_of(original, std::move(unknown));
    search(from_original, simplified, tree);
    std::vector<std::uint8_t> is_far(simplified.triangles.size(), 0);
    const auto add = [&](Index face, Index nearest_original) {
        is_far[face] = 1;
        far.push_back({simplified.faces[face], original.faces[nearest_original]});
    };
    for (const auto& [f, nearest] : beyond) {
        far_originals_.push_back(from_original.faces[f]);
        add(nearest, from_original.faces[f]);
    }
    const Surface from_result = part_of(simplified, std::move(changed));
    search(from_result, original, original_->tree());
    for (const auto& [f, nearest] : beyond) add(from_result.faces[f], nearest);
    std::sort(far.begin(), far.end());
    far.erase(std::unique(far.begin(), far.end()), far.end());
    std::size_t kept = 0;
    for (Index f = 0; f < is_far.size(); ++f)
        if (!is_far[f]) near_[kept++] = near_[f];
    near_.resize(kept);
    std::sort(near_.begin(), near_.end());
    faces_ = std::move(now);
    return far;
}

FAQEM_INLINE bool refuses_collapses(const Options& options) {
    return settings(options).quadric_policy != Settings::QuadricPolicy::memory;
}

FAQEM_INLINE MeasuredDistance distance(const DistanceReference& original, const SimplifyResult& result,
                                       double allowed, MeasureMode mode, const Options& options,
                                       const RunContext& context) {
    const Report& report = result.report;
    const Settings exact = settings(options);
    const bool exact_weld = exact.weld == Weld::none || exact.weld_distance == 0;
    if (exact_weld && report.collapses == 0 && report.components_deleted == 0 &&
        report.vertices_fitted == 0 && report.edges_flipped == 0)
        return {};
    return original.distance(result.mesh.view(), allowed, mode, context);
}

FAQEM_INLINE double unpruned_diagonal(const MeshView& mesh, const Options& options,
                                      const DistanceReference& original) {
    return options.topology.prune ? extract_surface(mesh).diagonal() : original.surface().diagonal();
}

FAQEM_INLINE RunWithin<SimplifyResult> mesh_within(const MeshView& mesh, const DistanceReference& original,
                                                   const Options& options) {
    if (!refuses_collapses(options)) return {};
    return [&](double allowed, const Options& own, const RunContext& context) {
        FarFaceSearch search(original, allowed);
        const auto far = [&](const TriangleMesh& result) { return search(result.view(), context.untimed()); };
        return run_within(mesh, allowed, far, own, context);
    };
}

FAQEM_INLINE SimplifyResult
simplify_within_error(const MeshView& mesh, const Options& options, const RunContext& context,
                      const std::function<SimplifyResult(const Options&, const RunContext&)>& run) try {
    context.show(Phase::simplify, 0);
    const DistanceReference original(mesh, options, context.untimed());
    const MaxError& error = *options.max_error;
    const double unit = error.unit == MaxError::Unit::model ? 1 : unpruned_diagonal(mesh, options, original);
    const double allowed = error.value * unit;
    return search_within_error<SimplifyResult>(
        options, context, mesh.triangles.size(), allowed, run,
        [&](const SimplifyResult& result, MeasureMode mode, const RunContext& of_measurement) {
            return distance(original, result, allowed, mode, options, of_measurement);
        },
        mesh_within(mesh, original, options));
} catch (const engine::Cancelled&) {
    return cancelled_result<SimplifyResult>();
}

FAQEM_INLINE void report_search(Report& report, std::uint64_t undecided_count) {
    report.target_faces = report.faces_out;  // the search has no face count as its target
    if (!report.max_error->within()) {
        report.warnings.push_back(
            "no mesh within max_error was found: welding alone moves the surface farther");
    } else {
        report.stop = StopReason::reached_max_error;
        if (report.collapses == 0 && report.components_deleted == 0)
            report.warnings.push_back(
                "no smaller mesh within max_error was found: the result is the welded input");
    }
    if (undecided_count > 0) {
        report.warnings.push_back(std::to_string(undecided_count) +
                                  " meshes of the search were rejected, because the limit on the work was "
                                  "reached before their distance was decided");
    }
}

FAQEM_DETAIL_END

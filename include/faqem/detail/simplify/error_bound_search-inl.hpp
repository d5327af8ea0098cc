#pragma once

#include "faqem/export.hpp"
#include "faqem/detail/simplify/error_bound_search.hpp"

#include <limits>
#include <string>

#include "faqem/compare.hpp"
#include "faqem/detail/measure/hausdorff.hpp"
#include "faqem/detail/simplify/preprocess.hpp"
#include "faqem/detail/simplify/presets.hpp"

FAQEM_NAMESPACE_BEGIN
namespace detail {

FAQEM_INLINE Original::Original(const MeshView& mesh, const Options& options, Poll poll)
    : surface_(surface_of({mesh.positions, triangles_left(mesh, options, poll)}, poll)),
      tree_(surface_.positions, surface_.triangles, poll) {}

FAQEM_INLINE Distance Original::distance(const MeshView& result, double allowed, Look look, Workers workers) const {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    if (surface_.triangles.empty()) return {};
    const Surface small = surface_of(result, workers.poll);
    if (small.triangles.empty()) return {infinity, infinity};
    const Bvh tree(small.positions, small.triangles, workers.poll);
    SearchLimits limits{.floor = gap_floor * surface_.diagonal(),
                        .max_pieces = HausdorffOptions{}.max_pieces,
                        .workers = workers};
    Distance found{0, infinity};
    const auto search = [&] {
        const Farthest most = farthest_both_ways(surface_, tree_, small, tree, limits);
        found.value = std::max(found.value, most.value);
        found.bound = std::min(found.bound, most.bound);
    };
    const auto undecided = [&] { return found.value <= allowed && !found.within(allowed); };
    if (look == Look::in_full) search();
    if (undecided()) {
        limits.tolerance = 0;
        limits.stop_above = limits.stop_below = allowed;
        search();
    }
    found.unsettled = undecided() && found.bound - found.value > limits.floor;
    return found;
}

FAQEM_INLINE Distance distance(const Original& original, const SimplifyResult& result, double allowed, Look look,
                  const Options& options, Poll poll) {
    const Report& report = result.report;
    const Settings exact = settings(options);
    const bool exact_weld = exact.weld == Weld::none || exact.weld_distance == 0;
    if (exact_weld && report.collapses == 0 && report.components_deleted == 0 &&
        report.vertices_relaxed == 0 && report.edges_swapped == 0) {
        return {};
    }
    return original.distance(result.mesh.view(), allowed, look, {options.threads, poll});
}

FAQEM_INLINE double diagonal_of_all(const MeshView& mesh, const Options& options, const Original& original, Poll poll) {
    return options.topology.prune ? surface_of(mesh, poll).diagonal() : original.surface().diagonal();
}

FAQEM_INLINE SimplifyResult simplify_within(const MeshView& mesh, const Options& options) try {
    const AskMeanwhile meanwhile(options, 0);
    const Original original(mesh, options, meanwhile.poll());
    const MaxError& error = *options.max_error;
    const double unit =
        error.unit == MaxError::Unit::model ? 1 : diagonal_of_all(mesh, options, original, meanwhile.poll());
    const double allowed = error.value * unit;
    return run_within<SimplifyResult>(
        options, mesh.triangles.size(), allowed, [&](const Options& own) { return simplify(mesh, own); },
        [&](const SimplifyResult& result, Look look, Poll poll) {
            return distance(original, result, allowed, look, options, poll);
        });
} catch (const engine::Cancelled&) {
    return cancelled<SimplifyResult>();
}

FAQEM_INLINE void finish_search(Report& report, std::uint64_t unsettled) {
    report.target_faces = report.faces_out;  // no count was asked for, so that none was missed
    if (!report.max_error->within()) {
        report.warnings.push_back(
            "no mesh within max_error was found: welding alone moves the surface by more");
    } else {
        report.stop = StopReason::reached_max_error;
        if (report.collapses == 0 && report.components_deleted == 0) {
            report.warnings.push_back(
                "no smaller mesh within max_error was found: this is the input, welded");
        }
    }
    if (unsettled > 0) {
        report.warnings.push_back(std::to_string(unsettled) +
                                  " meshes of the search counted as too far from the original: the work "
                                  "allowed for measuring them did not tell");
    }
}

}  // namespace detail
FAQEM_NAMESPACE_END

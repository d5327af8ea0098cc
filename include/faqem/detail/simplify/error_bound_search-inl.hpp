#pragma once

#include "faqem/detail/simplify/error_bound_search.hpp"
#include "faqem/export.hpp"

#include <limits>
#include <string>

#include "faqem/compare.hpp"
#include "faqem/detail/measure/hausdorff.hpp"
#include "faqem/detail/simplify/preprocess.hpp"
#include "faqem/detail/simplify/presets.hpp"

FAQEM_NAMESPACE_BEGIN
namespace detail {

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

FAQEM_INLINE MeasuredDistance distance(const DistanceReference& original, const SimplifyResult& result,
                                       double allowed, MeasureMode mode, const Options& options,
                                       const RunContext& context) {
    const Report& report = result.report;
    const Settings exact = settings(options);
    const bool exact_weld = exact.weld == Weld::none || exact.weld_distance == 0;
    if (exact_weld && report.collapses == 0 && report.components_deleted == 0 &&
        report.vertices_fitted == 0 && report.edges_flipped == 0) {
        return {};
    }
    return original.distance(result.mesh.view(), allowed, mode, context);
}

FAQEM_INLINE double unpruned_diagonal(const MeshView& mesh, const Options& options,
                                      const DistanceReference& original) {
    return options.topology.prune ? extract_surface(mesh).diagonal() : original.surface().diagonal();
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
        });
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
        if (report.collapses == 0 && report.components_deleted == 0) {
            report.warnings.push_back(
                "no smaller mesh within max_error was found: the result is the welded input");
        }
    }
    if (undecided_count > 0) {
        report.warnings.push_back(std::to_string(undecided_count) +
                                  " meshes of the search were rejected, because the limit on the work was "
                                  "reached before their distance was decided");
    }
}

}  // namespace detail
FAQEM_NAMESPACE_END

#pragma once
/// \file
/// Options::max_error: searches for the smallest mesh within a given distance of the original, by repeated
/// simplification and measurement.

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <type_traits>
#include <utility>

#include "faqem/detail/base/parallel.hpp"
#include "faqem/detail/base/stopwatch.hpp"
#include "faqem/detail/geometry/bvh.hpp"
#include "faqem/detail/geometry/surface.hpp"
#include "faqem/detail/simplify/face_count_search.hpp"
#include "faqem/detail/simplify/run.hpp"
#include "faqem/export.hpp"
#include "faqem/simplify.hpp"

FAQEM_DETAIL_BEGIN

/// A distance with bounds: value <= true distance <= bound, up to rounding. Model units.
struct MeasuredDistance {
    double value = 0, bound = 0;
    /// Number of measurements that reached the limit on their work before it was decided whether the distance
    /// is allowed.
    std::uint64_t undecided_count = 0;

    bool within(double allowed) const { return bound <= allowed; }
};

/// Accuracy of a measurement.
enum class MeasureMode {
    full,         ///< relative accuracy of 1%, and until it is decided whether the distance is allowed
    decide_only,  ///< only until it is decided whether the distance is allowed, which is far less work
};

/// The original surface, to measure several results against. Immutable; owns its data.
class FAQEM_EXPORT DistanceReference {
public:
    /// \param mesh     the original; read only during the call
    /// \param options  of the runs: faces removed by Topology::prune are left out
    /// \param context  checked between the steps; exceptions pass through
    /// \throws InputError  as simplify()
    /// Complexity: O(n log n)
    explicit DistanceReference(const MeshView& mesh, const Options& options = {},
                               const RunContext& context = {});

    /// The faces of the original that have area.
    const Surface& surface() const { return surface_; }

    /// The two-sided Hausdorff distance between a result and the original. It is 0 if the original has no
    /// area, and infinite if only the result has none.
    /// \param result   a simplified mesh; read only during the call
    /// \param allowed  the distance to decide about, model units
    /// \param mode     accuracy
    /// \param context  the result does not depend on the number of threads
    /// \throws whatever `context` throws
    MeasuredDistance distance(const MeshView& result, double allowed, MeasureMode mode,
                              const RunContext& context) const;

    /// Its tree.
    const Bvh& tree() const { return tree_; }

private:
    Surface surface_;
    Bvh tree_;
};

/// Finds the faces of a result that are too far from the original. For a series of results of which each is a small change
/// of the previous one: what was near before, and is still there, is not measured again.
class FAQEM_EXPORT FarFaceSearch {
public:
    /// \param original  must outlive this object
    /// \param allowed   model units
    FarFaceSearch(const DistanceReference& original, double allowed)
        : original_(&original), allowed_(allowed) {}

    /// The places of the next result that are farther from the original than allowed, and those of the original that are
    /// farther from the result; also those for which the allowed work cannot decide. If there are none, the distance is at
    /// most the allowed one.
    /// \param context  the result does not depend on the number of threads
    /// \return a face of the result for each, and the nearest face of the original, or the other way round; sorted
    /// \throws whatever `context` throws
    std::vector<FarFaces> operator()(const MeshView& result, const RunContext& context);

private:
    using Corners = std::array<Vec3, 3>;

    std::vector<Index> faces_to_search(const std::vector<Corners>& now) const;

    const DistanceReference* original_;
    double allowed_;
    bool is_first_ = true;
    std::vector<Corners> faces_, near_;  // of the last result, sorted; near_: those that are not too far
    std::vector<Index> far_originals_;   // faces of the original that are too far from it
};

/// The distance between a result of simplify() and the original. It is 0 without measurement if the mesh was
/// only welded exactly, since the surface is the same then.
/// \param original  made from the input of simplify()
/// \param result    of simplify()
/// \param allowed   the distance to decide about, model units
/// \param mode      accuracy
/// \param options   of the run; weld and prune are used
/// \param context   checked between the steps; exceptions pass through
FAQEM_EXPORT MeasuredDistance distance(const DistanceReference& original, const SimplifyResult& result,
                                       double allowed, MeasureMode mode, const Options& options,
                                       const RunContext& context = {});

/// Bounding-box diagonal of the whole mesh including the faces that are pruned, model units. Lengths in
/// Length::Unit::diagonal refer to it.
/// \param original  made from `mesh` and `options`
double unpruned_diagonal(const MeshView& mesh, const Options& options, const DistanceReference& original);

/// An empty result with StopReason::cancelled.
template <class Result>
Result cancelled_result() {
    Result nothing;
    nothing.report.stop = StopReason::cancelled;
    return nothing;
}

/// simplify() for meshes with Options::max_error.
/// \param run  simplifies `mesh` to the target of the options that it is given, without an error bound
/// \pre options are valid and have max_error
/// \throws as simplify()
SimplifyResult simplify_within_error(
    const MeshView& mesh, const Options& options, const RunContext& context,
    const std::function<SimplifyResult(const Options&, const RunContext&)>& run);

/// Finds a mesh within an error without a search for its face count; nothing if that is not possible. Empty: it never is.
/// Its arguments are the error in the units of the measurement, the options without target, and the context.
template <class Result>
using RunWithin = std::function<std::optional<Result>(double, const Options&, const RunContext&)>;

/// run_within() for a mesh; empty if collapses of the preset cannot be refused.
/// \param mesh      must outlive the function that is returned, as `original`
/// \param original  made from `mesh`
FAQEM_EXPORT RunWithin<SimplifyResult> mesh_within(const MeshView& mesh, const DistanceReference& original,
                                                   const Options& options);

/// Sets stop reason, target and warnings of the report of a search.
/// \param report           of the best result, with max_error
/// \param undecided_count  number of results that could not be decided within the limit on the work
FAQEM_EXPORT void report_search(Report& report, std::uint64_t undecided_count);

/// Whether collapses are refused beyond Options::max_error, before a search for the face count.
FAQEM_EXPORT bool refuses_collapses(const Options& options);

/// The steps of search_within_error(), which documents the parameters.
template <class Result, class Run, class Measure>
class ErrorBoundSearch {
public:
    ErrorBoundSearch(const Options& options, const RunContext& context, std::uint64_t faces, double allowed,
                     Run& run, Measure& measure, const RunWithin<Result>& within)
        : options_(options), context_(context), faces_(faces), run_(run), measure_(measure), within_(within) {
        error_.allowed = allowed;
        options_.max_error.reset();
    }

    Result simplify() {
        const Stopwatch watch;
        std::optional<Result> best;
        if (is_searching_ && within_) best = run_within_error();
        const bool is_within = best.has_value();
        if (is_searching_ && !is_within) best = search();
        if (best && is_cancelled(*best)) return std::move(*best);
        if (best) {
            if (!measure(*best, MeasureMode::full)) return std::move(*best);
        } else {
            best = attempt(is_searching_ ? faqem::faces(std::max<std::uint64_t>(faces_, 1)) : options_.target,
                           MeasureMode::full);
            if (is_cancelled(*best)) return std::move(*best);
        }
        if (is_searching_) {
            cancel_if_requested(*best, 1);
            if (is_cancelled(*best)) return std::move(*best);
        }
        error_.value = distance_.value;
        error_.bound = is_within ? std::min(distance_.bound, error_.allowed) : distance_.bound;
        best->report.max_error = error_;
        if (is_searching_)
            report_search(best->report, undecided_count_);
        else if (!error_.within())
            best->report.warnings.push_back(
                "the target is reached only farther than max_error from the original");
        if (is_late_) {
            best->report.stop = StopReason::reached_time_limit;
            best->report.warnings.push_back("max_seconds was over before the search was complete");
        }
        best->report.seconds.simplify = best->report.seconds.total = watch.seconds();
        return std::move(*best);
    }

private:
    static bool is_cancelled(const Result& result) { return result.report.stop == StopReason::cancelled; }

    std::optional<Result> run_within_error() {
        std::optional<Result> result = within_(error_.allowed, std::as_const(options_),
                                               context_.step(Phase::simplify, 0, refusing_share));
        ++error_.runs;
        if (result) is_late_ = result->report.stop == StopReason::reached_time_limit;
        return result;
    }

    // The smallest result within the error that was found in time; nothing if there is none, or the result that was
    // cancelled.
    std::optional<Result> search() {
        std::optional<Result> best;
        FaceCountSearch search(faces_, error_.allowed);
        while (const auto target = search.next()) {
            Result result = attempt(faqem::faces(*target), MeasureMode::decide_only);
            if (is_cancelled(result)) return result;
            is_late_ = result.report.stop == StopReason::reached_time_limit;
            if (is_late_) break;
            const std::uint64_t count = result.report.faces_out;
            const bool within = distance_.within(error_.allowed);
            search.add_result(count, distance_.value, within);
            if (within && count < (best ? best->report.faces_out : faces_)) best = std::move(result);
        }
        return best;
    }

    // One run and its measurement.
    Result attempt(const Target& target, MeasureMode mode) {
        options_.target = target;
        // A measurement takes about as long as a run. All of them are reported as a single phase.
        Result result =
            run_(std::as_const(options_), context_.step(Phase::simplify, progress_at(0), progress_at(0.5)));
        if (is_cancelled(result) || !measure(result, mode)) return result;
        undecided_count_ += distance_.undecided_count;
        cancel_if_requested(result, progress_at(1));
        ++error_.runs;
        return result;
    }

    // Returns false if the measurement was cancelled or, during the search, the time is over. The distance of the
    // final result is measured in any case.
    bool measure(Result& result, MeasureMode mode) {
        try {
            context_.show(Phase::simplify, progress_at(0.5));
            distance_ = mode == MeasureMode::full ? measure_(std::as_const(result), mode, context_.untimed())
                                                  : measure_(std::as_const(result), mode, context_);
            return true;
        } catch (const engine::Cancelled& stopped) {
            result.report.stop = stopped.reason;
            return false;
        }
    }

    void cancel_if_requested(Result& result, double progress) const {
        context_.show(Phase::simplify, progress);
        if (context_.ask() == Continue::cancel) result.report.stop = StopReason::cancelled;
    }

    double progress_at(double of_run) const {
        if (within_) return refusing_share;
        // If no result is within the error, there is one more run with all faces as the target.
        const double planned = is_searching_ ? static_cast<double>(FaceCountSearch::max_runs + 1) : 1;
        return (static_cast<double>(error_.runs) + of_run) / planned;
    }

    static constexpr double refusing_share = 0.9;  // of the progress

    Options options_;  // of the runs
    const RunContext& context_;
    std::uint64_t faces_;
    Run& run_;
    Measure& measure_;
    const RunWithin<Result>& within_;
    bool is_searching_ = options_.target.kind == Target::Kind::unset;
    MeasuredError error_;
    MeasuredDistance distance_;  // of the last result that was measured
    std::uint64_t undecided_count_ = 0;
    bool is_late_ = false;  // the search ended early
};

/// Simplifies and measures: once if the options have a target, otherwise with `within` or, without it or if it finds
/// nothing, with the targets of FaceCountSearch.
/// Used by every entry point, which passes its own simplification and measurement.
/// \param options  of the caller, with max_error
/// \param faces    number of faces of the input
/// \param allowed  the maximum error, in the units of `measure`
/// \param run      (Options, RunContext) -> Result; Result has a member `report`
/// \param measure  (Result, MeasureMode, RunContext) -> MeasuredDistance
/// \param within   its results are proved to be within the error
/// \return the result with the fewest faces within the error; if there is none, the input with only welding
///         applied. Report::max_error is set unless the search was cancelled.
/// \throws whatever `run` and `measure` throw, except engine::Cancelled from `measure`
/// Complexity: at most FaceCountSearch::max_runs + 1 runs and measurements
template <class Result, class Run, class Measure>
Result search_within_error(const Options& options, const RunContext& context, std::uint64_t faces,
                           double allowed, Run&& run, Measure&& measure,
                           const RunWithin<Result>& within = {}) {
    return ErrorBoundSearch<Result, std::remove_reference_t<Run>, std::remove_reference_t<Measure>>(
               options, context, faces, allowed, run, measure, within)
        .simplify();
}

FAQEM_DETAIL_END

#ifdef FAQEM_HEADER_ONLY
#include "faqem/detail/simplify/error_bound_search-inl.hpp"
#endif

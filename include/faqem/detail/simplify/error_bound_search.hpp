#pragma once
/// \file
/// Options::max_error: the smallest mesh found within a distance of the original, by runs and measurements.

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>

#include "faqem/detail/base/parallel.hpp"
#include "faqem/detail/base/stopwatch.hpp"
#include "faqem/detail/geometry/bvh.hpp"
#include "faqem/detail/geometry/surface.hpp"
#include "faqem/detail/simplify/face_count_search.hpp"
#include "faqem/export.hpp"
#include "faqem/simplify.hpp"

FAQEM_NAMESPACE_BEGIN
namespace detail {

/// value <= true distance <= bound, up to rounding.
struct MeasuredDistance {
    double value = 0, bound = 0;
    std::uint64_t undecided_count = 0;  ///< how often the work allowed did not tell whether it is within

    bool within(double allowed) const { return bound <= allowed; }
};

/// How closely to measure.
enum class MeasureMode {
    full,         ///< to 1%, and until it is known whether it is within
    decide_only,  ///< until that is known, which is far less work
};

/// An original to measure several results against.
class FAQEM_EXPORT DistanceReference {
public:
    /// \param mesh     read here only
    /// \param options  of the runs: what they prune is left out
    /// \throws InputError  as simplify(); and what the poll throws
    explicit DistanceReference(const MeshView& mesh, const Options& options = {},
                               CancellationCheck check_cancelled = {});

    /// Its faces with area.
    const Surface& surface() const { return surface_; }

    /// The two-sided distance of a result. Where the original has no area it is 0, where only the result has
    /// none it is infinite.
    /// \throws what the poll of the workers throws
    MeasuredDistance distance(const MeshView& result, double allowed, MeasureMode mode,
                              Workers workers) const;

private:
    Surface surface_;
    Bvh tree_;
};

/// The distance of a result of simplify(). A mesh that was only welded exactly is the same surface: 0.
FAQEM_EXPORT MeasuredDistance distance(const DistanceReference& original, const SimplifyResult& result,
                                       double allowed, MeasureMode mode, const Options& options,
                                       CancellationCheck check_cancelled = {});

/// What lengths can be shares of: the diagonal of the whole mesh, pruned or not.
double unpruned_diagonal(const MeshView& mesh, const Options& options, const DistanceReference& original,
                         CancellationCheck check_cancelled = {});

/// Asks the callback of the options while something is measured; nobody where there is none.
class MeasurementMonitor {
public:
    /// \param fraction  of Phase::simplify, to be told
    MeasurementMonitor(const Options& options, double fraction)
        : monitor_([&options, fraction] { return options.progress(Phase::simplify, fraction); }),
          check_cancelled_(options.progress ? CancellationCheck(monitor_) : CancellationCheck()) {}

    CancellationCheck cancellation_check() const { return check_cancelled_; }

private:
    engine::ProgressMonitor monitor_;
    CancellationCheck check_cancelled_;
};

/// What is left where there was no time for more.
template <class Result>
Result cancelled_result() {
    Result nothing;
    nothing.report.stop = StopReason::cancelled;
    return nothing;
}

/// simplify() on arrays with max_error. \pre options are valid
SimplifyResult simplify_within_error(const MeshView& mesh, const Options& options);

/// What a report says of a search in words.
FAQEM_EXPORT void report_search(Report& report, std::uint64_t undecided_count);

/// Runs and measures: once where a target is given, else as FaceCountSearch says. A door brings the runs.
/// \param options  of the caller, with max_error
/// \param faces    of the input
/// \param allowed  the error, in the units of `measure`
/// \param run      Options -> Result, which has a report
/// \param measure  (Result, MeasureMode, CancellationCheck) -> MeasuredDistance
template <class Result, class Run, class Measure>
Result search_within_error(const Options& options, std::uint64_t faces, double allowed, Run&& run,
                           Measure&& measure) {
    const Stopwatch watch;
    const bool searching = options.target.kind == Target::Kind::unset;
    MeasuredError error{.allowed = allowed};
    // If nothing is within, the input is run in the end.
    const double planned = searching ? static_cast<double>(FaceCountSearch::max_runs + 1) : 1;
    const auto done = [&](double of_run) { return (static_cast<double>(error.runs) + of_run) / planned; };
    Options own = options;
    own.max_error.reset();
    if (options.progress) {
        // Measuring takes about as long as the run. All of them together are one phase.
        own.progress = [&](Phase phase, double fraction) {
            return options.progress(Phase::simplify, done(phase == Phase::simplify ? fraction / 2 : 0));
        };
    }
    MeasuredDistance distance;
    std::uint64_t undecided_count = 0;
    // False: cancelled.
    const auto try_measure = [&](Result& result, MeasureMode mode) {
        try {
            const MeasurementMonitor monitor(options, done(0.5));
            distance = measure(std::as_const(result), mode, monitor.cancellation_check());
            return true;
        } catch (const engine::Cancelled&) {
            result.report.stop = StopReason::cancelled;
            return false;
        }
    };
    const auto attempt = [&](const Target& target, MeasureMode mode) {
        own.target = target;
        Result result = run(std::as_const(own));
        if (result.report.stop == StopReason::cancelled) return result;
        if (!try_measure(result, mode)) return result;
        undecided_count += distance.undecided_count;
        if (options.progress && options.progress(Phase::simplify, done(1)) == Continue::cancel) {
            result.report.stop = StopReason::cancelled;
        }
        ++error.runs;
        return result;
    };

    std::optional<Result> best;
    if (searching) {
        FaceCountSearch search(faces, allowed);
        while (const auto target = search.next()) {
            Result result = attempt(faqem::faces(*target), MeasureMode::decide_only);
            if (result.report.stop == StopReason::cancelled) return result;
            const std::uint64_t count = result.report.faces_out;
            const bool within = distance.within(allowed);
            search.add_result(count, distance.value, within);
            if (within && count < (best ? best->report.faces_out : faces)) best = std::move(result);
        }
    }
    if (best) {
        if (!try_measure(*best, MeasureMode::full)) return std::move(*best);
    } else {
        best = attempt(searching ? faqem::faces(std::max<std::uint64_t>(faces, 1)) : options.target,
                       MeasureMode::full);
        if (best->report.stop == StopReason::cancelled) return std::move(*best);
    }
    if (options.progress && searching && options.progress(Phase::simplify, 1) == Continue::cancel) {
        best->report.stop = StopReason::cancelled;
        return std::move(*best);
    }
    error.value = distance.value;
    error.bound = distance.bound;
    best->report.max_error = error;
    if (searching) report_search(best->report, undecided_count);
    best->report.seconds.simplify = best->report.seconds.total = watch.seconds();
    return std::move(*best);
}

}  // namespace detail
FAQEM_NAMESPACE_END

#ifdef FAQEM_HEADER_ONLY
#include "faqem/detail/simplify/error_bound_search-inl.hpp"
#endif

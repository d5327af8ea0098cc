#pragma once
/// \file
/// Chain of levels of detail: checks the targets, runs the simplification and measures the errors.

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <variant>
#include <vector>

#include "faqem/detail/simplify/error_bound_search.hpp"
#include "faqem/export.hpp"
#include "faqem/levels.hpp"

FAQEM_NAMESPACE_BEGIN
namespace detail {

/// Target of one level: a face count or a distance.
struct LevelTarget {
    std::optional<std::uint64_t> faces;                        ///< face count, or nullopt for a distance
    double allowed = std::numeric_limits<double>::infinity();  ///< allowed distance, model units
};

/// Checks the levels and converts ratios to face counts and all distances to model units.
/// \param levels    from fine to coarse
/// \param options   target and max_error must be unset
/// \param faces     number of faces of the original
/// \param diagonal  bounding box diagonal of the original, model units
/// \throws OptionError  see simplify_levels()
/// O(levels)
FAQEM_EXPORT std::vector<LevelTarget> level_targets(const std::vector<Level>& levels, const Options& options,
                                                    double faces, double diagonal);

/// The result of one run, and its target face count.
template <class Result>
struct Attempt : Result {
    std::uint64_t target = 0;
};

/// Runs the simplification for all levels and measures each level against the original. Distances are first
/// converted to face counts by a search each; then one run produces all levels.
/// \tparam Out           a type with the members of SimplifiedLevel
/// \param level_targets  as returned by level_targets()
/// \param options        options of the runs; progress covers all runs and measurements
/// \param faces          number of faces of the original
/// \param run            (targets, Options) -> results, as run_to_targets()
/// \param measure        (Result, allowed, MeasureMode, CancellationCheck) -> MeasuredDistance
/// \return one element per level; fewer if cancelled, the last one with StopReason::cancelled
/// \throws whatever `run`, `measure` or the progress callback throws, except Cancelled
template <class Out, class Run, class Measure>
std::vector<Out> run_lod_chain(std::span<const LevelTarget> level_targets, const Options& options,
                               std::uint64_t faces, Run&& run, Measure&& measure) {
    using Result = decltype(Out::result);
    const auto searches = std::count_if(level_targets.begin(), level_targets.end(),
                                        [](const LevelTarget& g) { return !g.faces; });
    double steps_done = 0;  // of searches + 1 steps; the last step is the run
    Options own = options;
    if (options.progress) {
        own.progress = [&](Phase phase, double fraction) {
            const double done = phase == Phase::simplify ? fraction : 0;
            return options.progress(Phase::simplify, (steps_done + done) / static_cast<double>(searches + 1));
        };
    }

    std::vector<Out> out(level_targets.size());
    std::vector<std::uint64_t> targets;
    for (std::size_t i = 0; i < level_targets.size(); ++i) {
        const std::uint64_t most = targets.empty() ? faces : targets.back();
        if (level_targets[i].faces) {
            targets.push_back(std::min(*level_targets[i].faces, most));
            continue;
        }
        Options search = own;
        search.max_error = model_units(level_targets[i].allowed);
        auto found = search_within_error<Attempt<Result>>(
            search, most, level_targets[i].allowed,
            [&](const Options& tried) {
                const std::uint64_t target = target_face_count(tried.target, static_cast<double>(most));
                targets.push_back(target);
                Attempt<Result> attempt{std::move(run(targets, tried).back()), target};
                targets.pop_back();
                return attempt;
            },
            [&](const Result& result, MeasureMode mode, CancellationCheck check_cancelled) {
                return measure(result, level_targets[i].allowed, mode, check_cancelled);
            });
        targets.push_back(found.target);
        out[i].result = std::move(found);
        if (out[i].result.report.stop == StopReason::cancelled) {
            out.erase(out.begin(), out.begin() + static_cast<std::ptrdiff_t>(i));
            out.resize(1);
            return out;
        }
        const MeasuredError& error = *out[i].result.report.max_error;
        out[i].distance = error.value;
        out[i].error = error.bound;
        ++steps_done;
    }

    std::vector<Result> results;
    if (static_cast<std::size_t>(searches) < level_targets.size()) {
        Options half = own;
        if (own.progress)
            half.progress = [&](Phase phase, double fraction) { return own.progress(phase, fraction / 2); };
        results = run(targets, half);
        out.resize(results.size());
    }
    const bool is_cancelled = !results.empty() && results.back().report.stop == StopReason::cancelled;
    double largest = 0;
    const auto done = [&](std::size_t levels) {
        return 0.5 + 0.5 * static_cast<double>(levels) / static_cast<double>(out.size());
    };
    // Measures level i. Returns false if cancelled.
    const auto try_measure = [&](std::size_t i) {
        try {
            const MeasurementMonitor monitor(own, done(i));
            const MeasuredDistance found = measure(out[i].result, level_targets[i].allowed, MeasureMode::full,
                                                   monitor.cancellation_check());
            out[i].distance = found.value;
            out[i].error = found.bound;
            return true;
        } catch (const engine::Cancelled&) {
            return false;
        }
    };
    for (std::size_t i = 0; i < out.size(); ++i) {
        if (level_targets[i].faces) out[i].result = std::move(results[i]);
        if (is_cancelled && i + 1 == out.size()) {
            out[i].result.report.stop = StopReason::cancelled;
            break;
        }
        const bool is_measured = !level_targets[i].faces || try_measure(i);
        largest = out[i].error = std::max(out[i].error, largest);
        if (!is_measured ||
            (own.progress && own.progress(Phase::simplify, done(i + 1)) == Continue::cancel)) {
            out[i].result.report.stop = StopReason::cancelled;
            out.resize(i + 1);
        }
    }
    return out;
}

}  // namespace detail
FAQEM_NAMESPACE_END

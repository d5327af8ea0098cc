#pragma once
/// \file
/// Chain of levels of detail: checks the targets, runs the simplification and measures the errors.

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "faqem/detail/simplify/error_bound_search.hpp"
#include "faqem/export.hpp"
#include "faqem/levels.hpp"

FAQEM_DETAIL_BEGIN

/// Target of one level: a face count or a distance.
struct LevelTarget {
    std::optional<std::uint64_t> faces;                        ///< face count, or nullopt for a distance
    double allowed = std::numeric_limits<double>::infinity();  ///< allowed distance, model units
};

/// Checks the levels and converts ratios to face counts and all distances to model units.
/// \param levels    from fine to coarse
/// \param options   target, max_error and max_seconds must be unset
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

/// What is left of the levels of a cancelled run: one of them, or an empty one.
template <class Out>
std::vector<Out> cancelled_levels(Out level = {}) {
    level.result.report.stop = StopReason::cancelled;
    std::vector<Out> only;
    only.push_back(std::move(level));
    return only;
}

/// The steps of run_lod_chain(), which documents the template parameters.
template <class Out, class Run, class Measure>
class LodChain {
public:
    LodChain(std::span<const LevelTarget> levels, const Options& options, const RunContext& context,
             std::uint64_t faces, Run& run, Measure& measure, const RunWithin<decltype(Out::result)>& within)
        : level_targets_(levels),
          options_(options),
          context_(context),
          faces_(faces),
          run_(run),
          measure_(measure),
          within_(within),
          steps_(1 + static_cast<double>(std::count_if(levels.begin(), levels.end(), is_distance))),
          out_(levels.size()) {}

    std::vector<Out> simplify() {
        for (std::size_t i = 0; i < level_targets_.size(); ++i) {
            const std::uint64_t most = targets_.empty() ? faces_ : targets_.back();
            if (level_targets_[i].faces)
                targets_.push_back(std::min(*level_targets_[i].faces, most));
            else if (!search(i, most))
                return cancelled_levels(std::move(out_[i]));
        }
        // Levels before the one that was cancelled are complete, but not measured, which can take many seconds.
        if (!simplify_to_face_counts()) return cancelled_levels(std::move(out_.back()));
        measure_levels();
        return std::move(out_);
    }

private:
    using Result = decltype(Out::result);

    static bool is_distance(const LevelTarget& target) { return !target.faces; }

    // Simplifies level i, whose target is a distance. Returns false if cancelled.
    bool search(std::size_t i, std::uint64_t most) {
        Options search = options_;
        search.max_error = model_units(level_targets_[i].allowed);
        RunWithin<Attempt<Result>> within;
        // One history has all levels of a run.
        if (within_ && options_.history == Recording::off) {
            within = [&](double allowed, const Options& own,
                         const RunContext& of_run) -> std::optional<Attempt<Result>> {
                std::optional<Result> result = within_(allowed, own, of_run);
                if (!result || result->report.faces_out > most) return std::nullopt;
                const std::uint64_t faces = result->report.faces_out;
                return Attempt<Result>{std::move(*result), faces};
            };
        }
        auto found = search_within_error<Attempt<Result>>(
            search, next_step(), most, level_targets_[i].allowed,
            [&](const Options& tried, const RunContext& of_run) {
                const std::uint64_t target = target_face_count(tried.target, static_cast<double>(most));
                targets_.push_back(target);
                Attempt<Result> attempt{std::move(run_(targets_, tried, of_run).back()), target};
                targets_.pop_back();
                return attempt;
            },
            [&](const Result& result, MeasureMode mode, const RunContext& of_measurement) {
                return measure_(result, level_targets_[i].allowed, mode, of_measurement);
            },
            within);
        targets_.push_back(found.target);
        out_[i].result = std::move(found);
        if (out_[i].result.report.stop == StopReason::cancelled) return false;
        const MeasuredError& error = *out_[i].result.report.max_error;
        out_[i].distance = error.value;
        out_[i].error = error.bound;
        ++steps_done_;
        return true;
    }

    // Produces the levels whose targets are face counts. Returns false if cancelled: the last one of out_.
    bool simplify_to_face_counts() {
        if (std::all_of(level_targets_.begin(), level_targets_.end(), is_distance)) return true;
        const RunContext last = next_step();
        std::vector<Result> results = run_(targets_, options_, last.step(Phase::simplify, 0, 0.5));
        const bool is_complete = results.empty() || results.back().report.stop != StopReason::cancelled;
        out_.resize(results.size());
        for (std::size_t i = 0; i < out_.size(); ++i)
            if (level_targets_[i].faces) out_[i].result = std::move(results[i]);
        return is_complete;
    }

    // Measures the levels whose targets are face counts, and makes the errors ascend.
    void measure_levels() {
        const RunContext last = next_step();
        double largest = 0;
        for (std::size_t i = 0; i < out_.size(); ++i) {
            last.show(Phase::simplify, progress_at(i));
            const bool is_measured = !level_targets_[i].faces || measure(i, last);
            largest = out_[i].error = std::max(out_[i].error, largest);
            last.show(Phase::simplify, progress_at(i + 1));
            if (!is_measured || last.ask() == Continue::cancel) {
                out_[i].result.report.stop = StopReason::cancelled;
                out_.resize(i + 1);
            }
        }
    }

    // Measures level i. Returns false if cancelled.
    bool measure(std::size_t i, const RunContext& context) {
        try {
            const MeasuredDistance found =
                measure_(out_[i].result, level_targets_[i].allowed, MeasureMode::full, context);
            out_[i].distance = found.value;
            out_[i].error = found.bound;
            return true;
        } catch (const engine::Cancelled&) {
            return false;
        }
    }

    RunContext next_step() const {
        return context_.step(Phase::simplify, steps_done_ / steps_, (steps_done_ + 1) / steps_);
    }

    // Progress of the last step once this number of levels is measured.
    double progress_at(std::size_t levels) const {
        return 0.5 + 0.5 * static_cast<double>(levels) / static_cast<double>(out_.size());
    }

    std::span<const LevelTarget> level_targets_;
    const Options& options_;
    const RunContext& context_;
    std::uint64_t faces_;
    Run& run_;
    Measure& measure_;
    const RunWithin<Result>& within_;
    double steps_;  // one per search, and one for the levels that need none
    double steps_done_ = 0;
    std::vector<std::uint64_t> targets_;  // face counts of the levels so far
    std::vector<Out> out_;
};

/// Runs the simplification for all levels and measures each level against the original. Levels of a distance come first,
/// each simplified from the original by `within` or, with Options::history, found by a search for its face count; then one
/// run produces the others.
/// \tparam Out           a type with the members of SimplifiedLevel
/// \param level_targets  as returned by level_targets()
/// \param options        options of the runs
/// \param context        its progress covers all runs and measurements
/// \param faces          number of faces of the original
/// \param run            (targets, Options, RunContext) -> results, as run_to_targets()
/// \param measure        (Result, allowed, MeasureMode, RunContext) -> MeasuredDistance
/// \param within         for levels of a distance; a result with more faces than the level before is not used
/// \return one element per level; fewer if cancelled, the last one with StopReason::cancelled
/// \throws whatever `run`, `measure` or the progress callback throws, except Cancelled from `measure`
template <class Out, class Run, class Measure>
std::vector<Out> run_lod_chain(std::span<const LevelTarget> level_targets, const Options& options,
                               const RunContext& context, std::uint64_t faces, Run&& run, Measure&& measure,
                               const RunWithin<decltype(Out::result)>& within = {}) {
    LodChain<Out, std::remove_reference_t<Run>, std::remove_reference_t<Measure>> chain(
        level_targets, options, context, faces, run, measure, within);
    return chain.simplify();
}

/// Leaves only the last level if it was cancelled, for callers whose next step takes long for each complete one.
template <class Out>
void keep_only_cancelled(std::vector<Out>& levels) {
    if (!levels.empty() && levels.back().result.report.stop == StopReason::cancelled)
        levels.erase(levels.begin(), levels.end() - 1);
}

FAQEM_DETAIL_END

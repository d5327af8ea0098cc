#pragma once

#include "faqem/export.hpp"
#include "faqem/levels.hpp"

#include <cmath>
#include <string>

#include "faqem/detail/lod/lod_chain.hpp"
#include "faqem/error.hpp"
#include "faqem/detail/simplify/run.hpp"

FAQEM_NAMESPACE_BEGIN

namespace detail {

[[noreturn]] inline void fail(std::size_t level, const char* what) {
    throw OptionError("level " + std::to_string(level) + ": " + what);
}

inline detail::Goal goal(const Level& level, std::size_t number, double faces, double diagonal) {
    if (const MaxError* error = std::get_if<MaxError>(&level)) {
        if (!(error->value > 0 && std::isfinite(error->value)))
            fail(number, "a distance must be finite and > 0");
        return {std::nullopt, error->unit == MaxError::Unit::model ? error->value : error->value * diagonal};
    }
    const Target& target = std::get<Target>(level);
    switch (target.kind) {
        case Target::Kind::unset:
            fail(number, "needs a ratio, a number of faces or a distance");
        case Target::Kind::ratio:
            if (!(target.value > 0 && target.value <= 1)) fail(number, "a ratio must be in (0, 1]");
            break;
        case Target::Kind::faces:
            if (!(target.value >= 1 && std::isfinite(target.value)))
                fail(number, "a number of faces must be finite and >= 1");
            break;
    }
    return {std::max(detail::smallest_target, detail::faces_wanted(target, faces))};
}

}  // namespace detail

FAQEM_INLINE std::vector<detail::Goal> detail::goals(const std::vector<Level>& levels, const Options& options,
                                        double faces, double diagonal) {
    if (options.target.kind != Target::Kind::unset || options.max_error)
        throw OptionError("target and max_error: of a chain the levels say them");
    std::vector<Goal> goals;
    Goal last{std::numeric_limits<std::uint64_t>::max(), 0};
    for (std::size_t i = 0; i < levels.size(); ++i) {
        const Goal& next = goals.emplace_back(detail::goal(levels[i], i, faces, diagonal));
        if (next.faces) {
            if (*next.faces > *last.faces) detail::fail(i, "more faces than a level before it");
            last.faces = next.faces;
        } else {
            if (next.allowed < last.allowed) detail::fail(i, "a smaller distance than a level before it");
            last.allowed = next.allowed;
        }
    }
    return goals;
}

FAQEM_INLINE std::vector<SimplifiedLevel> simplify_levels(const MeshView& mesh, const std::vector<Level>& levels,
                                             const Options& options) try {
    validate(options);
    const detail::AskMeanwhile meanwhile(options, 0);
    const detail::Original original(mesh, options, meanwhile.poll());
    const std::uint64_t faces = mesh.triangles.size();
    const std::vector<detail::Goal> goals =
        detail::goals(levels, options, static_cast<double>(faces),
                      detail::diagonal_of_all(mesh, options, original, meanwhile.poll()));
    if (goals.empty()) return {};
    return detail::run_chain<SimplifiedLevel>(
        goals, options, faces,
        [&](const std::vector<std::uint64_t>& targets, const Options& own) {
            return detail::run_to(mesh, targets, own);
        },
        [&](const SimplifyResult& result, double allowed, detail::Look look, detail::Poll poll) {
            return detail::distance(original, result, allowed, look, options, poll);
        });
} catch (const engine::Cancelled&) {
    std::vector<SimplifiedLevel> none(1);
    none.front().result.report.stop = StopReason::cancelled;
    return none;
}

FAQEM_NAMESPACE_END

#pragma once

#include "faqem/levels.hpp"

#include <cmath>
#include <string>

#include "faqem/detail/lod/lod_chain.hpp"
#include "faqem/detail/measure/removed_components.hpp"
#include "faqem/detail/simplify/run.hpp"
#include "faqem/error.hpp"

FAQEM_NAMESPACE_BEGIN

namespace detail {

/// \throws OptionError  always
[[noreturn]] inline void fail(std::size_t level, const std::string& what) {
    throw OptionError("level " + std::to_string(level) + ": " + what);
}

/// Checks one level and converts it to numbers.
/// \param number    index of the level, for error messages
/// \param faces     number of faces of the original
/// \param diagonal  bounding box diagonal of the original, model units
/// \throws OptionError  if the level is unset or its value is out of range
inline detail::LevelTarget level_target(const Level& level, std::size_t number, double faces,
                                        double diagonal) {
    if (const MaxError* error = std::get_if<MaxError>(&level)) {
        if (!(error->value > 0 && std::isfinite(error->value)))
            fail(number, "distance must be finite and > 0");
        return {std::nullopt, error->unit == MaxError::Unit::model ? error->value : error->value * diagonal};
    }
    const Target& target = std::get<Target>(level);
    switch (target.kind) {
        case Target::Kind::unset:
            fail(number, "must be a ratio, a face count or a distance");
        case Target::Kind::ratio:
            if (!(target.value > 0 && target.value <= 1)) fail(number, "ratio must be in (0, 1]");
            break;
        case Target::Kind::faces:
            if (!(target.value >= 1 && std::isfinite(target.value)))
                fail(number, "face count must be finite and >= 1");
            break;
    }
    return {std::max(detail::min_target_faces, detail::target_face_count(target, faces))};
}

}  // namespace detail

FAQEM_INLINE std::vector<detail::LevelTarget> detail::level_targets(const std::vector<Level>& levels,
                                                                    const Options& options, double faces,
                                                                    double diagonal) {
    if (options.target.kind != Target::Kind::unset || options.max_error)
        throw OptionError("target and max_error must be unset; set them per level");
    if (options.max_seconds) throw OptionError("max_seconds must be unset: levels have no time limit");
    std::vector<LevelTarget> level_targets;
    LevelTarget last{std::numeric_limits<std::uint64_t>::max(), 0};
    for (std::size_t i = 0; i < levels.size(); ++i) {
        const LevelTarget& next =
            level_targets.emplace_back(detail::level_target(levels[i], i, faces, diagonal));
        if (next.faces) {
            if (*next.faces > *last.faces)
                detail::fail(i, "face count " + std::to_string(*next.faces) +
                                    " must not be larger than that of a previous level, " +
                                    std::to_string(*last.faces));
            last.faces = next.faces;
        } else {
            if (next.allowed < last.allowed)
                detail::fail(i, "distance must not be smaller than that of a previous level");
            last.allowed = next.allowed;
        }
    }
    return level_targets;
}

FAQEM_INLINE std::vector<SimplifiedLevel> simplify_levels(const MeshView& mesh,
                                                          const std::vector<Level>& levels,
                                                          const Options& options) try {
    validate(options);
    const engine::RunContext context(options);
    context.show(Phase::simplify, 0);
    const detail::DistanceReference original(mesh, options, context);
    const std::uint64_t faces = mesh.triangles.size();
    const std::vector<detail::LevelTarget> level_targets = detail::level_targets(
        levels, options, static_cast<double>(faces), detail::unpruned_diagonal(mesh, options, original));
    if (level_targets.empty()) return {};
    std::vector<SimplifiedLevel> chain = detail::run_lod_chain<SimplifiedLevel>(
        level_targets, options, context, faces,
        [&](const std::vector<std::uint64_t>& targets, const Options& own, const engine::RunContext& of_run) {
            return detail::run_to_targets(mesh, targets, own, of_run);
        },
        [&](const SimplifyResult& result, double allowed, detail::MeasureMode mode,
            const engine::RunContext& of_measurement) {
            return detail::distance(original, result, allowed, mode, options, of_measurement);
        },
        detail::mesh_within(mesh, original, options));
    for (SimplifiedLevel& level : chain) detail::report_removed_components(mesh, level.result);
    return chain;
} catch (const engine::Cancelled&) {
    return detail::cancelled_levels<SimplifiedLevel>();
}

FAQEM_NAMESPACE_END

#include <utility>

#include "bake/scene/check_asset.hpp"
#include "bake/scene/simplify_parts.hpp"
#include "bake/scene/parts_error_bound_search.hpp"
#include "bake/scene/shared_texture.hpp"
#include "bake/scene/step_progress.hpp"
#include "faqem/detail/lod/lod_chain.hpp"
#include "faqem/bake_levels.hpp"

namespace faqem {

std::vector<SmallPartsLevel> simplify_parts_levels(const Asset& source, const std::vector<Level>& levels,
                                                   const Options& options) try {
    validate(options);
    const Options own = detail::step_of(options, Phase::simplify, 0, 1);
    detail::check_asset(source);
    const detail::AskMeanwhile meanwhile(own, 0);
    const detail::MeasuredParts measured(source, own, meanwhile.poll());
    const std::vector<detail::Goal> goals =
        detail::goals(levels, options, static_cast<double>(measured.faces()), measured.size().diagonal);
    if (goals.empty()) return {};
    return detail::run_chain<SmallPartsLevel>(
        goals, own, measured.faces(),
        [&](const std::vector<std::uint64_t>& targets, const Options& tried) {
            return detail::run_parts_to(source, targets, tried);
        },
        measured);
} catch (const engine::Cancelled&) {
    std::vector<SmallPartsLevel> none(1);
    none.front().result.parts.resize(source.parts.size());
    none.front().result.report.stop = StopReason::cancelled;
    return none;
}

namespace {

std::vector<LightLevel> with_shared_texture(const Asset& source, const std::vector<Level>& levels,
                                            const Options& options) try {
    validate(options);
    detail::check_shared_texture(options);
    detail::check_asset(source);
    const detail::AskMeanwhile meanwhile(options, 0);
    const detail::MeasuredParts measured(source, options, meanwhile.poll());
    const std::vector<detail::Goal> goals =
        detail::goals(levels, options, static_cast<double>(measured.faces()), measured.size().diagonal);
    if (goals.empty()) return {};
    return detail::levels_with_shared_texture(source, measured, goals, options);
} catch (const engine::Cancelled&) {
    std::vector<LightLevel> none(1);
    none.front().result.report.stop = StopReason::cancelled;
    return none;
}

}  // namespace

std::vector<LightLevel> simplify_levels(const Asset& source, const std::vector<Level>& levels,
                                        const Options& options, LevelTextures textures) {
    if (textures == LevelTextures::shared) return with_shared_texture(source, levels, options);
    std::vector<LightLevel> out;
    std::vector<SmallPartsLevel> made = simplify_parts_levels(source, levels, options);
    const auto count = static_cast<double>(made.size());
    for (SmallPartsLevel& level : made) {
        const SmallParts small = std::move(level.result);
        const auto before = static_cast<double>(out.size());
        const Options step = detail::step_of(options, Phase::bake, before / count, (before + 1) / count);
        out.push_back({bake(source, small, step), level.distance, level.error});
        if (out.back().result.report.stop == StopReason::cancelled) break;
    }
    return out;
}

}  // namespace faqem

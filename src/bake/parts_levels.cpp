#include <utility>

#include "bake/check_asset.hpp"
#include "bake/parts_run.hpp"
#include "bake/parts_within_error.hpp"
#include "bake/shared_texture.hpp"
#include "chain.hpp"
#include "faqem/bake_levels.hpp"

namespace faqem {

std::vector<SmallPartsLevel> simplify_parts_levels(const Asset& source, const std::vector<Level>& levels,
                                                   const Options& options) try {
    validate(options);
    detail::check_asset(source);
    const detail::AskMeanwhile meanwhile(options, 0);
    const detail::MeasuredParts measured(source, options, meanwhile.poll());
    const std::vector<detail::Goal> goals =
        detail::goals(levels, options, static_cast<double>(measured.faces()), measured.size().diagonal);
    if (goals.empty()) return {};
    return detail::run_chain<SmallPartsLevel>(
        goals, options, measured.faces(),
        [&](const std::vector<std::uint64_t>& targets, const Options& own) {
            return detail::run_parts_to(source, targets, own);
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
    for (SmallPartsLevel& level : simplify_parts_levels(source, levels, options)) {
        SmallParts small = std::move(level.result);
        out.push_back({bake(source, small, options), level.distance, level.error});
        if (out.back().result.report.stop == StopReason::cancelled) break;
    }
    return out;
}

}  // namespace faqem

#include <utility>

#include "bake/scene/shared_texture.hpp"
#include "faqem/detail/lod/lod_chain.hpp"
#include "result/simplify.hpp"
#include "scene/check_asset.hpp"
#include "scene/parts/parts_error_bound_search.hpp"
#include "scene/parts/simplify_parts.hpp"
#include "scene/resolved_options.hpp"
#include "scene/touching_parts.hpp"
#include "scene/welded_source.hpp"

namespace faqem {

namespace {

// Calls make(welded source, its parts, targets, options, context) and completes the reports. A single level with
// StopReason::cancelled if the progress callback cancels.
template <class LevelResult, class Make>
std::vector<LevelResult> made_levels(const Asset& source, const std::vector<Level>& levels,
                                     const Options& requested, LevelTextures textures, const Make& make) try {
    validate(requested);
    const Options options = detail::resolved_options(source, requested);
    if (textures == LevelTextures::shared) detail::check_shared_texture(options);
    detail::check_asset(source);
    const engine::RunContext context(options);
    context.show(Phase::simplify, 0);
    const detail::WeldedSource welded(source, options);
    const detail::ReferenceParts measured(welded.asset(), options, context);
    const std::vector<detail::LevelTarget> level_targets = detail::level_targets(
        levels, options, static_cast<double>(measured.faces()), measured.size().diagonal);
    if (level_targets.empty()) return {};
    std::vector<LevelResult> made = make(welded.asset(), measured, level_targets, options, context);
    for (LevelResult& level : made) welded.add_to(level.result.report);
    return made;
} catch (const engine::Cancelled&) {
    return detail::cancelled_levels<LevelResult>();
}

}  // namespace

std::vector<SimplifiedPartsLevel> simplify_parts_levels(const Asset& source, const std::vector<Level>& levels,
                                                        const Options& options) {
    std::vector<SimplifiedPartsLevel> made = made_levels<SimplifiedPartsLevel>(
        source, levels, options, LevelTextures::each,
        [](const Asset& welded, const detail::ReferenceParts& measured,
           const std::vector<detail::LevelTarget>& level_targets, const Options& resolved,
           const engine::RunContext& context) {
            return detail::run_lod_chain<SimplifiedPartsLevel>(
                level_targets, resolved, context, measured.faces(),
                [&](const std::vector<std::uint64_t>& targets, const Options& own,
                    const engine::RunContext& of_run) {
                    return detail::simplify_parts_to_targets(welded, targets, own, of_run, level_targets);
                },
                measured, detail::parts_within(welded, measured, resolved));
        });
    for (SimplifiedPartsLevel& level : made) level.result.parts.resize(source.parts.size());
    return made;
}

void detail::bake_levels(const Asset& source, std::vector<SimplifiedPartsLevel> levels,
                         const Options& options, const std::function<Continue(SimplifiedAssetLevel)>& use) {
    const RunContext context(options);
    const auto count = static_cast<double>(levels.size());
    double before = 0;
    for (SimplifiedPartsLevel& level : levels) {
        const SimplifiedParts simplified = std::move(level.result);
        const RunContext step = context.step(Phase::bake, before / count, (before + 1) / count);
        ++before;
        if (use({bake(source, simplified, options, step), level.distance, level.error}) == Continue::cancel)
            return;
    }
}

std::vector<SimplifiedAssetLevel> simplify_levels(const Asset& given, const std::vector<Level>& levels,
                                                  const Options& options, LevelTextures textures) {
    if (textures == LevelTextures::shared)
        return made_levels<SimplifiedAssetLevel>(given, levels, options, textures,
                                                 detail::levels_with_shared_texture);
    const std::optional<Asset> joined = detail::join_touching_parts(given, levels, options);
    const Asset& source = joined ? *joined : given;
    std::vector<SimplifiedAssetLevel> out;
    std::vector<SimplifiedPartsLevel> made = simplify_parts_levels(source, levels, options);
    detail::keep_only_cancelled(made);
    detail::bake_levels(source, std::move(made), options, [&](SimplifiedAssetLevel level) {
        out.push_back(std::move(level));
        return out.back().result.report.stop == StopReason::cancelled ? Continue::cancel : Continue::yes;
    });
    return out;
}

std::vector<std::string> save_levels(std::vector<SimplifiedAssetLevel> levels,
                                     const std::filesystem::path& file, Overwrite overwrite,
                                     double screen_error) {
    std::vector<SavedLevel> saved;
    std::vector<double> errors;
    for (SimplifiedAssetLevel& level : levels) {
        saved.push_back({std::move(level.result.asset), {}});
        errors.push_back(level.error);
    }
    detail::set_coverage(saved, errors, screen_error);
    return save_levels(std::move(saved), file, overwrite);
}

}  // namespace faqem

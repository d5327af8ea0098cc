#include "bake/scene/shared_texture.hpp"

#include <algorithm>
#include <utility>

#include "bake/scene/unencoded_result.hpp"
#include "faqem/error.hpp"
#include "scene/parts/part_reports.hpp"
#include "scene/parts/simplify_parts.hpp"

namespace faqem::detail {

namespace {

// The finest level needs an atlas of charts: in a per-triangle atlas all edges are seams, which limits the
// simplification of the other levels.
Options finest_level_options(Options options) {
    options.bake.kind = Bake::atlas;
    options.bake.untouched = UntouchedParts::baked;
    return options;
}

// The small components of the original were already pruned for the finest level. Components that became small
// by the simplification must not be pruned.
Options other_level_options(Options options) {
    options.bake.kind = Bake::keep;
    options.bake.untouched = UntouchedParts::baked;  // the finest level is not the original
    options.bake.correspondence = Recording::off;
    options.topology.prune.reset();
    return options;
}

// Levels are made from the finest one, but their counts refer to the original.
void add_counts_of_finest(Report& report, Report before) {
    report.faces_in = report.vertices_in = 0;
    before.faces_out = before.vertices_out = before.target_faces = 0;
    add_counts(report, before);
    report.vertices_hidden = before.vertices_hidden;
    report.warnings.insert(report.warnings.begin(), before.warnings.begin(), before.warnings.end());
}

// The counts of the parts determine whether a part still has the original surface.
void add_counts_of_finest(SimplifiedParts& simplified, const SimplifiedParts& finest, const Report& baked) {
    add_counts_of_finest(simplified.report, baked);
    for (std::size_t p = 0; p < simplified.parts.size(); ++p)
        add_counts_of_finest(simplified.parts[p].report, finest.parts[p].report);
}

}  // namespace

void check_shared_texture(const Options& options) {
    const Bake kind = options.bake.kind;
    if (kind != Bake::automatic && kind != Bake::atlas)
        throw OptionError(
            "shared textures: an atlas of charts is required, so bake must be atlas or automatic");
    if (options.history == Recording::on)
        throw OptionError(
            "shared textures: history must be off, since only the finest level has a history that "
            "begins at the original");
    if (options.topology.weld == Weld::none)
        throw OptionError(
            "shared textures: weld must not be none, since the seams of the new atlas would become "
            "boundaries");
    if (options.max_bytes)
        throw OptionError("shared textures: max_bytes must be unset, since all levels have the same images");
    if (options.topology.group_boundaries == GroupBoundaries::preserved)
        throw OptionError(
            "shared textures: group boundaries cannot be preserved, since the new atlas may merge materials");
}

std::vector<SimplifiedAssetLevel> levels_with_shared_texture(const Asset& source,
                                                             const ReferenceParts& measured,
                                                             std::span<const LevelTarget> level_targets,
                                                             const Options& options,
                                                             const RunContext& context) {
    // The simplification of the finest level is reported as Phase::simplify. All other steps are reported as
    // Phase::bake: baking this level, simplifying the other levels, and baking each of them.
    const double steps = level_targets.size() == 1 ? 1 : static_cast<double>(level_targets.size()) + 1;
    const auto baking = [&](std::size_t before) {
        const auto done = static_cast<double>(before);
        return context.step(Phase::bake, done / steps, (done + 1) / steps);
    };
    const Options finest_options = finest_level_options(options),
                  other_options = other_level_options(options);
    const std::vector<SimplifiedPartsLevel> made = run_lod_chain<SimplifiedPartsLevel>(
        level_targets.first(1), finest_options, context, measured.faces(),
        [&](const std::vector<std::uint64_t>& targets, const Options& own, const RunContext& of_run) {
            return simplify_parts_to_targets(source, targets, own, of_run, level_targets.first(1));
        },
        measured, parts_within(source, measured, finest_options));
    const SimplifiedPartsLevel& finest = made.front();
    std::vector<SimplifiedAssetLevel> out;
    out.reserve(level_targets.size());  // `baked` is a reference to the first element
    out.push_back(
        {bake_encoded(source, finest.result, finest_options, baking(0)), finest.distance, finest.error});
    const SimplifiedAsset& baked = out.front().result;
    if (level_targets.size() == 1) return out;

    const RunWithin<SimplifiedParts> within =
        parts_within(baked.asset, measured, other_options, Simplified::finer_level);
    const auto other_within = [&](double allowed, const Options& own, const RunContext& of_run) {
        std::optional<SimplifiedParts> simplified = within(allowed, own, of_run);
        if (simplified) add_counts_of_finest(*simplified, finest.result, baked.report);
        return simplified;
    };
    std::vector<SimplifiedPartsLevel> others = run_lod_chain<SimplifiedPartsLevel>(
        level_targets.subspan(1), other_options, baking(1), finest.result.report.faces_out,
        [&](const std::vector<std::uint64_t>& targets, const Options& own, const RunContext& of_run) {
            std::vector<SimplifiedParts> results =
                simplify_parts_to_targets(baked.asset, targets, own, of_run, level_targets.subspan(1));
            for (SimplifiedParts& simplified : results)
                add_counts_of_finest(simplified, finest.result, baked.report);
            return results;
        },
        measured, within ? other_within : RunWithin<SimplifiedParts>());
    keep_only_cancelled(others);
    for (SimplifiedPartsLevel& level : others) {
        const SimplifiedParts simplified = std::move(level.result);
        out.push_back({bake_encoded(baked.asset, simplified, other_options, baking(out.size() + 1)),
                       level.distance, std::max(level.error, finest.error)});
    }
    return out;
}

}  // namespace faqem::detail

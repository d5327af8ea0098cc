#include "bake/scene/shared_texture.hpp"

#include <algorithm>
#include <utility>

#include "bake/scene/simplify_parts.hpp"
#include "bake/scene/step_progress.hpp"
#include "faqem/error.hpp"

namespace faqem::detail {

namespace {

// A chart that is one triangle would hold each of its edges: there have to be charts.
Options of_finest(Options options) {
    options.bake.kind = Bake::atlas;
    return options;
}

// What was pruned is gone, and what has become small since then is none of it.
Options of_others(Options options) {
    options.bake.kind = Bake::keep;
    options.bake.correspondence = Recording::off;
    options.topology.prune.reset();
    return options;
}

// A level is made of the finest one; its counts are those since the original.
void count_from_original(Report& report, const Report& before) {
    report.faces_in = before.faces_in;
    report.vertices_in = before.vertices_in;
    report.collapses += before.collapses;
    for (std::size_t i = 0; i < refusal_kinds; ++i) report.refusals[i] += before.refusals[i];
    for (std::size_t i = 0; i < rung_kinds; ++i) report.rungs[i] += before.rungs[i];
    report.faces_dropped += before.faces_dropped;
    report.components_deleted += before.components_deleted;
    report.components_pruned += before.components_pruned;
    report.faces_pruned += before.faces_pruned;
    report.vertices_hidden = before.vertices_hidden;
    report.vertices_relaxed += before.vertices_relaxed;
    report.edges_swapped += before.edges_swapped;
    report.virtual_edges += before.virtual_edges;
    report.warnings.insert(report.warnings.begin(), before.warnings.begin(), before.warnings.end());
}

// Whether a part is still the original's surface is read from its counts.
void count_from_original(SmallParts& small, const SmallParts& finest, const Report& baked) {
    count_from_original(small.report, baked);
    for (std::size_t p = 0; p < small.parts.size(); ++p)
        count_from_original(small.parts[p].report, finest.parts[p].report);
}

}  // namespace

void check_shared_texture(const Options& options) {
    const Bake kind = options.bake.kind;
    if (kind != Bake::automatic && kind != Bake::atlas)
        throw OptionError("shared textures: need an atlas of charts, so bake must be atlas or automatic");
    if (options.history == Recording::on)
        throw OptionError("shared textures: only the finest level has a history that leads to the original");
    if (options.topology.weld == Weld::none)
        throw OptionError("shared textures: without welding the seams of the new atlas would be borders");
    if (options.topology.group_borders == GroupBorders::kept)
        throw OptionError("shared textures: groups cannot be kept, the new atlas may join their materials");
}

std::vector<LightLevel> levels_with_shared_texture(const Asset& source, const MeasuredParts& measured,
                                                   std::span<const Goal> goals, const Options& options) {
    // The finest level is simplified in a phase of its own. What comes then is all told of as baking: that
    // level, the collapses of the others, and each of them.
    const double steps = goals.size() == 1 ? 1 : static_cast<double>(goals.size()) + 1;
    const auto baking = [&](std::size_t before) {
        const auto done = static_cast<double>(before);
        return step_of(options, Phase::bake, done / steps, (done + 1) / steps);
    };
    const Options finest_options = of_finest(step_of(options, Phase::simplify, 0, 1));
    const std::vector<SmallPartsLevel> made = run_chain<SmallPartsLevel>(
        goals.first(1), finest_options, measured.faces(),
        [&](const std::vector<std::uint64_t>& targets, const Options& own) {
            return run_parts_to(source, targets, own);
        },
        measured);
    const SmallPartsLevel& finest = made.front();
    std::vector<LightLevel> out;
    out.reserve(goals.size());  // the first one is referred to
    out.push_back({bake(source, finest.result, of_finest(baking(0))), finest.distance, finest.error});
    const LightAsset& baked = out.front().result;
    if (baked.report.stop == StopReason::cancelled || goals.size() == 1) return out;

    std::vector<SmallPartsLevel> others = run_chain<SmallPartsLevel>(
        goals.subspan(1), of_others(baking(1)), finest.result.report.faces_out,
        [&](const std::vector<std::uint64_t>& targets, const Options& own) {
            std::vector<SmallParts> results = run_parts_to(baked.asset, targets, own);
            for (SmallParts& small : results) count_from_original(small, finest.result, baked.report);
            return results;
        },
        measured);
    for (SmallPartsLevel& level : others) {
        const SmallParts small = std::move(level.result);
        out.push_back({bake(baked.asset, small, of_others(baking(out.size() + 1))), level.distance,
                       std::max(level.error, finest.error)});
        if (out.back().result.report.stop == StopReason::cancelled) break;
    }
    return out;
}

}  // namespace faqem::detail

#include "faqem/options.hpp"

#include <new>

#include "capi/options.hpp"

namespace {

using namespace faqem;
using faqem::c::same;
using faqem::c::set;
using faqem::c::set_enum;

static_assert(same(FAQEM_PRESET_QEM, Preset::qem) && same(FAQEM_PRESET_PAPER, Preset::paper) &&
              same(FAQEM_PRESET_STMW, Preset::stmw) && same(FAQEM_PRESET_FAST, Preset::fast) &&
              same(FAQEM_PRESET_BALANCED, Preset::balanced) && same(FAQEM_PRESET_BEST, Preset::best));
static_assert(same(FAQEM_UNIT_MODEL, Length::Unit::model) &&
              same(FAQEM_UNIT_DIAGONAL, Length::Unit::diagonal));
static_assert(same(FAQEM_LINK_AS_PRESET, LinkCondition::as_preset) &&
              same(FAQEM_LINK_OFF, LinkCondition::off) && same(FAQEM_LINK_BY_SIZE, LinkCondition::by_size) &&
              same(FAQEM_LINK_ON, LinkCondition::on) && same(FAQEM_LINK_STRICT, LinkCondition::strict));
static_assert(same(FAQEM_BORDER_FREE, Border::free) && same(FAQEM_BORDER_KEPT, Border::locked) &&
              same(FAQEM_BORDER_FREE, GroupBorders::free) && same(FAQEM_BORDER_KEPT, GroupBorders::kept));
static_assert(same(FAQEM_RECORDING_OFF, Recording::off) && same(FAQEM_RECORDING_ON, Recording::on));
static_assert(same(FAQEM_PHASE_LOAD, Phase::load) && same(FAQEM_PHASE_WELD, Phase::weld) &&
              same(FAQEM_PHASE_SIMPLIFY, Phase::simplify) && same(FAQEM_PHASE_MAP, Phase::map) &&
              same(FAQEM_PHASE_BAKE, Phase::bake) && same(FAQEM_PHASE_SAVE, Phase::save));

/// A length of the member that `place` gives.
template <class Place>
faqem_status set_length(faqem_options* options, double value, faqem_unit unit, Place&& place) {
    if (unit != FAQEM_UNIT_MODEL && unit != FAQEM_UNIT_DIAGONAL) return FAQEM_ERROR_OPTION;
    return set(options, [&](Options& o) { place(o) = Length{value, static_cast<Length::Unit>(unit)}; });
}

}  // namespace

faqem_options* faqem_options_create(void) { return new (std::nothrow) faqem_options; }

void faqem_options_destroy(faqem_options* options) { delete options; }

faqem_status faqem_options_set_ratio(faqem_options* options, double share) {
    return set(options, [&](Options& o) { o.target = ratio(share); });
}

faqem_status faqem_options_set_faces(faqem_options* options, uint64_t count) {
    return set(options, [&](Options& o) { o.target = faces(count); });
}

faqem_status faqem_options_set_max_error(faqem_options* options, double distance, faqem_unit unit) {
    return set_length(
        options, distance, unit, [](Options & o) -> auto& { return o.max_error; });
}

faqem_status faqem_options_set_preset(faqem_options* options, faqem_preset preset) {
    return set_enum(
        options, preset, FAQEM_PRESET_BEST, [](Options & o) -> auto& { return o.preset; });
}

faqem_status faqem_options_set_link(faqem_options* options, faqem_link link) {
    return set_enum(
        options, link, FAQEM_LINK_STRICT, [](Options & o) -> auto& { return o.topology.link; });
}

faqem_status faqem_options_set_border(faqem_options* options, faqem_border border) {
    return set_enum(
        options, border, FAQEM_BORDER_KEPT, [](Options & o) -> auto& { return o.topology.border; });
}

faqem_status faqem_options_set_group_border(faqem_options* options, faqem_border border) {
    return set_enum(
        options, border, FAQEM_BORDER_KEPT, [](Options & o) -> auto& { return o.topology.group_borders; });
}

faqem_status faqem_options_set_weld_distance(faqem_options* options, double distance) {
    return set(options, [&](Options& o) { o.topology.weld_distance = distance; });
}

faqem_status faqem_options_set_virtual_edges(faqem_options* options, double share) {
    return set(options, [&](Options& o) {
        o.topology.virtual_edges = VirtualEdges::on;
        o.topology.virtual_edge_distance = share;
    });
}

faqem_status faqem_options_set_prune(faqem_options* options, double size, faqem_unit unit) {
    return set_length(
        options, size, unit, [](Options & o) -> auto& { return o.topology.prune; });
}

faqem_status faqem_options_set_history(faqem_options* options, faqem_recording history) {
    return set_enum(
        options, history, FAQEM_RECORDING_ON, [](Options & o) -> auto& { return o.history; });
}

faqem_status faqem_options_set_threads(faqem_options* options, uint32_t threads) {
    return set(options, [&](Options& o) { o.threads = threads; });
}

faqem_status faqem_options_set_progress(faqem_options* options, faqem_progress progress, void* user) {
    return set(options, [&](Options& o) {
        o.progress = {};
        if (!progress) return;
        o.progress = [progress, user](Phase phase, double fraction) {
            const int answer = progress(user, static_cast<faqem_phase>(phase), fraction);
            return answer != 0 ? Continue::cancel : Continue::yes;
        };
    });
}

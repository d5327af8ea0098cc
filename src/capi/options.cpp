#include "faqem/options.hpp"

#include <new>

#include "capi/options.hpp"

namespace {

using namespace faqem;
using faqem::capi::has_same_value;
using faqem::capi::set;
using faqem::capi::set_enum;

static_assert(has_same_value(FAQEM_PRESET_QEM, Preset::qem) &&
              has_same_value(FAQEM_PRESET_PAPER, Preset::paper) &&
              has_same_value(FAQEM_PRESET_STMW, Preset::stmw) &&
              has_same_value(FAQEM_PRESET_FAST, Preset::fast) &&
              has_same_value(FAQEM_PRESET_BALANCED, Preset::balanced) &&
              has_same_value(FAQEM_PRESET_BEST, Preset::best));
static_assert(has_same_value(FAQEM_UNIT_MODEL, Length::Unit::model) &&
              has_same_value(FAQEM_UNIT_DIAGONAL, Length::Unit::diagonal));
static_assert(has_same_value(FAQEM_LINK_AS_PRESET, LinkCondition::as_preset) &&
              has_same_value(FAQEM_LINK_OFF, LinkCondition::off) &&
              has_same_value(FAQEM_LINK_BY_SIZE, LinkCondition::by_size) &&
              has_same_value(FAQEM_LINK_ON, LinkCondition::on) &&
              has_same_value(FAQEM_LINK_STRICT, LinkCondition::strict));
static_assert(has_same_value(FAQEM_BOUNDARY_FREE, Boundary::free) &&
              has_same_value(FAQEM_BOUNDARY_KEPT, Boundary::locked) &&
              has_same_value(FAQEM_BOUNDARY_FREE, GroupBoundaries::free) &&
              has_same_value(FAQEM_BOUNDARY_KEPT, GroupBoundaries::kept));
static_assert(has_same_value(FAQEM_RECORDING_OFF, Recording::off) &&
              has_same_value(FAQEM_RECORDING_ON, Recording::on));
static_assert(has_same_value(FAQEM_PHASE_LOAD, Phase::load) &&
              has_same_value(FAQEM_PHASE_WELD, Phase::weld) &&
              has_same_value(FAQEM_PHASE_SIMPLIFY, Phase::simplify) &&
              has_same_value(FAQEM_PHASE_MAP, Phase::map) && has_same_value(FAQEM_PHASE_BAKE, Phase::bake) &&
              has_same_value(FAQEM_PHASE_SAVE, Phase::save));

/// Sets the Length that `member` returns a reference to.
template <class Member>
faqem_status set_length(faqem_options* options, double value, faqem_unit unit, Member&& member) {
    if (unit != FAQEM_UNIT_MODEL && unit != FAQEM_UNIT_DIAGONAL) return FAQEM_ERROR_OPTION;
    return set(options, [&](Options& o) { member(o) = Length{value, static_cast<Length::Unit>(unit)}; });
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

faqem_status faqem_options_set_boundary(faqem_options* options, faqem_boundary boundary) {
    return set_enum(
        options, boundary, FAQEM_BOUNDARY_KEPT, [](Options & o) -> auto& { return o.topology.boundary; });
}

faqem_status faqem_options_set_group_boundaries(faqem_options* options, faqem_boundary boundary) {
    return set_enum(
        options, boundary, FAQEM_BOUNDARY_KEPT,
        [](Options & o) -> auto& { return o.topology.group_boundaries; });
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

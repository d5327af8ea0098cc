#include <new>
#include <string>
#include <vector>

#include "capi/c_result.hpp"
#include "capi/guard.hpp"
#include "faqem/detail/options/option_table.hpp"
#include "faqem/options.hpp"

namespace {

using namespace faqem;
using faqem::capi::has_same_value;

static_assert(has_same_value(FAQEM_PRESET_QEM, Preset::qem) &&
              has_same_value(FAQEM_PRESET_PAPER, Preset::paper) &&
              has_same_value(FAQEM_PRESET_STMW, Preset::stmw) &&
              has_same_value(FAQEM_PRESET_FAST, Preset::fast) &&
              has_same_value(FAQEM_PRESET_BALANCED, Preset::balanced) &&
              has_same_value(FAQEM_PRESET_BEST, Preset::best));
static_assert(has_same_value(FAQEM_UNIT_MODEL, Length::Unit::model) &&
              has_same_value(FAQEM_UNIT_DIAGONAL, Length::Unit::diagonal));
static_assert(has_same_value(FAQEM_RECORDING_OFF, Recording::off) &&
              has_same_value(FAQEM_RECORDING_ON, Recording::on));
static_assert(has_same_value(FAQEM_PHASE_LOAD, Phase::load) &&
              has_same_value(FAQEM_PHASE_WELD, Phase::weld) &&
              has_same_value(FAQEM_PHASE_SIMPLIFY, Phase::simplify) &&
              has_same_value(FAQEM_PHASE_MAP, Phase::map) && has_same_value(FAQEM_PHASE_BAKE, Phase::bake) &&
              has_same_value(FAQEM_PHASE_SAVE, Phase::save));

/// Applies a change to the options if they are not null and the enumerator is in [0, last].
template <class Change>
faqem_status change_options(faqem_options* options, int enumerator, int last, Change&& change) {
    if (!options || enumerator < 0 || enumerator > last) return FAQEM_ERROR_OPTION;
    change(options->options);
    return FAQEM_OK;
}
template <class Change>
faqem_status change_options(faqem_options* options, Change&& change) {
    return change_options(options, 0, 0, change);
}

const detail::OptionRow* find_option(std::size_t index) {
    for (const detail::OptionRow& row : detail::option_table())
        if ((row.entry_points & detail::in_c_and_python) && index-- == 0) return &row;
    return nullptr;
}

}  // namespace

faqem_options* faqem_options_create(void) { return new (std::nothrow) faqem_options; }

void faqem_options_destroy(faqem_options* options) { delete options; }

faqem_status faqem_options_set(faqem_options* options, const char* name, const char* value,
                               faqem_error* error) {
    return capi::catch_exceptions(error, {{options, "options"}, {name, "name"}, {value, "value"}}, [&] {
        const detail::OptionRow& row = detail::named_option(name);
        set_option(options->options, row, value, detail::name_spelling);
        options->named.push_back(row.name);
    });
}

size_t faqem_option_count(void) {
    size_t count = 0;
    while (faqem_option_name(count)) ++count;
    return count;
}

// Names are string literals, so they end with a zero.
const char* faqem_option_name(size_t index) {
    const detail::OptionRow* row = find_option(index);
    return row ? row->name.data() : nullptr;
}

const char* faqem_option_help(size_t index) {
    static const std::vector<std::string> texts = [] {
        std::vector<std::string> result;
        for (std::size_t i = 0; const detail::OptionRow* row = find_option(i); ++i)
            result.push_back((row->choices.empty() ? "" : std::string(row->choices) + ": ") +
                             help_text(*row));
        return result;
    }();
    return index < texts.size() ? texts[index].c_str() : nullptr;
}

faqem_status faqem_options_set_ratio(faqem_options* options, double share) {
    return change_options(options, [&](Options& o) { o.target = ratio(share); });
}

faqem_status faqem_options_set_faces(faqem_options* options, uint64_t count) {
    return change_options(options, [&](Options& o) { o.target = faces(count); });
}

faqem_status faqem_options_set_max_error(faqem_options* options, double distance, faqem_unit unit) {
    return change_options(options, unit, FAQEM_UNIT_DIAGONAL, [&](Options& o) {
        o.max_error = Length{distance, static_cast<Length::Unit>(unit)};
    });
}

faqem_status faqem_options_set_preset(faqem_options* options, faqem_preset preset) {
    return change_options(options, preset, FAQEM_PRESET_BEST,
                          [&](Options& o) { o.preset = static_cast<Preset>(preset); });
}

faqem_status faqem_options_set_history(faqem_options* options, faqem_recording history) {
    return change_options(options, history, FAQEM_RECORDING_ON,
                          [&](Options& o) { o.history = static_cast<Recording>(history); });
}

faqem_status faqem_options_set_progress(faqem_options* options, faqem_progress progress, void* user) {
    return change_options(options, [&](Options& o) {
        o.progress = {};
        if (!progress) return;
        o.progress = [progress, user](Phase phase, double fraction) {
            const int answer = progress(user, static_cast<faqem_phase>(phase), fraction);
            return answer != 0 ? Continue::cancel : Continue::yes;
        };
    });
}

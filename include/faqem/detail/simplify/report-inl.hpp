#pragma once

#include "faqem/report.hpp"

#include "faqem/error.hpp"

FAQEM_NAMESPACE_BEGIN

namespace detail {

// Names of the enumerators, in the order of their enum.
inline constexpr std::array<std::string_view, all_presets.size()> preset_names = {"qem",  "paper",    "stmw",
                                                                                  "fast", "balanced", "best"};
inline constexpr std::array<std::string_view, 5> stop_names = {
    "reached_target", "no_legal_collapse", "reached_max_error", "cancelled", "reached_time_limit"};
inline constexpr std::array<std::string_view, refusal_kinds> refusal_names = {
    "flip", "degenerate", "link", "fold", "locked", "seam", "group", "zero_length", "last_faces"};
inline constexpr std::array<std::string_view, rung_kinds> rung_names = {
    "reseed", "duplicate_faces", "tiny_components", "group_boundaries", "without_link",
    "fold",   "flip_zero",       "flip_half",       "flip_any",         "any_component"};

}  // namespace detail

FAQEM_INLINE std::string_view name(Preset preset) {
    return detail::preset_names[static_cast<std::size_t>(preset)];
}
FAQEM_INLINE std::string_view name(StopReason reason) {
    return detail::stop_names[static_cast<std::size_t>(reason)];
}
FAQEM_INLINE std::string_view name(Refusal refusal) {
    return detail::refusal_names[static_cast<std::size_t>(refusal)];
}
FAQEM_INLINE std::string_view name(Rung rung) { return detail::rung_names[static_cast<std::size_t>(rung)]; }

FAQEM_INLINE Preset preset_named(std::string_view text) {
    for (const Preset preset : all_presets)
        if (name(preset) == text) return preset;
    std::string known;
    for (const std::string_view one : detail::preset_names)
        known += (known.empty() ? "" : ", ") + std::string(one);
    throw OptionError("unknown preset '" + std::string(text) + "' (known: " + known + ")");
}

FAQEM_NAMESPACE_END

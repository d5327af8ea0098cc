#pragma once

#include "faqem/report_json.hpp"

#include <array>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <string_view>

#include "faqem/detail/base/peak_memory.hpp"
#include "faqem/detail/simplify/report-inl.hpp"

FAQEM_NAMESPACE_BEGIN

namespace detail {

template <std::size_t n>
nlohmann::ordered_json counts(const std::array<std::uint64_t, n>& values,
                              const std::array<std::string_view, n>& names) {
    auto json = nlohmann::ordered_json::object();
    for (std::size_t i = 0; i < n; ++i) json[std::string(names[i])] = values[i];
    return json;
}

/// The value of --bake.
inline std::string_view bake_name(Bake kind) {
    constexpr std::array<std::string_view, 6> names = {"auto",   "atlas", "per-triangle",
                                                       "vertex", "keep",  "none"};
    return names[static_cast<std::size_t>(kind)];
}

}  // namespace detail

// nlohmann's library converts the elements of lists by these.

inline void to_json(nlohmann::ordered_json& json, const RemovedComponent& removed) {
    json = {{"part", removed.part},
            {"faces", removed.faces},
            {"area_share", removed.area_share},
            {"box_min", removed.box_min},
            {"box_max", removed.box_max}};
}

inline void to_json(nlohmann::ordered_json& json, const BakedPage& page) {
    json = {{"material", page.material},
            {"kind", detail::bake_name(page.kind)},
            {"width", page.width},
            {"height", page.height},
            {"faces", page.faces},
            {"charts", page.charts},
            {"faces_outside_charts", page.faces_outside_charts},
            {"fill", page.fill},
            {"density", page.density},
            {"stretch", page.stretch},
            {"samples",
             {{"history", page.samples[0]}, {"approximate", page.samples[1]}, {"closest", page.samples[2]}}},
            {"uncertain_texels", page.uncertain_texels}};
}

inline void to_json(nlohmann::ordered_json& json, const ResultImage& image) {
    json = {{"name", image.name},     {"mime_type", image.mime_type}, {"width", image.width},
            {"height", image.height}, {"bytes", image.bytes},         {"is_of_source", image.is_of_source}};
}

inline void to_json(nlohmann::ordered_json& json, const ResultView& view) {
    json = {{"content", view.content}, {"bytes", view.bytes}};
}

inline void to_json(nlohmann::ordered_json& json, const ComparedResult& result) {
    nlohmann::ordered_json bits;
    if (result.position_bits) bits = *result.position_bits;
    json = {{"kind", detail::bake_name(result.kind)}, {"faces", result.faces}, {"bytes", result.bytes},
            {"image_side", result.image_side},        {"position_bits", bits}, {"psnr", result.psnr}};
}

FAQEM_INLINE std::string to_json(const Report& report) {
    nlohmann::ordered_json json;
    json["preset"] = name(report.preset);
    json["faces_in"] = report.faces_in;
    json["faces_out"] = report.faces_out;
    json["vertices_in"] = report.vertices_in;
    json["vertices_out"] = report.vertices_out;
    json["vertices_split"] = report.vertices_split;
    json["target_faces"] = report.target_faces;
    json["stop_reason"] = name(report.stop);
    json["removed_components"] = report.removed_components;
    json["shrunk_components"] = report.shrunk_components;
    if (report.max_error) {
        const MeasuredError& e = *report.max_error;
        json["max_error"] = {{"allowed", e.allowed},
                             {"value", e.value},
                             {"bound", e.bound},
                             {"runs", e.runs},
                             {"within", e.within()}};
    }
    if (report.position_rounding)
        json["position_rounding"] = {{"spacing", report.position_rounding->spacing},
                                     {"max_error", report.position_rounding->max_error}};
    json["collapses"] = report.collapses;
    json["refusals"] = detail::counts(report.refusals, detail::refusal_names);
    json["rungs"] = detail::counts(report.rungs, detail::rung_names);
    json["faces_dropped"] = report.faces_dropped;
    json["components_collapsed"] = report.components_collapsed;
    json["components_deleted"] = report.components_deleted;
    json["components_pruned"] = report.components_pruned;
    json["faces_pruned"] = report.faces_pruned;
    json["vertices_hidden"] = report.vertices_hidden;
    json["vertices_fitted"] = report.vertices_fitted;
    json["edges_flipped"] = report.edges_flipped;
    json["virtual_edges"] = report.virtual_edges;
    json["pages"] = report.pages;
    json["images"] = report.images;
    json["buffer_views"] = report.buffer_views;
    json["bytes_in"] = report.bytes_in;
    json["bytes_out"] = report.bytes_out;
    if (report.little_saved) {
        const LittleSaved& saved = *report.little_saved;
        json["little_saved"] = {{"geometry", saved.geometry},   {"images", saved.images},
                                {"animation", saved.animation}, {"other", saved.other},
                                {"reason", saved.reason},       {"options", saved.options}};
    }
    json["given_up"] = report.given_up;
    json["compared_results"] = report.compared_results;
    json["untouched_parts"] = report.untouched_parts;
    json["kept_uvs"] = report.kept_uvs;
    if (report.coverage) {
        json["coverage"] = {{"missing_texels", report.coverage->missing_texels},
                            {"largest_distance", report.coverage->largest_distance},
                            {"unmatched_parts", report.coverage->unmatched_parts}};
    }
    json["warnings"] = report.warnings;
    const PhaseSeconds& s = report.seconds;
    json["seconds"] = {{"load", s.load}, {"weld", s.weld}, {"simplify", s.simplify}, {"map", s.map},
                       {"bake", s.bake}, {"save", s.save}, {"total", s.total}};
    json["peak_rss_bytes"] = detail::peak_memory_bytes();
    // File names need not be UTF-8: what is not is shown as U+FFFD.
    return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

FAQEM_NAMESPACE_END

#pragma once

#include "faqem/report_json.hpp"

#include <sys/resource.h>

#include <array>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <string_view>

#include "faqem/detail/simplify/report-inl.hpp"

FAQEM_NAMESPACE_BEGIN

namespace detail {

inline std::uint64_t peak_rss_bytes() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

template <std::size_t n>
nlohmann::ordered_json counts(const std::array<std::uint64_t, n>& values,
                              const std::array<std::string_view, n>& names) {
    auto json = nlohmann::ordered_json::object();
    for (std::size_t i = 0; i < n; ++i) json[std::string(names[i])] = values[i];
    return json;
}

inline nlohmann::ordered_json removed_components_json(const Report& report) {
    nlohmann::ordered_json json = nlohmann::ordered_json::array();
    for (const RemovedComponent& removed : report.removed_components) {
        json.push_back({{"part", removed.part},
                        {"faces", removed.faces},
                        {"area_share", removed.area_share},
                        {"box_min", removed.box_min},
                        {"box_max", removed.box_max}});
    }
    return json;
}

/// The value of --bake.
inline std::string_view bake_name(Bake kind) {
    constexpr std::array<std::string_view, 6> names = {"auto",   "atlas", "per-triangle",
                                                       "vertex", "keep",  "none"};
    return names[static_cast<std::size_t>(kind)];
}

inline nlohmann::ordered_json pages_json(const Report& report) {
    nlohmann::ordered_json json = nlohmann::ordered_json::array();
    for (const BakedPage& page : report.pages) {
        json.push_back(
            {{"material", page.material},
             {"kind", bake_name(page.kind)},
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
             {"uncertain_texels", page.uncertain_texels}});
    }
    return json;
}

inline nlohmann::ordered_json images_json(const Report& report) {
    nlohmann::ordered_json json = nlohmann::ordered_json::array();
    for (const ResultImage& image : report.images) {
        json.push_back({{"name", image.name},
                        {"mime_type", image.mime_type},
                        {"width", image.width},
                        {"height", image.height},
                        {"bytes", image.bytes},
                        {"is_of_source", image.is_of_source}});
    }
    return json;
}

inline nlohmann::ordered_json buffer_views_json(const Report& report) {
    nlohmann::ordered_json json = nlohmann::ordered_json::array();
    for (const ResultView& view : report.buffer_views)
        json.push_back({{"content", view.content}, {"bytes", view.bytes}});
    return json;
}

inline nlohmann::ordered_json compared_results_json(const Report& report) {
    nlohmann::ordered_json json = nlohmann::ordered_json::array();
    for (const ComparedResult& result : report.compared_results) {
        nlohmann::ordered_json bits;
        if (result.position_bits) bits = *result.position_bits;
        json.push_back({{"kind", bake_name(result.kind)},
                        {"faces", result.faces},
                        {"bytes", result.bytes},
                        {"image_side", result.image_side},
                        {"position_bits", bits},
                        {"psnr", result.psnr}});
    }
    return json;
}

}  // namespace detail

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
    json["removed_components"] = detail::removed_components_json(report);
    if (report.max_error) {
        const MeasuredError& e = *report.max_error;
        json["max_error"] = {{"allowed", e.allowed},
                             {"value", e.value},
                             {"bound", e.bound},
                             {"runs", e.runs},
                             {"within", e.within()}};
    }
    if (report.position_rounding) {
        json["position_rounding"] = {{"spacing", report.position_rounding->spacing},
                                     {"max_error", report.position_rounding->max_error}};
    }
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
    json["pages"] = detail::pages_json(report);
    json["images"] = detail::images_json(report);
    json["buffer_views"] = detail::buffer_views_json(report);
    json["bytes_in"] = report.bytes_in;
    json["bytes_out"] = report.bytes_out;
    if (report.little_saved) {
        const LittleSaved& saved = *report.little_saved;
        json["little_saved"] = {{"geometry", saved.geometry},   {"images", saved.images},
                                {"animation", saved.animation}, {"other", saved.other},
                                {"reason", saved.reason},       {"options", saved.options}};
    }
    json["given_up"] = report.given_up;
    json["compared_results"] = detail::compared_results_json(report);
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
    json["peak_rss_bytes"] = detail::peak_rss_bytes();
    // File names need not be UTF-8: what is not is shown as U+FFFD.
    return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

FAQEM_NAMESPACE_END

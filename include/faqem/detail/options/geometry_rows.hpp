#pragma once
/// \file
/// Rows of the table of options: targets, metric, topology, and how a run is made.

#include "faqem/detail/options/option_row.hpp"

FAQEM_DETAIL_BEGIN

inline OptionValue ratio_value(const Options& options) {
    const Target& target = options.target;
    if (target.kind == Target::Kind::faces) return {};
    return {target.value, target.kind == Target::Kind::ratio};
}
inline void set_ratio(Options& options, const OptionValue& value) { options.target = ratio(*value.number); }

inline OptionValue faces_value(const Options& options) {
    if (options.target.kind != Target::Kind::faces) return {};
    return {options.target.value, true};
}
inline void set_faces(Options& options, const OptionValue& value) {
    options.target = {Target::Kind::faces, *value.number};
}

inline OptionValue virtual_edges_value(const Options& options) {
    const Topology& topology = options.topology;
    return {topology.virtual_edge_distance, topology.virtual_edges == VirtualEdges::on};
}
inline void set_virtual_edges(Options& options, const OptionValue& value) {
    options.topology.virtual_edges = value.is_given ? VirtualEdges::on : VirtualEdges::off;
    if (value.number) options.topology.virtual_edge_distance = *value.number;
}

/// A weight of the metric.
template <std::optional<double> Weights::*weight>
constexpr OptionRow weight_row(std::string_view name, std::string_view member, std::string_view help) {
    return option_row<&Options::weights, weight>({.name = name,
                                                  .member_name = member,
                                                  .value_name = "W",
                                                  .default_text = "the preset's",
                                                  .help = help,
                                                  .entry_points = in_all_but_truncate});
}

inline constexpr OptionRow geometry_rows[] = {
    {.name = "ratio",
     .letter = "r",
     .member_name = "target ratio",
     .kind = OptionKind::share,
     .range = {.max = 1, .excludes_min = true},
     .value_name = "R",
     .default_text = "0.1",
     .help = "Share of faces to keep, as 0.1 or 10%",
     .group = "Target",
     .excludes = "faces",
     .entry_points = in_simplify_and_batch,
     .get = ratio_value,
     .set = set_ratio},
    {.name = "faces",
     .member_name = "target face count",
     .kind = OptionKind::integer,
     .range = {.min = 1},
     .value_name = "N",
     .help = "Number of faces to keep",
     .group = "Target",
     .excludes = "ratio",
     .entry_points = in_simplify_and_batch,
     .get = faces_value,
     .set = set_faces},
    option_row<&Options::max_error>(
        {.name = "max-error",
         .range = {.excludes_min = true},
         .value_name = "LENGTH",
         .help = "Maximum distance from the original, as 0.01 or 0.1%; in model units or with % of the "
                 "diagonal. Finds the smallest mesh within it; with --ratio or --faces the distance is only "
                 "checked",
         .group = "Target",
         .entry_points = in_simplify_and_batch}),
    option_row<&Options::max_seconds>(
        {.name = "max-seconds",
         .range = {.excludes_min = true},
         .value_name = "S",
         .help = "Stop after this time; the collapses end above the target, and images that are not baked "
                 "yet are kept. Results then depend on the machine",
         .entry_points = in_simplify_and_batch}),
    option_row<&Options::preset>({.name = "preset",
                                  .choices = "qem|paper|stmw|fast|balanced|best",
                                  .help = "Metric and rules",
                                  .entry_points = in_all_but_truncate}),
    weight_row<&Weights::area>("w-area", "weights.area", "Weight of the boundary area term"),
    weight_row<&Weights::boundary>("w-boundary", "weights.boundary", "Weight of the boundary curvature term"),
    weight_row<&Weights::normal>("w-normal", "weights.normal", "Weight of the normal term"),
    weight_row<&Weights::uv>("w-uv", "weights.uv", "Factor on quadrics at preserved UV seams"),
    weight_row<&Weights::plane_area>("w-plane-area", "weights.plane_area",
                                     "Inverse-area weight of planes; 0: unweighted"),
    option_row<&Options::topology, &Topology::link>(
        {.name = "link",
         .choices = "as-preset|off|by-size|on|strict",
         .flag_value = "on",
         .default_text = "the preset's",
         .help = "Enforce the link condition while the target can be reached",
         .entry_points = in_all_but_truncate}),
    option_row<&Options::topology, &Topology::boundary>({.name = "boundary",
                                                         .command_name = "lock-boundary",
                                                         .choices = "free|locked",
                                                         .flag_value = "locked",
                                                         .help = "Do not move boundary vertices",
                                                         .group = "Shape",
                                                         .entry_points = in_all_but_truncate}),
    option_row<&Options::topology, &Topology::group_boundaries>(
        {.name = "group-boundaries",
         .command_name = "keep-groups",
         .choices = "free|preferred|preserved",
         .flag_value = "preserved",
         .help = "Preserve boundaries between materials; even if the target is missed",
         .group = "Shape",
         .entry_points = in_all_but_truncate}),
    option_row<&Options::topology, &Topology::weld>(
        {.name = "welding",
         .member_name = "weld",
         .choices = "by-position|none",
         .help = "Whether vertices with equal or close positions are merged first"}),
    option_row<&Options::topology, &Topology::weld_distance>(
        {.name = "weld-distance",
         .command_name = "weld",
         .value_name = "D",
         .default_text = "the preset's",
         .help = "Weld vertices that are at most this far apart, model units",
         .entry_points = in_all_but_truncate}),
    option_row<&Options::topology, &Topology::prune>(
        {.name = "prune",
         .range = {.excludes_min = true},
         .value_name = "LENGTH",
         .help = "Delete connected components below a size, as 0.01 or 1%; in model units or with % of the "
                 "scene's diagonal, by the diagonal of the bounding box. The largest of each mesh is kept",
         .group = "Shape",
         .entry_points = in_all_but_truncate}),
    {.name = "virtual-edges",
     .member_name = "virtual_edge_distance",
     .range = {.max = 1, .excludes_min = true},
     .value_name = "TAU",
     .flag_value = "0.01",
     .default_text = "off",
     .help = "Connect boundaries across gaps of at most TAU, as 0.01; times the diagonal. Those of different "
             "components",
     .entry_points = in_all_but_truncate,
     .get = virtual_edges_value,
     .set = set_virtual_edges},
    option_row<&Options::history>(
        {.name = "history", .choices = "off|on", .help = "Whether to record the collapse history"}),
    option_row<&Options::threads>(
        {.name = "threads",
         .range = {.max = 1024},
         .value_name = "N",
         .help = "Maximum number of threads; 0: all. The result does not depend on it",
         .entry_points = in_all,
         .affects_result = false}),
};

FAQEM_DETAIL_END

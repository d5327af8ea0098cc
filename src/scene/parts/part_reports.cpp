#include "scene/parts/part_reports.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "asset/scene/affine.hpp"
#include "asset/scene/measured_instances.hpp"
#include "asset/scene/messages.hpp"
#include "asset/scene/part_arrays.hpp"
#include "scene/part_components.hpp"

namespace faqem::detail {
namespace {

// Calls visit(count of the sum, count of the part) for all counts.
template <class Visit>
void for_each_count(Report& sum, const Report& part, const Visit& visit) {
    for (const auto count :
         {&Report::faces_in, &Report::faces_out, &Report::vertices_in, &Report::vertices_out,
          &Report::collapses, &Report::faces_dropped, &Report::components_pruned, &Report::faces_pruned,
          &Report::components_collapsed, &Report::components_deleted, &Report::vertices_fitted,
          &Report::edges_flipped, &Report::virtual_edges})
        visit(sum.*count, part.*count);
    for (std::size_t i = 0; i < refusal_kinds; ++i) visit(sum.refusals[i], part.refusals[i]);
    for (std::size_t i = 0; i < rung_kinds; ++i) visit(sum.rungs[i], part.rungs[i]);
    // The target of a part is at least 4, even if the part has fewer faces.
    visit(sum.target_faces, std::min(part.target_faces, part.faces_in));
}

std::string part_warning(const std::string& title, const std::string& warning) {
    return title + ": " + warning;
}

}  // namespace

void add_counts(Report& sum, const Report& part) {
    for_each_count(sum, part, [](std::uint64_t& total, std::uint64_t own) { total += own; });
}

void add_part_report(Report& sum, const Report& part, const std::string& title) {
    add_counts(sum, part);
    const bool is_stopped = sum.stop == StopReason::cancelled || sum.stop == StopReason::reached_time_limit;
    if (part.stop != StopReason::reached_target && !is_stopped) sum.stop = part.stop;
    for (const std::string& warning : part.warnings) sum.warnings.push_back(part_warning(title, warning));
    sum.seconds.weld += part.seconds.weld;
    sum.seconds.simplify += part.seconds.simplify;
}

Report report_with_uvs(const Asset& source, const SimplifiedParts& simplified, std::span<const Index> which) {
    Report sum = simplified.report;
    for (const Index p : which) {
        const Report& without = simplified.parts[p].report;
        const std::string title = part_title(source, p);
        for_each_count(sum, without, [](std::uint64_t& total, std::uint64_t own) { total -= own; });
        for (const std::string& warning : without.warnings) {
            const auto found = std::ranges::find(sum.warnings, part_warning(title, warning));
            if (found != sum.warnings.end()) sum.warnings.erase(found);
        }
        add_part_report(sum, simplified.with_uvs[p].report, title);
    }
    sum.seconds = simplified.report.seconds;
    sum.target_faces = simplified.report.target_faces;
    return sum;
}

void report_removed_components(const Asset& source, SimplifiedParts& result) {
    Report& report = result.report;
    if (std::ranges::none_of(
            result.parts, [&](const SimplifyResult& part) { return may_lack_components(report, part.mesh); }))
        return;
    const PartComponents components = part_components(source);
    std::vector<PlacedFace> before, after;
    for (const Instance& instance : measured_instances(source)) {
        const Index p = instance.part;
        const auto append = [&](auto& faces, const auto& positions, const auto& triangles,
                                const std::vector<Index>& component) {
            append_placed_faces(faces, triangles, component,
                                [&](Index v) { return transformed_point(instance.transform, positions[v]); });
        };
        append(before, source.parts[p].positions, source.parts[p].triangles, components.of_face[p]);
        append(after, result.parts[p].mesh.positions, result.parts[p].mesh.triangles,
               gather(components.of_face[p], result.parts[p].face_origin));
    }
    const FoundComponents found = removed_components(before, after, components.count);
    const auto name_parts = [&](const std::vector<FoundComponent>& list) {
        std::vector<RemovedComponent> named;
        for (const FoundComponent& one : list) {
            named.push_back(one.removed);
            named.back().part = part_title(source, components.part_of(one.component));
        }
        return named;
    };
    report.removed_components = name_parts(found.removed);
    report.shrunk_components = name_parts(found.shrunk);
    warn_of_removed_components(report, found);
}

}  // namespace faqem::detail

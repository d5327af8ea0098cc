#include "scene/part_reports.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "asset/scene/affine.hpp"
#include "asset/scene/measured_instances.hpp"
#include "asset/scene/messages.hpp"
#include "faqem/detail/measure/removed_components.hpp"

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
    if (report.components_collapsed + report.components_deleted + report.components_pruned == 0) return;
    std::vector<FaceComponents> of_part;
    std::vector<std::uint8_t> is_left;
    std::vector<Index> first;  // by part: its first component
    for (std::size_t p = 0; p < source.parts.size(); ++p) {
        const Part& part = source.parts[p];
        of_part.push_back(face_components(part.positions, part.triangles));
        first.push_back(static_cast<Index>(is_left.size()));
        is_left.resize(is_left.size() + of_part[p].count, 0);
        for (Index& component : of_part[p].component) component += first[p];
        for (const Index f : result.parts[p].face_origin) is_left[of_part[p].component[f]] = 1;
    }
    std::vector<PlacedFace> faces;
    for (const Instance& instance : measured_instances(source)) {
        const Part& part = source.parts[instance.part];
        const auto place = [&](Index v) { return transformed_point(instance.transform, part.positions[v]); };
        for (std::size_t f = 0; f < part.triangles.size(); ++f) {
            const Triangle& t = part.triangles[f];
            faces.push_back({of_part[instance.part].component[f], {place(t[0]), place(t[1]), place(t[2])}});
        }
    }
    const FoundComponents found = removed_components(faces, is_left);
    for (const FoundComponent& one : found.visible) {
        const auto after = std::upper_bound(first.begin(), first.end(), one.component);
        report.removed_components.push_back(one.removed);
        report.removed_components.back().part =
            part_title(source, static_cast<std::size_t>(after - first.begin()) - 1);
    }
    warn_of_removed_components(report, found);
}

}  // namespace faqem::detail

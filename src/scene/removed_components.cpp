#include "scene/removed_components.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "asset/scene/affine.hpp"
#include "asset/scene/measured_instances.hpp"
#include "asset/scene/messages.hpp"
#include "faqem/detail/measure/removed_components.hpp"

namespace faqem::detail {

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
    for (FoundComponent& found : removed_components(faces, is_left)) {
        const auto after = std::upper_bound(first.begin(), first.end(), found.component);
        found.removed.part = part_title(source, static_cast<std::size_t>(after - first.begin()) - 1);
        report.removed_components.push_back(std::move(found.removed));
    }
    warn_of_removed_components(report);
}

}  // namespace faqem::detail

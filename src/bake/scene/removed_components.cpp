#include "bake/scene/removed_components.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <vector>

#include "asset/scene/messages.hpp"
#include "faqem/detail/measure/removed_components.hpp"
#include "faqem/engine/mesh/vector.hpp"

namespace faqem::detail {
namespace {

std::vector<Vec3> transformed(const std::vector<Vec3>& positions, const std::array<double, 16>& transform) {
    const Eigen::Map<const Eigen::Matrix4d> matrix(transform.data());
    std::vector<Vec3> result;
    result.reserve(positions.size());
    for (const Vec3& p : positions)
        result.push_back(
            engine::to_array(engine::Vector3((matrix * engine::to_eigen(p).homogeneous()).head<3>())));
    return result;
}

}  // namespace

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
    std::vector<PlacedFaces> scene;
    for (const Instance& instance : instances(source)) {
        const Part& part = source.parts[instance.part];
        scene.push_back({transformed(part.positions, instance.transform), part.triangles,
                         of_part[instance.part].component});
    }
    for (FoundComponent& found : removed_components(scene, is_left)) {
        const auto after = std::upper_bound(first.begin(), first.end(), found.component);
        found.removed.part = part_title(source, static_cast<std::size_t>(after - first.begin()) - 1);
        report.removed_components.push_back(std::move(found.removed));
    }
    warn_of_removed_components(report);
}

}  // namespace faqem::detail

#include "scene/parts/parts_from_histories.hpp"

#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "asset/finest_level.hpp"
#include "asset/scene/affine.hpp"
#include "faqem/error.hpp"
#include "faqem/truncate.hpp"
#include "scene/parts/part_reports.hpp"

namespace faqem::detail {

namespace {

bool matches(const Part& part, const CollapseHistory& history) {
    if (history.triangles.size() != part.triangles.size()) return false;
    const double extent = largest_component(part.positions);
    for (std::size_t f = 0; f < part.triangles.size(); ++f) {
        for (std::size_t k = 0; k < 3 && history.triangles[f][0] != no_index; ++k) {
            const Vec3 &a = part.positions[part.triangles[f][k]],
                       &b = history.positions[history.triangles[f][k]];
            for (std::size_t i = 0; i < 3; ++i)
                if (!(std::abs(a[i] - b[i]) <= 0.01 * extent)) return false;
        }
    }
    return true;
}

}  // namespace

SimplifiedParts parts_from_histories(std::vector<CollapseHistory> cuts) {
    SimplifiedParts simplified;
    for (CollapseHistory& cut : cuts)
        add_counts(simplified.report, simplified.parts.emplace_back(restore(std::move(cut))).report);
    return simplified;
}

void check_source_matches_histories(const Asset& given, const SimplifiedParts& simplified) {
    const std::optional<FinestLevel> finest = finest_level(given);
    const Asset& source = finest ? finest->asset : given;
    if (source.parts.size() != simplified.parts.size())
        throw InputError("", "", "the number of meshes differs from that of the history");
    for (std::size_t p = 0; p < source.parts.size(); ++p)
        if (!matches(source.parts[p], simplified.parts[p].history))
            throw InputError("", "mesh " + std::to_string(p), "does not match the history");
}

}  // namespace faqem::detail

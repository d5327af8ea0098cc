#include "bake/scene/parts_from_histories.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "faqem/cut.hpp"
#include "faqem/error.hpp"

namespace faqem::detail {

namespace {

bool fits(const Part& part, const CollapseHistory& history) {
    if (history.triangles.size() != part.triangles.size()) return false;
    double most = 0;
    for (const Vec3& at : part.positions)
        most = std::max({most, std::abs(at[0]), std::abs(at[1]), std::abs(at[2])});
    for (std::size_t f = 0; f < part.triangles.size(); ++f) {
        for (std::size_t k = 0; k < 3 && history.triangles[f][0] != no_index; ++k) {
            const Vec3 &a = part.positions[part.triangles[f][k]],
                       &b = history.positions[history.triangles[f][k]];
            for (std::size_t i = 0; i < 3; ++i) {
                if (!(std::abs(a[i] - b[i]) <= 0.01 * most)) return false;
            }
        }
    }
    return true;
}

}  // namespace

SmallParts restored(std::vector<CollapseHistory> cuts) {
    SmallParts small;
    for (CollapseHistory& cut : cuts) {
        const Report& report = small.parts.emplace_back(restore(std::move(cut))).report;
        small.report.faces_in += report.faces_in;
        small.report.faces_out += report.faces_out;
        small.report.vertices_in += report.vertices_in;
        small.report.vertices_out += report.vertices_out;
        small.report.collapses += report.collapses;
    }
    return small;
}

void check_source(const Asset& source, const SmallParts& small) {
    if (source.parts.size() != small.parts.size())
        throw InputError("", "", "has another number of meshes than the history");
    for (std::size_t p = 0; p < source.parts.size(); ++p) {
        if (!fits(source.parts[p], small.parts[p].history))
            throw InputError("", "mesh " + std::to_string(p), "is not the one of the history");
    }
}

}  // namespace faqem::detail

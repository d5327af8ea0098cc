#include "cli/files/input_model.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "asset/scene/messages.hpp"
#include "asset/scene/rounding_weld.hpp"
#include "faqem/detail/geometry/triangle.hpp"
#include "faqem/engine/mesh/index_lists.hpp"
#include "faqem/error.hpp"
#include "result/simplify_file.hpp"

namespace faqem::cli {
namespace {

/// Returns the corner positions, rotated so that the lexicographically smallest one comes first: duplicates
/// compare equal, faces of opposite orientation do not.
std::array<Vec3, 3> corner_positions(const Part& part, const Triangle& t) {
    std::array<Vec3, 3> p = {part.positions[t[0]], part.positions[t[1]], part.positions[t[2]]};
    std::rotate(p.begin(), std::ranges::min_element(p), p.end());
    return p;
}

void require_nonzero_area(const Part& part, const std::string& where) {
    for (std::size_t f = 0; f < part.triangles.size(); ++f) {
        const auto [a, b, c] = corner_positions(part, part.triangles[f]);
        if (detail::has_no_area(a, b, c))
            throw InputError(where, "face " + std::to_string(f), "has zero area");
    }
}

void require_no_duplicate_faces(const Part& part, const std::string& where) {
    std::vector<Index> order = engine::all_indices(part.triangles.size());
    const auto key = [&](Index f) {
        return std::pair(corner_positions(part, part.triangles[f]),
                         part.face_material.empty() ? no_index : part.face_material[f]);
    };
    std::ranges::sort(order, [&](Index a, Index b) {
        const auto first = key(a), second = key(b);
        return first != second ? first < second : a < b;
    });
    Index earlier = no_index, later = no_index;
    for (std::size_t i = 1; i < order.size(); ++i)
        if (key(order[i - 1]) == key(order[i]) && order[i] < later) earlier = order[i - 1], later = order[i];
    if (later != no_index)
        throw InputError(where, "face " + std::to_string(later),
                         "is a duplicate of face " + std::to_string(earlier));
}

}  // namespace

void check_strictness(const Asset& asset, const std::filesystem::path& file, Strictness strictness) {
    if (strictness == Strictness::lenient) return;
    if (!asset.warnings.empty())
        throw InputError(file.string(), "", "rejected by --strict: " + asset.warnings.front());
    for (std::size_t p = 0; p < asset.parts.size(); ++p) {
        const std::string where = file.string() + ": " + detail::part_title(asset, p);
        const Part& part = asset.parts[p];
        const auto rounded = detail::find_rounding_weld(part.positions, part.triangles, asset.precision);
        if (!rounded.messages.empty())
            throw InputError(where, "", "rejected by --strict: " + rounded.messages.front());
        require_nonzero_area(part, where);
        require_no_duplicate_faces(part, where);
    }
}

Asset load_model(const std::filesystem::path& file, Strictness strictness) {
    Asset asset = detail::load_triangles(file);
    check_strictness(asset, file, strictness);
    return asset;
}

}  // namespace faqem::cli

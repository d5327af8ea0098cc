#include "bake/double_faces.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "bake/groups.hpp"
#include "faqem/engine/weld.hpp"

namespace faqem::detail {
namespace {

bool has_one_material(const Part& part) {
    return std::all_of(part.face_material.begin(), part.face_material.end(),
                       [&](Index m) { return m == part.face_material.front(); });
}

// The smallest corner first, so that doubles are equal and faces back to back are not.
std::vector<Triangle> corner_places(const Part& part) {
    const std::vector<Index> first = engine::weld_exact(part.positions);
    std::vector<Triangle> result;
    result.reserve(part.triangles.size());
    for (const Triangle& t : part.triangles) {
        Triangle& p = result.emplace_back(Triangle{first[t[0]], first[t[1]], first[t[2]]});
        std::rotate(p.begin(), std::min_element(p.begin(), p.end()), p.end());
    }
    return result;
}

}  // namespace

std::vector<Index> set_materials_apart(const Part& part, std::vector<Index> groups) {
    if (has_one_material(part)) return groups;
    const std::vector<Triangle> places = corner_places(part);
    const auto group = [&](Index f) { return groups.empty() ? Index{0} : groups[f]; };
    std::vector<Index> order(places.size());
    std::iota(order.begin(), order.end(), Index{0});
    std::sort(order.begin(), order.end(), [&](Index a, Index b) {
        return std::tuple(places[a], group(a), a) < std::tuple(places[b], group(b), b);
    });
    std::vector<Index> apart;
    for (std::size_t i = 1, first = 0; i < order.size(); ++i) {
        const Index a = order[first], b = order[i];
        if (places[a] != places[b] || group(a) != group(b))
            first = i;
        else if (face_material(part, a) != face_material(part, b))
            apart.push_back(b);
    }
    if (apart.empty()) return groups;
    if (groups.empty()) groups.assign(places.size(), 0);
    const Index next = *std::max_element(groups.begin(), groups.end()) + 1;
    for (const Index f : apart) {
        const Index material = face_material(part, f);
        groups[f] = material == no_index ? next : next + 1 + material;
    }
    return groups;
}

}  // namespace faqem::detail

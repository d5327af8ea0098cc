#include "bake/scene/duplicate_faces.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "bake/transfer/vector_conversion.hpp"
#include "bake/transfer/material_groups.hpp"
#include "faqem/engine/mesh/weld.hpp"

namespace faqem::detail {
namespace {

// What tells faces at one place apart.
struct Look {
    Index material;
    bool is_turned;  // wound against its normals, so that the other side is seen
    bool operator==(const Look&) const = default;
};

bool is_turned(const Part& part, const Triangle& t) {
    if (part.normals.empty()) return false;
    engine::Vector3 normal = engine::Vector3::Zero();
    for (const Index v : t) normal += to_vector(part.normals[v]);
    const auto at = [&](std::size_t c) { return engine::to_eigen(part.positions[t[c]]); };
    return normal.dot(engine::area_vector(at(0), at(1), at(2))) < 0;
}

std::vector<Look> looks_of(const Part& part) {
    std::vector<Look> result;
    result.reserve(part.triangles.size());
    for (const Triangle& t : part.triangles) {
        result.push_back({face_material(part, static_cast<Index>(result.size())), is_turned(part, t)});
    }
    return result;
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

std::vector<Index> set_looks_apart(const Part& part, std::vector<Index> groups) {
    const std::vector<Look> looks = looks_of(part);
    if (looks.empty() || std::equal(looks.begin() + 1, looks.end(), looks.begin())) return groups;
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
        else if (looks[a] != looks[b])
            apart.push_back(b);
    }
    if (apart.empty()) return groups;
    if (groups.empty()) groups.assign(places.size(), 0);
    const Index next = *std::max_element(groups.begin(), groups.end()) + 1;
    for (const Index f : apart) {
        const auto [material, turned] = looks[f];
        groups[f] = next + 2 * (material == no_index ? 0 : 1 + material) + (turned ? 1 : 0);
    }
    return groups;
}

}  // namespace faqem::detail

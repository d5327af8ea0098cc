#include "scene/coincident_faces.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "faqem/engine/mesh/weld.hpp"
#include "scene/material_groups.hpp"
#include "scene/vector_conversion.hpp"

namespace faqem::detail {
namespace {

// Properties by which coincident faces look different.
struct FaceAppearance {
    Index material;
    bool is_wound_against_normals;  // the winding contradicts the normals
    bool operator==(const FaceAppearance&) const = default;
};

bool is_wound_against_normals(const Part& part, const Triangle& t) {
    if (part.normals.empty()) return false;
    engine::Vector3 normal = engine::Vector3::Zero();
    for (const Index v : t) normal += to_vector(part.normals[v]);
    return normal.dot(area_vector(part.positions, t)) < 0;
}

std::vector<FaceAppearance> face_appearances(const Part& part) {
    std::vector<FaceAppearance> result;
    result.reserve(part.triangles.size());
    for (const Triangle& t : part.triangles) {
        result.push_back(
            {face_material(part, static_cast<Index>(result.size())), is_wound_against_normals(part, t)});
    }
    return result;
}

// Welded corners by face, the smallest one first: duplicate faces are equal, faces of opposite winding are
// not.
std::vector<Triangle> canonical_corners(const Part& part) {
    const std::vector<Index> representative = engine::weld_exact(part.positions);
    std::vector<Triangle> result;
    result.reserve(part.triangles.size());
    for (const Triangle& t : part.triangles) {
        Triangle& p =
            result.emplace_back(Triangle{representative[t[0]], representative[t[1]], representative[t[2]]});
        std::rotate(p.begin(), std::ranges::min_element(p), p.end());
    }
    return result;
}

}  // namespace

std::vector<Index> separate_coincident_faces(const Part& part, std::vector<Index> groups) {
    const std::vector<FaceAppearance> appearances = face_appearances(part);
    if (appearances.empty() || std::equal(appearances.begin() + 1, appearances.end(), appearances.begin()))
        return groups;
    const std::vector<Triangle> corners = canonical_corners(part);
    const auto group = [&](Index f) { return groups.empty() ? Index{0} : groups[f]; };
    std::vector<Index> order(corners.size());
    std::iota(order.begin(), order.end(), Index{0});
    std::ranges::sort(order, [&](Index a, Index b) {
        return std::tuple(corners[a], group(a), a) < std::tuple(corners[b], group(b), b);
    });
    std::vector<Index> separated;
    for (std::size_t i = 1, first = 0; i < order.size(); ++i) {
        const Index a = order[first], b = order[i];
        if (corners[a] != corners[b] || group(a) != group(b))
            first = i;
        else if (appearances[a] != appearances[b])
            separated.push_back(b);
    }
    if (separated.empty()) return groups;
    if (groups.empty()) groups.assign(corners.size(), 0);
    const Index next = *std::ranges::max_element(groups) + 1;
    for (const Index f : separated) {
        const auto [material, reversed] = appearances[f];
        groups[f] = next + 2 * (material == no_index ? 0 : 1 + material) + (reversed ? 1 : 0);
    }
    return groups;
}

}  // namespace faqem::detail

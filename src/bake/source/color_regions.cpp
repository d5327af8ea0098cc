#include "bake/source/color_regions.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "asset/scene/value_numbers.hpp"
#include "bake/source/source_normals.hpp"
#include "faqem/engine/mesh/union_find.hpp"
#include "faqem/engine/mesh/vector.hpp"
#include "scene/material_groups.hpp"
#include "scene/vector_conversion.hpp"

namespace faqem::detail {
namespace {

using engine::to_eigen;

// Texels across a strip: those at its two sides are mixed.
constexpr double texels_across = 5;

// A surface without seams has one vertex for two faces. Below this number of vertices for each face, few edges are
// between faces that have different vertices there.
constexpr double split_vertices_per_face = 0.7;

struct RegionEdge {
    Index low, high;  // welded vertices
    Index face;
    std::uint8_t corner;  // opposite the edge

    bool same_edge(const RegionEdge& o) const { return low == o.low && high == o.high; }
};

std::vector<RegionEdge> sorted_edges(const Part& part) {
    UniqueValues<Vec3> positions;
    positions.reserve(part.positions.size());
    std::vector<Index> welded;
    welded.reserve(part.positions.size());
    for (const Vec3& p : part.positions) welded.push_back(positions.insert(p));
    std::vector<RegionEdge> result;
    result.reserve(3 * part.triangles.size());
    for (Index f = 0; f < part.triangles.size(); ++f) {
        for (std::uint8_t c = 0; c < 3; ++c) {
            const Index a = welded[part.triangles[f][(c + 1) % 3]],
                        b = welded[part.triangles[f][(c + 2) % 3]];
            result.push_back({std::min(a, b), std::max(a, b), f, c});
        }
    }
    std::sort(result.begin(), result.end(), [](const RegionEdge& a, const RegionEdge& b) {
        if (a.low != b.low) return a.low < b.low;
        return a.high != b.high ? a.high < b.high : 3ull * a.face + a.corner < 3ull * b.face + b.corner;
    });
    return result;
}

std::array<Index, 2> vertices_of(const Part& part, const RegionEdge& edge) {
    const Triangle& t = part.triangles[edge.face];
    const Index a = t[(edge.corner + 1) % 3], b = t[(edge.corner + 2) % 3];
    return {std::min(a, b), std::max(a, b)};
}

// The middle of an edge, a little inside its face.
SurfacePoint middle_of(const RegionEdge& edge) {
    Vec3 barycentric = {0.49, 0.49, 0.49};
    barycentric[edge.corner] = 0.02;
    return {edge.face, barycentric};
}

}  // namespace

std::vector<float> region_densities(
    const Part& part, const std::function<bool(const SurfacePoint&, const SurfacePoint&)>& differs) {
    const std::size_t faces = part.triangles.size();
    const double split = split_vertices_per_face * static_cast<double>(faces);
    if (materials_of(part).size() < 2 && static_cast<double>(part.positions.size()) < split) return {};
    const std::vector<RegionEdge> edges = sorted_edges(part);
    engine::UnionFind regions(faces);
    std::vector<double> border(faces, 0), area(faces, 0);  // by face, then by the first face of the region
    bool has_borders = false;
    for (std::size_t i = 1; i < edges.size(); ++i) {
        const RegionEdge &a = edges[i - 1], &b = edges[i];
        if (!a.same_edge(b)) continue;
        const bool is_inner = face_material(part, a.face) == face_material(part, b.face) &&
                              vertices_of(part, a) == vertices_of(part, b);
        if (is_inner || !differs(middle_of(a), middle_of(b))) {
            regions.unite(a.face, b.face);
            continue;
        }
        const auto [from, to] = vertices_of(part, a);
        const double length = (to_eigen(part.positions[from]) - to_eigen(part.positions[to])).norm();
        border[a.face] += length;
        border[b.face] += length;
        has_borders = true;
    }
    if (!has_borders) return {};
    for (Index f = 0; f < faces; ++f) {
        const Index region = regions.find(f);
        area[region] += area_vector(part.positions, part.triangles[f]).norm() / 2;
        if (region != f) border[region] += border[f];
    }
    std::vector<float> result(faces, 0.0f);
    for (Index f = 0; f < faces; ++f) {
        const Index region = regions.find(f);
        // A strip of width w has 2 / w of border for each unit of area.
        const double density = texels_across * border[region] / (2 * area[region]);
        if (std::isfinite(density)) result[f] = static_cast<float>(density);
    }
    return result;
}

}  // namespace faqem::detail

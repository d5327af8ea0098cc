#include "bake/source/facets.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "asset/scene/value_numbers.hpp"
#include "faqem/detail/base/vector.hpp"
#include "faqem/detail/geometry/halfedges.hpp"
#include "faqem/engine/mesh/union_find.hpp"
#include "faqem/engine/mesh/weld.hpp"
#include "scene/material_groups.hpp"
#include "scene/vector_conversion.hpp"

namespace faqem::detail {
namespace {

// One vertex at which the rounded values are equal connects two facets, so that those that differ only by rounding do not
// divide a smooth surface.
constexpr double normal_steps = 64;

template <std::size_t N>
Facets facets_by(const Part& part, const std::vector<std::array<float, N>>& values) {
    Facets result;
    if (values.empty()) return result;
    UniqueValues<std::array<double, 3 + N>> vertices;
    vertices.reserve(part.positions.size());
    std::vector<Index> vertex(part.positions.size());
    for (std::size_t v = 0; v < vertex.size(); ++v) {
        const Vec3& p = part.positions[v];
        std::array<double, 3 + N> key{p[0], p[1], p[2]};
        for (std::size_t k = 0; k < N; ++k) key[3 + k] = std::round(normal_steps * values[v][k]) + 0.0;
        vertex[v] = vertices.insert(key);
    }
    engine::UnionFind sets(vertices.values().size());
    for (const Triangle& t : part.triangles) {
        sets.unite(vertex[t[0]], vertex[t[1]]);
        sets.unite(vertex[t[0]], vertex[t[2]]);
    }
    std::vector<Index> number(vertices.values().size(), no_index);
    for (const Triangle& t : part.triangles) {
        Index& facet = number[sets.find(vertex[t[0]])];
        if (facet == no_index) {
            facet = static_cast<Index>(result.areas.size());
            result.areas.push_back(0);
        }
        result.of_face.push_back(facet);
        result.areas[facet] += triangle_area(part.positions, t);
    }
    result.is_seamless.assign(result.areas.size(), 1);
    UniqueValues<std::array<double, 4>> places;  // a position and a facet
    std::size_t count = 0;
    for (std::size_t v = 0; v < number.size(); ++v) {
        const Index facet = number[sets.find(static_cast<Index>(v))];
        if (facet == no_index) continue;
        const auto& key = vertices.values()[v];
        places.insert({key[0], key[1], key[2], static_cast<double>(facet)});
        if (places.values().size() == count) result.is_seamless[facet] = 0;
        count = places.values().size();
    }
    return result;
}

// Texels across a strip: those at its two sides are mixed.
constexpr double texels_across = 5;

// A surface without seams has one vertex for two faces. Below this number of vertices for each face, few edges are
// between faces that have different vertices there.
constexpr double split_vertices_per_face = 0.7;

// The half-edges of all faces, with vertices at equal positions as one.
std::vector<Halfedge> welded_halfedges(const Part& part) {
    const std::vector<Index> welded = engine::weld_exact(part.positions);
    std::vector<Triangle> triangles = part.triangles;
    for (Triangle& t : triangles)
        for (Index& v : t) v = welded[v];
    return sorted_halfedges(triangles);
}

std::array<Index, 2> vertices_of(const Part& part, const Halfedge& edge) {
    const Triangle& t = part.triangles[edge.face];
    const auto [a, b] = std::minmax(t[edge.corner], t[(edge.corner + 1) % 3]);
    return {a, b};
}

// The middle of an edge, a little inside its face.
SurfacePoint middle_of(const Halfedge& edge) {
    Vec3 barycentric = {0.49, 0.49, 0.49};
    barycentric[edge.opposite()] = 0.02;
    return {edge.face, barycentric};
}

}  // namespace

Facets normal_facets(const Part& part) { return facets_by(part, part.normals); }

Facets color_facets(const Part& part) { return facets_by(part, part.colors); }

std::vector<float> region_densities(
    const Part& part, const std::function<bool(const SurfacePoint&, const SurfacePoint&)>& differs) {
    const std::size_t faces = part.triangles.size();
    const double split = split_vertices_per_face * static_cast<double>(faces);
    if (materials_of(part).size() < 2 && static_cast<double>(part.positions.size()) < split) return {};
    engine::UnionFind regions(faces);
    std::vector<double> border(faces, 0), area(faces, 0);  // by face, then by the first face of the region
    bool has_borders = false;
    const auto compare = [&](const Halfedge& a, const Halfedge& b) {
        const bool is_inner = face_material(part, a.face) == face_material(part, b.face) &&
                              vertices_of(part, a) == vertices_of(part, b);
        if (is_inner || !differs(middle_of(a), middle_of(b))) return regions.unite(a.face, b.face);
        const auto [from, to] = vertices_of(part, a);
        const double length = (to_eigen(part.positions[from]) - to_eigen(part.positions[to])).norm();
        border[a.face] += length;
        border[b.face] += length;
        has_borders = true;
    };
    for_each_edge(welded_halfedges(part), [&](std::span<const Halfedge> on) {
        for (std::size_t i = 1; i < on.size(); ++i) compare(on[i - 1], on[i]);
    });
    if (!has_borders) return {};
    for (Index f = 0; f < faces; ++f) {
        const Index region = regions.find(f);
        area[region] += triangle_area(part.positions, part.triangles[f]);
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

#include "bake/source/facets.hpp"

#include <array>
#include <cmath>
#include <cstddef>

#include "asset/scene/value_numbers.hpp"
#include "faqem/engine/mesh/union_find.hpp"
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

}  // namespace

Facets normal_facets(const Part& part) { return facets_by(part, part.normals); }

Facets color_facets(const Part& part) { return facets_by(part, part.colors); }

}  // namespace faqem::detail

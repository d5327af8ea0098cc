#include "mapping_sheets.hpp"

#include <algorithm>

#include "faqem/engine/vector.hpp"

namespace faqem::detail {
namespace {

struct HalfEdge {
    std::uint64_t key;  // smaller vertex, larger vertex
    Index face;
    std::uint8_t corner;
    bool forward;  // from the smaller to the larger vertex

    bool operator<(const HalfEdge& other) const {
        if (key != other.key) return key < other.key;
        if (face != other.face) return face < other.face;
        return corner < other.corner;
    }
};

struct Neighbour {
    Index face = no_index;
    bool same_winding = true;
};

std::vector<HalfEdge> sorted_half_edges(std::span<const Triangle> triangles) {
    std::vector<HalfEdge> edges;
    edges.reserve(3 * triangles.size());
    for (std::size_t f = 0; f < triangles.size(); ++f) {
        const Triangle& t = triangles[f];
        if (t[0] == no_index) continue;
        for (std::uint8_t c = 0; c < 3; ++c) {
            const Index a = t[c], b = t[(c + 1) % 3];
            if (a == b) continue;
            const std::uint64_t key = (std::uint64_t{std::min(a, b)} << 32) | std::max(a, b);
            edges.push_back({key, static_cast<Index>(f), c, a < b});
        }
    }
    std::sort(edges.begin(), edges.end());
    return edges;
}

// Neighbours over the three edges of each face, where the edge has exactly two faces.
std::vector<Neighbour> neighbours(std::span<const Triangle> triangles) {
    const std::vector<HalfEdge> edges = sorted_half_edges(triangles);
    std::vector<Neighbour> result(3 * triangles.size());
    for (std::size_t i = 0, end; i < edges.size(); i = end) {
        for (end = i + 1; end < edges.size() && edges[end].key == edges[i].key;) ++end;
        if (end - i != 2) continue;
        const HalfEdge &e = edges[i], &g = edges[i + 1];
        const bool same = e.forward != g.forward;
        result[std::size_t{3} * e.face + e.corner] = {g.face, same};
        result[std::size_t{3} * g.face + g.corner] = {e.face, same};
    }
    return result;
}

double area(std::span<const Vec3> positions, const Triangle& t) {
    using engine::to_eigen;
    return engine::area_vector(to_eigen(positions[t[0]]), to_eigen(positions[t[1]]),
                               to_eigen(positions[t[2]]))
        .norm();
}

}  // namespace

Sheets find_sheets(std::span<const Vec3> positions, std::span<const Triangle> triangles) {
    const std::vector<Neighbour> next = neighbours(triangles);
    Sheets result{std::vector<Index>(triangles.size(), no_index),
                  std::vector<std::int8_t>(triangles.size(), 1)};
    std::vector<Index> faces;  // of the sheet at hand, in breadth-first order
    Index sheets = 0;
    for (std::size_t root = 0; root < triangles.size(); ++root) {
        if (triangles[root][0] == no_index || result.sheet[root] != no_index) continue;
        faces.assign(1, static_cast<Index>(root));
        result.sheet[root] = sheets;
        double balance = 0;
        for (std::size_t i = 0; i < faces.size(); ++i) {
            const Index f = faces[i];
            balance += result.sign[f] * area(positions, triangles[f]);
            for (std::size_t c = 0; c < 3; ++c) {
                const Neighbour& n = next[std::size_t{3} * f + c];
                if (n.face == no_index || result.sheet[n.face] != no_index) continue;
                result.sheet[n.face] = sheets;
                result.sign[n.face] =
                    static_cast<std::int8_t>(n.same_winding ? result.sign[f] : -result.sign[f]);
                faces.push_back(n.face);
            }
        }
        if (balance < 0) {
            for (Index f : faces) result.sign[f] = static_cast<std::int8_t>(-result.sign[f]);
        }
        ++sheets;
    }
    return result;
}

}  // namespace faqem::detail

#include "bake/parts/corners.hpp"

#include <bit>
#include <numeric>
#include <utility>

#include "asset/scene/part_arrays.hpp"

namespace faqem::detail {
namespace {

template <class T, std::size_t N>
int compare(const std::array<T, N>& a, const std::array<T, N>& b) {
    return a == b ? 0 : a < b ? -1 : 1;
}

// Compares bit patterns, since kept UVs can be NaN. -0 and 0 are equal.
template <std::size_t N>
int compare(const std::array<float, N>& a, const std::array<float, N>& b) {
    for (std::size_t k = 0; k < N; ++k) {
        const auto x = std::bit_cast<std::uint32_t>(a[k] + 0.0f),
                   y = std::bit_cast<std::uint32_t>(b[k] + 0.0f);
        if (x != y) return x < y ? -1 : 1;
    }
    return 0;
}

int compare(const CornerValues& corners, std::uint64_t a, std::uint64_t b) {
    int result = 0;
    visit_vertex_arrays(
        [&](const VertexArray&, const auto& values) {
            if (result == 0 && !values.empty()) result = compare(values[a], values[b]);
        },
        corners);
    return result;
}

// Numbers the fans of faces at a vertex, by corner, if all are closed: every edge there has two faces of opposite
// direction. Otherwise all corners have the same number.
std::vector<std::size_t> closed_fans(const TriangleMesh& mesh, std::span<const std::uint64_t> corners) {
    const std::size_t count = corners.size();
    const std::vector<std::size_t> one_fan(count, 0);
    if (count < 6) return one_fan;  // a closed fan has at least three faces
    const auto other_vertex = [&](std::size_t i, std::size_t step) {
        return mesh.triangles[corners[i] / 3][(corners[i] % 3 + step) % 3];
    };
    std::vector<std::pair<Index, std::size_t>> by_first(count);  // the face that begins with a vertex
    for (std::size_t i = 0; i < count; ++i) by_first[i] = {other_vertex(i, 1), i};
    std::sort(by_first.begin(), by_first.end());
    std::vector<std::size_t> next(count), fans(count, count);
    for (std::size_t i = 0; i < count; ++i) {
        const Index last = other_vertex(i, 2);
        const auto found = std::ranges::lower_bound(by_first, std::pair(last, std::size_t{0}));
        if (found == by_first.end() || found->first != last) return one_fan;
        next[i] = found->second;
    }
    std::size_t number = 0;
    for (std::size_t i = 0; i < count; ++i) {
        if (fans[i] != count) continue;
        std::size_t at = i;
        for (; fans[at] == count; at = next[at]) fans[at] = number;
        if (at != i) return one_fan;
        ++number;
    }
    return fans;
}

// By corner: the first corner of its vertex and fan that agrees with it in all values.
std::vector<std::uint64_t> representatives(const TriangleMesh& mesh, const CornerValues& values) {
    const VertexCorners at = vertex_corners(mesh);
    std::vector<std::uint64_t> result(3 * mesh.triangles.size());
    std::vector<std::size_t> sorted;  // indices into the corners of a vertex
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        const auto corners = at[v];
        const std::vector<std::size_t> fans = closed_fans(mesh, corners);
        const auto differ = [&](std::size_t a, std::size_t b) {
            if (fans[a] != fans[b]) return fans[a] < fans[b] ? -1 : 1;
            return compare(values, corners[a], corners[b]);
        };
        sorted.resize(corners.size());
        std::iota(sorted.begin(), sorted.end(), std::size_t{0});
        std::sort(sorted.begin(), sorted.end(), [&](std::size_t a, std::size_t b) {
            const int c = differ(a, b);
            return c ? c < 0 : a < b;
        });
        for (std::size_t i = 0, first = 0; i < sorted.size(); ++i) {
            if (differ(sorted[first], sorted[i]) != 0) first = i;
            result[corners[sorted[i]]] = corners[sorted[first]];
        }
    }
    return result;
}

}  // namespace

VertexCorners vertex_corners(const TriangleMesh& mesh) {
    return VertexCorners(mesh.positions.size(), [&](auto&& put) {
        for (std::uint64_t f = 0; f < mesh.triangles.size(); ++f)
            for (std::size_t c = 0; c < 3; ++c) put(mesh.triangles[f][c], 3 * f + c);
    });
}

Vec3 barycentrics_near_corner(std::size_t corner, double inset) {
    Vec3 w = {inset / 2, inset / 2, inset / 2};
    w[corner] = 1 - inset;
    return w;
}

WeldedPart weld_corners(const BakePart& bake_part, const CornerValues& values) {
    const TriangleMesh& mesh = bake_part.simplified->mesh;
    const std::vector<std::uint64_t> first = representatives(mesh, values);
    std::vector<Index> number(first.size(), no_index);
    WeldedPart result;
    Part& part = result.part;
    part.name = bake_part.source->name;
    part.source = bake_part.source->source;
    part.triangles.resize(mesh.triangles.size());
    for (std::uint64_t c = 0; c < first.size(); ++c) {
        Index& n = number[first[c]];
        if (n == no_index) {
            n = static_cast<Index>(result.corner.size());
            result.corner.push_back(c);
        }
        part.triangles[c / 3][c % 3] = n;
    }
    select_vertices(values, result.corner, part);
    for (const std::uint64_t c : result.corner)
        part.positions.push_back(mesh.positions[mesh.triangles[c / 3][c % 3]]);
    return result;
}

}  // namespace faqem::detail

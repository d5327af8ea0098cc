#include "bake/parts/corners.hpp"

#include <algorithm>
#include <bit>

namespace faqem::detail {
namespace {

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

int compare(const CornerValues& values, std::uint64_t a, std::uint64_t b) {
    if (!values.normals.empty()) {
        if (const int c = compare(values.normals[a], values.normals[b])) return c;
    }
    for (const std::vector<Vec2f>& uvs : values.uvs) {
        if (const int c = compare(uvs[a], uvs[b])) return c;
    }
    if (!values.tangents.empty()) {
        if (const int c = compare(values.tangents[a], values.tangents[b])) return c;
    }
    for (const CustomAttribute& attribute : values.custom) {
        if (attribute.values[a] != attribute.values[b])
            return attribute.values[a] < attribute.values[b] ? -1 : 1;
    }
    return values.colors.empty() ? 0 : compare(values.colors[a], values.colors[b]);
}

// By corner: the first corner of its vertex that agrees with it in all values.
std::vector<std::uint64_t> representatives(const TriangleMesh& mesh, const CornerValues& values) {
    const VertexCorners at = vertex_corners(mesh);
    std::vector<std::uint64_t> result(3 * mesh.triangles.size());
    std::vector<std::uint64_t> sorted;
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        const auto corners = at.at(v);
        sorted.assign(corners.begin(), corners.end());
        std::sort(sorted.begin(), sorted.end(), [&](std::uint64_t a, std::uint64_t b) {
            const int c = compare(values, a, b);
            return c ? c < 0 : a < b;
        });
        for (std::size_t i = 0, first = 0; i < sorted.size(); ++i) {
            if (compare(values, sorted[first], sorted[i]) != 0) first = i;
            result[sorted[i]] = sorted[first];
        }
    }
    return result;
}

}  // namespace

VertexCorners vertex_corners(const TriangleMesh& mesh) {
    VertexCorners result;
    result.begin.assign(mesh.positions.size() + 1, 0);
    for (const Triangle& t : mesh.triangles) {
        for (Index v : t) ++result.begin[std::size_t{v} + 1];
    }
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) result.begin[v + 1] += result.begin[v];
    result.corners.resize(result.begin.back());
    std::vector<std::uint64_t> fill(result.begin.begin(), result.begin.end() - 1);
    for (std::uint64_t c = 0; c < result.corners.size(); ++c) {
        result.corners[fill[mesh.triangles[c / 3][c % 3]]++] = c;
    }
    return result;
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
    part.uvs.resize(values.uvs.size());
    part.custom_attributes = bake_part.source->custom_attributes;
    part.custom_attributes.resize(values.custom.size());
    for (CustomAttribute& attribute : part.custom_attributes) attribute.values.clear();
    for (std::uint64_t c = 0; c < first.size(); ++c) {
        Index& n = number[first[c]];
        if (n == no_index) {
            n = static_cast<Index>(result.corner.size());
            result.corner.push_back(c);
            part.positions.push_back(mesh.positions[mesh.triangles[c / 3][c % 3]]);
            if (!values.normals.empty()) part.normals.push_back(values.normals[c]);
            for (std::size_t s = 0; s < values.uvs.size(); ++s) part.uvs[s].push_back(values.uvs[s][c]);
            if (!values.colors.empty()) part.colors.push_back(values.colors[c]);
            if (!values.tangents.empty()) part.tangents.push_back(values.tangents[c]);
            for (std::size_t a = 0; a < values.custom.size(); ++a)
                part.custom_attributes[a].values.push_back(values.custom[a].values[c]);
        }
        part.triangles[c / 3][c % 3] = n;
    }
    return result;
}

}  // namespace faqem::detail

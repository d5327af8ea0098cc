#include "bake/parts/vertex_attributes.hpp"

#include <algorithm>
#include <cmath>

#include "asset/scene/affine.hpp"
#include "asset/scene/influences.hpp"
#include "asset/scene/part_arrays.hpp"
#include "bake/source/facets.hpp"
#include "bake/source/source_normals.hpp"
#include "faqem/detail/base/parallel.hpp"
#include "faqem/detail/base/vector.hpp"
#include "scene/material_groups.hpp"
#include "scene/vector_conversion.hpp"

namespace faqem::detail {
namespace {

void blend_skin(const Part& from, const SurfacePoint& point, Part& to) {
    const Triangle& t = from.triangles[point.face];
    Influences all;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t k = 0; k < 4; ++k)
            all.add(from.joints[t[i]][k], point.barycentric[i] * from.weights[t[i]][k]);
    all.take_heaviest(to.joints.emplace_back(), to.weights.emplace_back());
}

Vec3f blend(const std::vector<Vec3f>& values, const Triangle& t, const Vec3& w) {
    Vec3f result;
    for (std::size_t k = 0; k < 3; ++k)
        result[k] =
            static_cast<float>(w[0] * values[t[0]][k] + w[1] * values[t[1]][k] + w[2] * values[t[2]][k]);
    return result;
}

double shortest_edge(const TriangleMesh& mesh, std::size_t face) {
    const auto [a, b, c] = corners_of(mesh.positions, mesh.triangles[face]);
    return std::min({(a - c).norm(), (a - b).norm(), (b - c).norm()});
}

// Sum of premultiplied colours, so that transparent corners do not tint the others. Corners with an alpha of 0
// have straight colours, which are used if there are no others.
struct ColorSum {
    LinearColor premultiplied{}, hidden{};
    float count = 0;

    void add(const LinearColor& c) {
        LinearColor& sum = c[3] > 0 ? premultiplied : hidden;
        for (std::size_t k = 0; k < 4; ++k) sum[k] += c[k];
        ++count;
    }
    Vec4f straight() const {
        const float alpha = premultiplied[3];
        const LinearColor& sum = alpha > 0 ? premultiplied : hidden;
        const float weight = alpha > 0 ? alpha : count;
        Vec4f result{0, 0, 0, std::clamp(alpha / count, 0.0f, 1.0f)};
        for (std::size_t k = 0; k < 3; ++k) result[k] = std::clamp(sum[k] / weight, 0.0f, 1.0f);
        return result;
    }
};

constexpr std::uint32_t float_components = 5126;
constexpr double equal_share = 1e-4;  // of the range of an attribute

using Value = std::array<double, 4>;

bool is_close(const Value& a, const Value& b, double distance) {
    for (std::size_t k = 0; k < 4; ++k)
        if (!(std::abs(a[k] - b[k]) <= distance)) return false;
    return true;
}

// Gives corners of a vertex whose values are close to each other the value of the first of them.
void join_close_values(const TriangleMesh& mesh, double distance, std::vector<Value>& values) {
    join_corners(
        mesh, values.size(),
        [&](std::uint64_t a, std::uint64_t b) { return is_close(values[a], values[b], distance); },
        [&](std::uint64_t from, std::uint64_t to) { values[to] = values[from]; });
}

}  // namespace

bool is_copied(const CustomAttribute& attribute) {
    return attribute.component_type != float_components || attribute.name == "_BATCHID" ||
           attribute.name.compare(0, 12, "_FEATURE_ID_") == 0;
}

std::vector<CustomAttribute> corner_custom_attributes(const BakePart& part,
                                                      const engine::RunContext& context) {
    const std::vector<CustomAttribute>& from = part.source->custom_attributes;
    if (from.empty() || !part.map) return {};
    std::vector<CustomAttribute> result = without_values(from);
    const TriangleMesh& mesh = part.simplified->mesh;
    for (std::size_t c = 0; c < 3 * mesh.triangles.size(); ++c) {
        context.count(2 * map_query_cost);
        const auto face = static_cast<Index>(c / 3);
        const SurfacePoint exact = part.map->map(face, barycentrics_near_corner(c % 3, 0));
        // A little inside of the face, where it is clear which side of a border the corner belongs to.
        const SurfacePoint inside = part.map->map(face, barycentrics_near_corner(c % 3, 0.02));
        const Triangle& source = part.source->triangles[inside.face];
        const auto nearest = static_cast<std::size_t>(std::ranges::max_element(inside.barycentric) -
                                                      inside.barycentric.begin());
        for (std::size_t a = 0; a < from.size(); ++a)
            result[a].values.push_back(is_copied(from[a])
                                           ? from[a].values[source[nearest]]
                                           : interpolated<double>(from[a].values, *part.source, exact));
    }
    for (std::size_t a = 0; a < from.size(); ++a)
        if (!is_copied(from[a]))
            join_close_values(mesh, equal_share * largest_component(from[a].values), result[a].values);
    return result;
}

void transfer_skin_and_morphs(const BakePart& bake_part, WeldedPart& welded,
                              const engine::RunContext& context) {
    const Part& from = *bake_part.source;
    Part& to = welded.part;
    const bool skin = !from.joints.empty() && !from.weights.empty();
    if ((!skin && from.morph_targets.empty()) || !bake_part.map) return;
    const TriangleMesh& mesh = bake_part.simplified->mesh;
    const VertexCorners at = vertex_corners(mesh);
    to.morph_targets.resize(from.morph_targets.size());
    for (std::uint64_t corner : welded.corner) {
        context.count(map_query_cost);
        const std::uint64_t shared = at[mesh.triangles[corner / 3][corner % 3]].front();
        const SurfacePoint point =
            bake_part.map->map(static_cast<Index>(shared / 3), barycentrics_near_corner(shared % 3, 0));
        if (skin) blend_skin(from, point, to);
        for (std::size_t m = 0; m < from.morph_targets.size(); ++m) {
            const MorphTarget& target = from.morph_targets[m];
            if (!target.positions.empty())
                to.morph_targets[m].positions.push_back(
                    blend(target.positions, from.triangles[point.face], point.barycentric));
            if (target.normals.empty() || to.normals.empty()) continue;
            const SurfacePoint own = bake_part.map->map(static_cast<Index>(corner / 3),
                                                        barycentrics_near_corner(corner % 3, 0.02));
            to.morph_targets[m].normals.push_back(
                blend(target.normals, from.triangles[own.face], own.barycentric));
        }
    }
}

std::vector<Vec4f> corner_colors(const BakePart& part, const SourceSampler& sampler,
                                 const RunContext& context) {
    const TriangleMesh& mesh = part.simplified->mesh;
    std::vector<LinearColor> raw(3 * mesh.triangles.size());
    const Facets facets = part.normals.clusters.empty() ? color_facets(*part.source) : Facets{};
    std::vector<Index> sets = part.normals.clusters;
    sets.resize(raw.size(), no_index);
    // The alpha of vertex colours where no material says what it means, as in PLY files; it does not weight colours.
    std::vector<float> plain_alpha(raw.size(), 1);
    const std::vector<Vec4f>& colors = part.source->colors;
    const bool has_alpha = std::ranges::any_of(colors, [](const Vec4f& c) { return c[3] != 1; });
    parallel_blocks(mesh.triangles.size(), 256, context, [&](std::size_t begin, std::size_t end) {
        for (std::size_t c = 3 * begin; c < 3 * end; ++c) {
            const Index face = static_cast<Index>(c / 3);
            // A vertex represents the surface around it: a quarter of an edge on each side.
            const double spacing = shortest_edge(mesh, face) / 4;
            const SurfacePoint point = part.map->map(face, barycentrics_near_corner(c % 3, 1e-3));
            raw[c] = sampler.sample(part.index, point, spacing).base;
            if (!facets.of_face.empty()) {
                const Index facet = facets.of_face[point.face];
                if (2 * facets.areas[facet] >= triangle_area(mesh.positions, mesh.triangles[face]))
                    sets[c] = facet;
            }
            if (has_alpha && face_material(*part.source, point.face) == no_index)
                plain_alpha[c] = interpolated<float>(colors, *part.source, point)[3];
            if (raw[c][3] > 0) continue;
            const Vec3f stored = sampler.stored_base_color(part.index, point);
            raw[c] = {stored[0], stored[1], stored[2], 0};
        }
    });
    const auto group = [&](std::uint64_t c) {
        return mesh.face_groups.empty() ? 0 : mesh.face_groups[c / 3];
    };
    const VertexCorners at = vertex_corners(mesh);
    std::vector<Vec4f> result(raw.size());
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        std::vector<std::uint64_t> corners(at[v].begin(), at[v].end());
        const auto key = [&](std::uint64_t c) { return std::pair(sets[c], group(c)); };
        std::ranges::sort(corners, {}, [&](std::uint64_t c) { return std::pair(key(c), c); });
        for (std::size_t i = 0, end; i < corners.size(); i = end) {
            ColorSum sum;
            float alpha = 0;
            for (end = i; end < corners.size() && key(corners[end]) == key(corners[i]); ++end) {
                sum.add(raw[corners[end]]);
                alpha += plain_alpha[corners[end]];
            }
            Vec4f color = sum.straight();
            color[3] *= std::clamp(alpha / sum.count, 0.0f, 1.0f);
            for (std::size_t j = i; j < end; ++j) result[corners[j]] = color;
        }
    }
    return result;
}

}  // namespace faqem::detail

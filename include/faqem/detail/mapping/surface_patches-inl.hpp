#pragma once

#include "faqem/detail/mapping/surface_patches.hpp"

#include <algorithm>
#include <array>

#include "faqem/detail/base/vector.hpp"
#include "faqem/detail/geometry/halfedges.hpp"

FAQEM_DETAIL_BEGIN

struct AdjacentFace {
    Index face = no_index;
    bool same_winding = true;  // the orientations are consistent
};

// Cosines of the angle between two faces at an edge; -1 if one continues the other without a bend. The angle
// is at least 150 degrees for a continuation, and less than 120 degrees between its faces and any third face.
inline constexpr double max_continuation_cosine = -0.87, min_separation_cosine = -0.5;

// Calls join(i, j), i < j, for the pairs of half-edges on a non-manifold edge whose faces continue each other
// and are separated from all other faces there.
// on: the half-edges on the edge; has_no_neighbour(i): half-edge i is not connected yet
template <class Open, class Join>
void for_each_continuation(std::span<const Vec3> positions, std::span<const Triangle> triangles,
                           std::span<const Halfedge> on, Open&& has_no_neighbour, Join&& join) {
    // With more faces, no pair can be separated from the others.
    constexpr std::size_t max_edge_faces = 6;
    if (on.size() < 3 || on.size() > max_edge_faces) return;
    const Vector3 start = to_eigen(positions[on[0].low]);
    const Vector3 edge = (to_eigen(positions[on[0].high]) - start).normalized();
    std::array<Vector3, max_edge_faces> face_direction;  // per face: direction perpendicular to the edge
    for (std::size_t i = 0; i < on.size(); ++i) {
        const Vector3 apex = to_eigen(positions[triangles[on[i].face][on[i].opposite()]]) - start;
        face_direction[i] = (apex - apex.dot(edge) * edge).normalized();
    }
    const auto is_separated = [&](std::size_t i, std::size_t but) {
        for (std::size_t k = 0; k < on.size(); ++k)
            if (k != i && k != but && !(face_direction[i].dot(face_direction[k]) > min_separation_cosine))
                return false;
        return true;
    };
    for (std::size_t i = 0; i < on.size(); ++i) {
        for (std::size_t j = i + 1; j < on.size(); ++j) {
            if (has_no_neighbour(i) && has_no_neighbour(j) &&
                face_direction[i].dot(face_direction[j]) <= max_continuation_cosine && is_separated(i, j) &&
                is_separated(j, i))
                join(i, j);
        }
    }
}

// For each face, the faces connected to it across its three edges.
inline std::vector<AdjacentFace> adjacent_faces(std::span<const Vec3> positions,
                                                std::span<const Triangle> triangles,
                                                std::span<const Triangle> unwelded) {
    std::vector<AdjacentFace> result(3 * triangles.size());
    for_each_edge(sorted_halfedges(triangles), [&](std::span<const Halfedge> on) {
        const auto unwelded_edge = [&](std::size_t i) -> std::uint64_t {
            if (unwelded.empty()) return 0;
            const Triangle& t = unwelded[on[i].face];
            const Index from = t[on[i].corner], to = t[(on[i].corner + 1) % 3];
            return std::uint64_t{std::min(from, to)} << 32 | std::max(from, to);
        };
        const auto adjacent_across = [&](std::size_t i) -> AdjacentFace& {
            return result[std::size_t{3} * on[i].face + on[i].corner];
        };
        const auto join = [&](std::size_t i, std::size_t j) {
            const bool same = on[i].is_ascending != on[j].is_ascending;
            adjacent_across(i) = {on[j].face, same};
            adjacent_across(j) = {on[i].face, same};
        };
        for_each_connected_pair(on.size(), unwelded_edge, join);
        for_each_continuation(
            positions, triangles, on, [&](std::size_t i) { return adjacent_across(i).face == no_index; },
            join);
    });
    return result;
}

FAQEM_INLINE SurfacePatches find_surface_patches(std::span<const Vec3> positions,
                                                 std::span<const Triangle> triangles,
                                                 std::span<const Triangle> unwelded) {
    const std::vector<AdjacentFace> next = adjacent_faces(positions, triangles, unwelded);
    SurfacePatches result;
    result.surface_patch.assign(triangles.size(), no_index);
    result.sign.assign(triangles.size(), 1);
    std::vector<Index> faces;  // of the current patch, in breadth-first order
    Index surface_patches = 0;
    for (std::size_t root = 0; root < triangles.size(); ++root) {
        if (triangles[root][0] == no_index || result.surface_patch[root] != no_index) continue;
        faces.assign(1, static_cast<Index>(root));
        result.surface_patch[root] = surface_patches;
        double signed_area = 0;
        for (std::size_t i = 0; i < faces.size(); ++i) {
            const Index f = faces[i];
            signed_area += result.sign[f] * area_vector(positions, triangles[f]).norm();
            for (std::size_t c = 0; c < 3; ++c) {
                const AdjacentFace& n = next[std::size_t{3} * f + c];
                if (n.face == no_index || result.surface_patch[n.face] != no_index) continue;
                result.surface_patch[n.face] = surface_patches;
                result.sign[n.face] =
                    static_cast<std::int8_t>(n.same_winding ? result.sign[f] : -result.sign[f]);
                faces.push_back(n.face);
            }
        }
        if (signed_area < 0)
            for (Index f : faces) result.sign[f] = static_cast<std::int8_t>(-result.sign[f]);
        ++surface_patches;
    }
    result.faces = Buckets<Index>(surface_patches, [&](auto&& put) {
        for (Index f = 0; f < triangles.size(); ++f)
            if (result.surface_patch[f] != no_index) put(result.surface_patch[f], f);
    });
    return result;
}

FAQEM_DETAIL_END

#pragma once

#include "faqem/detail/simplify/preprocess.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "faqem/detail/base/buckets.hpp"
#include "faqem/detail/base/portable_math.hpp"
#include "faqem/detail/options/option_table.hpp"
#include "faqem/engine/mesh/weld.hpp"
#include "faqem/error.hpp"
#include "faqem/options.hpp"

FAQEM_DETAIL_BEGIN

using engine::RunContext;

inline bool is_dropped(const Triangle& t) { return t[0] == no_index; }

[[noreturn]] inline void fail(const std::string& element, const std::string& what) {
    throw InputError("", element, what);
}

inline void check_sizes(const MeshView& mesh) {
    if (mesh.positions.size() >= no_index)
        fail("positions", "has " + std::to_string(mesh.positions.size()) + " vertices, more than 2^32 - 2");
    if (mesh.triangles.size() > engine::max_faces)
        fail("triangles", "has " + std::to_string(mesh.triangles.size()) + " faces, more than " +
                              std::to_string(engine::max_faces));
    const auto check_count = [](std::size_t count, std::size_t needed, const char* name,
                                const char* element) {
        if (count == 0 || count == needed) return;
        fail(name, "needs one entry per " + std::string(element) + " or none, but has " +
                       std::to_string(count) + " for " + std::to_string(needed));
    };
    check_count(mesh.face_groups.size(), mesh.triangles.size(), "face_groups", "face");
    check_count(mesh.vertex_locks.size(), mesh.positions.size(), "vertex_locks", "vertex");
    check_count(mesh.vertex_weights.size(), mesh.positions.size(), "vertex_weights", "vertex");
    for (std::size_t v = 0; v < mesh.vertex_weights.size(); ++v) {
        const float weight = mesh.vertex_weights[v];
        if (!(weight >= 1e-6f && weight <= 1e6f))
            fail("vertex " + std::to_string(v), "weight " + number_text(weight) + " is not in [1e-6, 1e6]");
    }
    if (mesh.attributes) {
        const CornerAttributes& a = *mesh.attributes;
        if (a.width == 0 || a.values.size() != std::uint64_t{3} * mesh.triangles.size() * a.width) {
            fail("attributes", "needs width >= 1 and 3 * faces * width values, but has width " +
                                   std::to_string(a.width) + " and " + std::to_string(a.values.size()) +
                                   " values");
        }
        for (std::size_t i = 0; i < a.values.size(); ++i) {
            if (!std::isfinite(a.values[i]))
                fail("attributes, corner " + std::to_string(i / a.width),
                     "value is not finite: " + number_text(a.values[i]));
        }
    }
}

inline std::vector<Vec3> checked_positions(const PositionView& view) {
    std::vector<Vec3> positions(view.size());
    for (std::size_t v = 0; v < positions.size(); ++v) {
        positions[v] = view[v];
        for (const double x : positions[v])
            if (!std::isfinite(x))
                fail("vertex " + std::to_string(v), "position is not finite: " + number_text(x));
    }
    return positions;
}

FAQEM_INLINE std::vector<Index> weld_referenced(const std::vector<Vec3>& positions,
                                                const TriangleView& triangles, double distance) {
    std::vector<std::uint8_t> is_used(positions.size(), 0);
    for (std::size_t f = 0; f < triangles.size(); ++f)
        for (const Index v : triangles[f]) is_used[v] = 1;
    if (std::find(is_used.begin(), is_used.end(), 0) == is_used.end())
        return engine::weld_within(positions, distance);
    std::vector<Index> used, result = engine::all_indices(positions.size());
    std::vector<Vec3> used_positions;
    for (Index v = 0; v < positions.size(); ++v)
        if (is_used[v]) used.push_back(v), used_positions.push_back(positions[v]);
    const std::vector<Index> welded = engine::weld_within(used_positions, distance);
    for (std::size_t i = 0; i < used.size(); ++i) result[used[i]] = used[welded[i]];
    return result;
}

// Moves welded vertices to the position of the first locked vertex in them.
inline void restore_locked_positions(const MeshView& mesh, const std::vector<Vec3>& positions,
                                     PreprocessedMesh& out) {
    for (std::size_t v = mesh.vertex_locks.size(); v-- > 0;)
        if (mesh.vertex_locks[v]) out.positions[out.welded[v]] = positions[v];
}

// Numbers the representatives in input order and maps the triangles to them.
inline void apply_weld(const MeshView& mesh, const std::vector<Vec3>& positions,
                       const std::vector<Index>& representative, PreprocessedMesh& out) {
    std::vector<Index>& welded = out.welded;
    welded.assign(positions.size(), no_index);
    for (Index v = 0; v < positions.size(); ++v) {
        if (representative[v] != v) continue;
        welded[v] = static_cast<Index>(out.positions.size());
        out.positions.push_back(positions[v]);
        out.vertex_origin.push_back(v);
    }
    for (Index v = 0; v < positions.size(); ++v) welded[v] = welded[representative[v]];
    out.triangles.resize(mesh.triangles.size());
    for (std::size_t f = 0; f < out.triangles.size(); ++f) {
        const Triangle t = mesh.triangles[f];
        out.triangles[f] = {welded[t[0]], welded[t[1]], welded[t[2]]};
    }
}

inline void drop_degenerate_faces(PreprocessedMesh& out) {
    for (Triangle& t : out.triangles)
        if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) t = no_corners, ++out.dropped_faces;
}

// Removes faces that have the corners, winding and group of an earlier face, since they are invisible. Faces
// with the same corners and opposite winding are kept.
inline void drop_duplicate_faces(std::span<const Index> groups, PreprocessedMesh& out) {
    // The corners that follow the smallest one, the group and the index of a face.
    using FaceKey = std::array<Index, 4>;
    Buckets<FaceKey> faces(out.positions.size(), [&](auto&& put) {
        for (Index f = 0; f < out.triangles.size(); ++f) {
            Triangle t = out.triangles[f];
            if (is_dropped(t)) continue;
            std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
            put(t[0], {t[1], t[2], groups.empty() ? no_index : groups[f], f});
        }
    });
    for (std::size_t v = 0; v < out.positions.size(); ++v) {
        const auto own = std::span(faces.items()).subspan(faces.begin()[v], faces[v].size());
        std::sort(own.begin(), own.end());
        for (std::size_t i = 1; i < own.size(); ++i) {
            if (!std::equal(own[i].begin(), own[i].end() - 1, own[i - 1].begin())) continue;
            out.triangles[own[i].back()] = no_corners;
            ++out.dropped_faces;
        }
    }
}

// Computes centre and scale from the bounding box of the referenced vertices. Extents are divided by 4 first,
// so that the diagonal does not overflow even for the largest coordinates.
inline void find_scale(double wanted_diagonal, PreprocessedMesh& out) {
    Eigen::AlignedBox3d box;
    for (const Triangle& t : out.triangles) {
        if (is_dropped(t)) continue;
        for (const Index v : t) box.extend(to_eigen(out.positions[v]));
    }
    if (box.isEmpty()) return;
    out.centre = to_array(Vector3(0.5 * box.min() + 0.5 * box.max()));
    const Vector3 quarter = 0.25 * box.max() - 0.25 * box.min();
    const double quarter_diagonal = portable_length(quarter.x(), quarter.y(), quarter.z());
    const double scale = 0.25 * wanted_diagonal / quarter_diagonal;
    if (std::isfinite(scale) && scale > 0) out.scale = scale;
}

FAQEM_INLINE std::vector<Vector3> PreprocessedMesh::engine_positions() const {
    std::vector<Vector3> result;
    result.reserve(positions.size());
    const Vector3 c = to_eigen(centre);
    for (const Vec3& p : positions) result.push_back((to_eigen(p) - c) * scale);
    return result;
}

FAQEM_INLINE Vec3 PreprocessedMesh::to_model(const Vector3& p) const {
    return to_array(Vector3(p / scale + to_eigen(centre)));
}

FAQEM_INLINE PreprocessedMesh preprocess(const MeshView& mesh, const Settings& settings,
                                         const RunContext& context) {
    check_sizes(mesh);
    for (std::size_t f = 0; f < mesh.triangles.size(); ++f)
        check_indices(mesh.triangles[f], f, mesh.positions.size());
    const std::vector<Vec3> positions = checked_positions(mesh.positions);
    PreprocessedMesh out;
    context.check_now();
    const TriangleView welded = settings.weld == Weld::none ? TriangleView() : mesh.triangles;
    apply_weld(mesh, positions, weld_referenced(positions, welded, settings.weld_distance), out);
    context.check_now();
    restore_locked_positions(mesh, positions, out);
    drop_degenerate_faces(out);
    drop_duplicate_faces(mesh.face_groups, out);
    context.check_now();
    find_scale(settings.diagonal, out);
    if (settings.prune)
        out.pruned = prune(out.positions, welded_locks(mesh, out.welded, out.positions.size()),
                           *settings.prune, out.triangles);
    return out;
}

FAQEM_INLINE std::vector<Triangle> unpruned_triangles(const MeshView& mesh, const Options& options,
                                                      const RunContext& context) {
    std::vector<std::uint8_t> is_pruned(mesh.triangles.size(), 0);
    if (options.topology.prune)
        for (const PrunedFace& pruned : preprocess(mesh, settings(options), context).pruned.faces)
            is_pruned[pruned.face] = 1;
    std::vector<Triangle> left;
    for (std::size_t f = 0; f < is_pruned.size(); ++f)
        if (!is_pruned[f]) left.push_back(mesh.triangles[f]);
    return left;
}

FAQEM_INLINE std::vector<std::uint8_t> welded_locks(const MeshView& mesh, std::span<const Index> welded,
                                                    std::size_t vertices) {
    std::vector<std::uint8_t> locked(vertices, 0);
    for (std::size_t v = 0; v < mesh.vertex_locks.size(); ++v)
        if (mesh.vertex_locks[v]) locked[welded[v]] = 1;
    return locked;
}

FAQEM_DETAIL_END

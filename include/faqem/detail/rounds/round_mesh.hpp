#pragma once
/// \file
/// The surface on which memoryless collapses are made in rounds: a corner table in single precision.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "faqem/detail/base/parallel.hpp"
#include "faqem/detail/rounds/block_steps.hpp"
#include "faqem/detail/rounds/kernels.hpp"
#include "faqem/export.hpp"

FAQEM_NAMESPACE_BEGIN
namespace detail {
namespace rounds {

/// Corner k of face f is 4 f + k.
using Corner = std::uint32_t;

inline constexpr float never = std::numeric_limits<float>::infinity();

/// Elements per task of a parallel loop.
inline constexpr std::size_t faces_per_block = 16384;

/// Why vertices do not move: `unfit` ones are on a border, or the surface is not a manifold there.
inline constexpr std::uint32_t user_lock = 1, unfit = 2;

/// One cache line.
struct alignas(64) Vertex {
    std::array<double, 3> p;  ///< engine units
    Planes planes;            ///< of its faces; they pass through the vertex
    std::uint32_t cell;
    std::uint32_t lock = 0;  ///< user_lock, unfit, both, or 0: it may move
    Index slot;              ///< of the input
};

struct Face {
    std::array<Index, 3> v;   ///< no_index in the first: removed
    std::array<Corner, 3> o;  ///< the corner across the edge opposite corner k, or no_index
    Index slot;               ///< of the input
    Index spare = 0;          ///< fills half a cache line
};

inline constexpr unsigned next(unsigned k) { return k == 2 ? 0 : k + 1; }
inline constexpr unsigned previous(unsigned k) { return k == 0 ? 2 : k - 1; }

struct Mesh {
    std::vector<Vertex> vertices;
    std::vector<Face> faces;
    /// Cost of the edge opposite a corner, at the smaller of its two corners; `never` at the other one, at edges
    /// with a locked end, and at edges that were refused since an end moved.
    std::vector<float> keys;
    std::size_t alive = 0;  ///< number of faces
    double area = 0;

    Vector difference(Index from, Index to) const {
        const auto &a = vertices[from].p, &b = vertices[to].p;
        return {static_cast<float>(b[0] - a[0]), static_cast<float>(b[1] - a[1]),
                static_cast<float>(b[2] - a[2])};
    }
};

/// A face as seen from one of its edges: the corner opposite the edge, and the other end than the lower one.
struct HalfEdge {
    std::uint32_t other;  ///< twice the higher end, plus 1 if the face passes the edge towards the lower one
    Corner corner;
};

/// Links the corners of edges that have two faces of opposite direction; locks the ends of all others.
inline void link(Mesh& mesh, const RunContext& context) {
    const std::size_t vertices = mesh.vertices.size();
    std::vector<std::uint32_t> offsets(vertices + 2, 0);
    for (const Face& f : mesh.faces) {
        for (unsigned k = 0; k < 3; ++k) ++offsets[std::min(f.v[k], f.v[next(k)]) + 2];
    }
    for (std::size_t v = 2; v < offsets.size(); ++v) offsets[v] += offsets[v - 1];
    std::vector<HalfEdge> sides(offsets.back());
    for (Index f = 0; f < mesh.faces.size(); ++f) {
        const auto& v = mesh.faces[f].v;
        for (unsigned k = 0; k < 3; ++k) {
            const Index a = v[next(k)], b = v[previous(k)];
            sides[offsets[std::min(a, b) + 1]++] = {2 * std::max(a, b) + (a < b ? 0 : 1), 4 * f + k};
        }
    }
    std::vector<std::uint32_t>& begin = offsets;  // begin[v] is the first side of v
    parallel_blocks(vertices, faces_per_block, context, [&](std::size_t first, std::size_t end) {
        for (std::size_t v = first; v < end; ++v) {
            for (std::uint32_t i = begin[v]; i < begin[v + 1]; ++i) {
                unsigned same = 0;
                Corner match = no_index;
                for (std::uint32_t j = begin[v]; j < begin[v + 1]; ++j) {
                    if (sides[j].other >> 1 != sides[i].other >> 1) continue;
                    ++same;
                    if (sides[j].other != sides[i].other) match = sides[j].corner;
                }
                mesh.faces[sides[i].corner >> 2].o[sides[i].corner & 3] = same == 2 ? match : no_index;
            }
        }
    });
    for (const Face& f : mesh.faces) {
        for (unsigned k = 0; k < 3; ++k) {
            if (f.o[k] == no_index)
                mesh.vertices[f.v[next(k)]].lock |= unfit, mesh.vertices[f.v[previous(k)]].lock |= unfit;
        }
    }
}

/// sqrt(area) x n of a face.
inline Vector root_of(const Mesh& mesh, const Face& f) {
    const Vector n = cross(mesh.difference(f.v[0], f.v[1]), mesh.difference(f.v[0], f.v[2]));
    const float w = std::sqrt(0.5f / std::max(length(n), 1e-30f));
    return {w * n[0], w * n[1], w * n[2]};
}

inline void add_square(const Vector& n, Planes& q) {
    q[0] += n[0] * n[0], q[1] += n[0] * n[1], q[2] += n[0] * n[2];
    q[3] += n[1] * n[1], q[4] += n[1] * n[2], q[5] += n[2] * n[2];
}

/// Sums the planes of all vertices that are not locked, and locks those with several fans of faces.
/// \return root_of() of all faces
inline std::vector<Vector> sum_planes(Mesh& mesh, const RunContext& context) {
    const std::size_t faces = mesh.faces.size();
    std::vector<Vector> roots(faces);
    std::vector<Corner> start(mesh.vertices.size(), no_index);
    std::vector<std::uint32_t> degree(mesh.vertices.size(), 0);
    parallel_blocks(faces, faces_per_block, context, [&](std::size_t first, std::size_t end) {
        for (std::size_t f = first; f < end; ++f) roots[f] = root_of(mesh, mesh.faces[f]);
    });
    mesh.area = 0;
    for (Index f = 0; f < faces; ++f) {
        const auto& n = roots[f];
        mesh.area += static_cast<double>(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
        for (unsigned k = 0; k < 3; ++k) {
            const Index v = mesh.faces[f].v[k];
            ++degree[v];
            if (start[v] == no_index) start[v] = 4 * f + k;
        }
    }
    parallel_blocks(mesh.vertices.size(), faces_per_block, context, [&](std::size_t first, std::size_t end) {
        for (std::size_t v = first; v < end; ++v) {
            Vertex& at = mesh.vertices[v];
            if (at.lock || degree[v] == 0) continue;
            Planes q = {};
            std::uint32_t seen = 0;
            Corner c = start[v];
            do {
                add_square(roots[c >> 2], q);
                const Corner across = mesh.faces[c >> 2].o[next(c & 3)];
                c = (across & ~3u) | next(across & 3);
            } while (++seen < degree[v] && c != start[v]);
            if (seen != degree[v] || c != start[v]) at.lock = unfit;  // several fans
            at.planes = q;
        }
    });
    return roots;
}

/// Computes the keys of all edges.
inline void evaluate_edges(Mesh& mesh, const std::vector<Vector>& roots, const RunContext& context) {
    mesh.keys.resize(4 * mesh.faces.size());
    parallel_blocks(mesh.faces.size(), faces_per_block, context, [&](std::size_t first, std::size_t end) {
        EdgeBatch batch = {};
        Corner waiting[EdgeBatch::size];
        int count = 0;
        const auto flush = [&] {
            solve(batch);
            for (int i = 0; i < count; ++i) mesh.keys[waiting[i]] = batch.cost[i];
            count = 0;
        };
        for (Index f = static_cast<Index>(first); f < end; ++f) {
            const Face& face = mesh.faces[f];
            mesh.keys[4 * f + 3] = never;
            for (unsigned k = 0; k < 3; ++k) {
                const Corner c = 4 * f + k, across = face.o[k];
                mesh.keys[c] = never;
                const Vertex &u = mesh.vertices[face.v[next(k)]], &v = mesh.vertices[face.v[previous(k)]];
                if (across < c || u.lock || v.lock) continue;
                Planes shared = {};
                add_square(roots[f], shared);
                add_square(roots[across >> 2], shared);
                const auto t = mesh.difference(face.v[next(k)], face.v[previous(k)]);
                put(batch, count, u.planes, v.planes, shared, t);
                waiting[count++] = c;
                if (count == EdgeBatch::size) flush();
            }
        }
        flush();
    });
}

/// Makes the mesh, with the costs of all edges. Locked are the vertices that `input` locks, those on a border, and
/// those at which the surface is not a manifold with consistent windings.
inline Mesh load(const BlockInput& input, const RunContext& context) {
    Mesh mesh;
    mesh.vertices.resize(input.positions.size());
    mesh.faces.resize(input.triangles.size());
    mesh.alive = mesh.faces.size();
    const bool has_borders = input.borders && !input.borders->at.empty();
    for (Index v = 0; v < mesh.vertices.size(); ++v) {
        Vertex& at = mesh.vertices[v];
        const engine::Vector3& p = input.positions[v];
        at.p = {p.x(), p.y(), p.z()};
        if (has_borders && input.borders->at[v] != no_index) at.lock = unfit;
        if (input.locked[v]) at.lock |= user_lock;
        at.slot = v;
    }
    for (Index f = 0; f < mesh.faces.size(); ++f) {
        mesh.faces[f].v = {input.triangles[f][0], input.triangles[f][1], input.triangles[f][2]};
        mesh.faces[f].slot = f;
    }
    link(mesh, context);
    evaluate_edges(mesh, sum_planes(mesh, context), context);
    return mesh;
}

/// Removes vertices and faces without use, and sums the planes anew, since small ones are lost in the rounding errors
/// of large ones that were subtracted. O(faces)
inline void compact(Mesh& mesh, const RunContext& context) {
    std::vector<Index> vertex(mesh.vertices.size(), no_index), face(mesh.faces.size(), no_index);
    Index faces = 0, vertices = 0;
    for (Index f = 0; f < mesh.faces.size(); ++f) {
        if (mesh.faces[f].v[0] == no_index) continue;
        face[f] = faces++;
        for (const Index v : mesh.faces[f].v) vertex[v] = 0;
    }
    for (Index v = 0; v < mesh.vertices.size(); ++v) {
        if (vertex[v] == no_index) continue;
        vertex[v] = vertices;
        mesh.vertices[vertices++] = mesh.vertices[v];
    }
    mesh.vertices.resize(vertices);
    for (Index f = 0; f < mesh.faces.size(); ++f) {
        if (face[f] == no_index) continue;
        Face moved = mesh.faces[f];
        for (Index& v : moved.v) v = vertex[v];
        for (Corner& c : moved.o) c = c == no_index ? c : 4 * face[c >> 2] + (c & 3);
        mesh.faces[face[f]] = moved;
        for (unsigned k = 0; k < 4; ++k) mesh.keys[4 * face[f] + k] = mesh.keys[4 * f + k];
    }
    mesh.faces.resize(faces);
    mesh.keys.resize(std::size_t{4} * faces);
    sum_planes(mesh, context);
}

}  // namespace rounds
}  // namespace detail
FAQEM_NAMESPACE_END

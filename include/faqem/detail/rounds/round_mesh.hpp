#pragma once
/// \file
/// The surface on which memoryless collapses are made in rounds: a corner table in single precision.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "faqem/detail/base/parallel.hpp"
#include "faqem/detail/rounds/kernels.hpp"
#include "faqem/detail/rounds/rounds.hpp"
#include "faqem/export.hpp"

FAQEM_NAMESPACE_BEGIN
namespace detail {
namespace rounds {

/// Why vertices do not move: at `unfit` ones straight borders meet, or the surface is not a manifold.
inline constexpr std::uint32_t user_lock = 1, unfit = 2;

/// One cache line.
struct alignas(64) Vertex {
    std::array<double, 3> p;         ///< engine units
    Planes planes;                   ///< of its faces; they pass through the vertex
    std::uint32_t cell;              ///< in sum_planes() the first corner, in compact() the place to move to
    std::uint32_t lock : 2 = 0;      ///< user_lock, unfit, both, or 0: it may move
    std::uint32_t bent : 1 = 0;      ///< has planes along edges; see add_edge_planes()
    std::uint32_t straight : 1 = 0;  ///< on a straight or planar part of a border
    std::uint32_t degree : 28 = 0;   ///< used in sum_planes()
    Index slot;                      ///< of the input; no_index: removed
    Index source;                    ///< the slot of the input with the same position, or no_index
};

struct Face {
    std::array<Index, 3> v;   ///< no_index in the first: removed
    std::array<Corner, 3> o;  ///< the corner across the edge opposite corner k, or no_index at a border
    Index slot;               ///< of the input
    Index place;              ///< in compact(): to move to
};

struct Mesh {
    std::vector<Vertex> vertices;
    std::vector<Face> faces;
    std::vector<float> keys;  ///< three per face; see key()
    std::size_t alive = 0;    ///< number of faces
    std::size_t unfit_vertices = 0;
    double area = 0;
    std::span<const Index> parts;  ///< per slot of the input: the part of a border, see engine::PlanarBorders

    /// Cost of the edge opposite a corner, at the smaller of its two corners; `never` at the other one, at edges
    /// with a locked end, and at edges that were refused since an end moved.
    float& key(Corner c) { return keys[c - (c >> 2)]; }
    float key(Corner c) const { return keys[c - (c >> 2)]; }

    Vector difference(Index from, Index to) const {
        const auto &a = vertices[from].p, &b = vertices[to].p;
        return {static_cast<float>(b[0] - a[0]), static_cast<float>(b[1] - a[1]),
                static_cast<float>(b[2] - a[2])};
    }

    /// Where an edge may collapse to, so that parts of borders stay straight.
    Place place(const Vertex& u, const Vertex& v) const {
        if (!u.straight && !v.straight) return Place::anywhere;
        if (u.straight && v.straight) return parts[u.slot] == parts[v.slot] ? Place::between : Place::nowhere;
        return u.straight ? Place::at_first : Place::at_second;
    }

    /// The corner of the next face around the vertex of corner c, counterclockwise; no_index at a border.
    Corner turned(Corner c) const {
        const Corner across = faces[c >> 2].o[next(c & 3)];
        return across == no_index ? across : (across & ~3u) | next(across & 3);
    }

    /// The most clockwise corner around the vertex of corner c; c itself if there is no border.
    Corner first_of_fan(Corner c) const {
        for (Corner at = c;;) {
            const Corner across = faces[at >> 2].o[previous(at & 3)];
            if (across == no_index) return at;
            at = (across & ~3u) | previous(across & 3);
            if (at == c) return c;
        }
    }
};

template <class T>
void release(std::vector<T>& memory) {
    std::vector<T>().swap(memory);
}

/// sqrt(area) x n of a face.
inline Vector root_of(const Mesh& mesh, const Face& f) {
    const Vector n = cross(mesh.difference(f.v[0], f.v[1]), mesh.difference(f.v[0], f.v[2]));
    const float w = std::sqrt(0.5f / std::max(length(n), 1e-30f));
    return {w * n[0], w * n[1], w * n[2]};
}

/// root_of() by index.
struct Roots {
    const Mesh& mesh;
    Vector operator()(Index f) const { return root_of(mesh, mesh.faces[f]); }
};

inline void add_square(const Vector& n, Planes& q) {
    q[0] += n[0] * n[0], q[1] += n[0] * n[1], q[2] += n[0] * n[2];
    q[3] += n[1] * n[1], q[4] += n[1] * n[2], q[5] += n[2] * n[2];
}

/// Adds the planes along the edge opposite a corner, perpendicular to its faces: at a border, or at a fold with
/// normals more than 120 degrees apart, as at the rim of a thin blade. Factors are those of MemorylessWeights.
/// \param a, b  normals, of any length, of the face of the corner and of the face across the edge if there is one
/// \return whether there are such planes
inline bool add_edge_planes(const Mesh& mesh, Corner c, const Vector& a, const Vector& b, Planes& q) {
    const Face& f = mesh.faces[c >> 2];
    const Corner across = f.o[c & 3];
    const auto add = [&](const Vector& n, float weight) {
        const Vector e = mesh.difference(f.v[next(c & 3)], f.v[previous(c & 3)]), m = cross(e, n);
        const float w = std::sqrt(weight) * length(e) / std::max(length(m), 1e-30f);
        add_square({w * m[0], w * m[1], w * m[2]}, q);
    };
    if (across == no_index) return add(a, 1), true;
    const float along = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    if (!(along < 0 && along < crease_cosine * length(a) * length(b))) return false;
    return add(a, 0.2f), add(b, 0.2f), true;
}

/// \param root_of  gives root_of() of a face
template <class RootOf>
bool add_edge_planes(const Mesh& mesh, Corner c, const RootOf& root_of, Planes& q) {
    const Corner across = mesh.faces[c >> 2].o[c & 3];
    return add_edge_planes(mesh, c, root_of(c >> 2), root_of((across == no_index ? c : across) >> 2), q);
}

/// The faces around a vertex that are reached across edges with two faces, counterclockwise.
struct Fan {
    Planes planes = {};
    std::uint32_t size = 0;
    bool bent = false;     ///< planes along edges are among the planes
    bool is_slit = false;  ///< it is open, and both ends are the same edge
};

/// \param start    see first_of_fan()
/// \param root_of  gives root_of() of a face
template <class RootOf>
Fan fan_of(const Mesh& mesh, Corner start, const RootOf& root_of) {
    Fan fan;
    Corner c = start, last;
    Vector root = root_of(start >> 2);
    do {
        ++fan.size;
        add_square(root, fan.planes);
        last = c;
        c = mesh.turned(c);
        const Vector ahead = root_of((c == no_index ? last : c) >> 2);
        fan.bent |= add_edge_planes(mesh, (last & ~3u) | next(last & 3), root, ahead, fan.planes);
        root = ahead;
    } while (c != no_index && c != start);
    if (c == start) return fan;
    fan.bent |= add_edge_planes(mesh, (start & ~3u) | previous(start & 3), root_of, fan.planes);
    fan.is_slit = mesh.faces[start >> 2].v[next(start & 3)] == mesh.faces[last >> 2].v[previous(last & 3)];
    return fan;
}

/// Sums the planes of all vertices that are not locked, and locks those around which the faces are not one fan.
/// \return root_of() of all faces
inline std::vector<Vector> sum_planes(Mesh& mesh, const RunContext& context) {
    std::vector<Vector> roots(mesh.faces.size());
    parallel_blocks(roots.size(), elements_per_block, context, [&](std::size_t first, std::size_t end) {
        for (std::size_t f = first; f < end; ++f) roots[f] = root_of(mesh, mesh.faces[f]);
    });
    mesh.area = 0;
    for (const auto& n : roots) mesh.area += static_cast<double>(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    for (Index f = static_cast<Index>(roots.size()); f-- > 0;) {
        for (unsigned k = 0; k < 3; ++k) {
            Vertex& at = mesh.vertices[mesh.faces[f].v[k]];
            at.cell = 4 * f + k;
            ++at.degree;
        }
    }
    parallel_blocks(
        mesh.vertices.size(), elements_per_block, context, [&](std::size_t first, std::size_t end) {
            for (std::size_t v = first; v < end; ++v) {
                Vertex& at = mesh.vertices[v];
                if (!at.lock && at.degree > 0) {
                    const Fan fan =
                        fan_of(mesh, mesh.first_of_fan(at.cell), [&](Index f) { return roots[f]; });
                    at.planes = fan.planes;
                    at.bent = fan.bent;
                    if (fan.size < at.degree || fan.is_slit) at.lock = unfit;
                }
                at.degree = 0;
            }
        });
    return roots;
}

/// Computes the keys of the edges of some faces.
inline void evaluate_edges(Mesh& mesh, const std::vector<Vector>& roots, Index first, Index end) {
    EdgeBatch batch = {};
    Corner waiting[EdgeBatch::size];
    int count = 0;
    const auto flush = [&] {
        solve(batch);
        for (int i = 0; i < count; ++i) {
            const Face& f = mesh.faces[waiting[i] >> 2];
            const unsigned k = waiting[i] & 3;
            restrict_to(mesh.place(mesh.vertices[f.v[next(k)]], mesh.vertices[f.v[previous(k)]]), batch, i);
            mesh.key(waiting[i]) = batch.cost[i];
        }
        count = 0;
    };
    for (Index f = first; f < end; ++f) {
        const Face& face = mesh.faces[f];
        for (unsigned k = 0; k < 3; ++k) {
            const Corner c = 4 * f + k, across = face.o[k];
            mesh.key(c) = never;
            const Vertex &u = mesh.vertices[face.v[next(k)]], &v = mesh.vertices[face.v[previous(k)]];
            if (across < c || u.lock || v.lock) continue;
            Planes shared = {};
            add_square(roots[f], shared);
            if (across != no_index) add_square(roots[across >> 2], shared);
            if (u.bent && v.bent)
                add_edge_planes(
                    mesh, c, [&](Index g) { return roots[g]; }, shared);
            const auto t = mesh.difference(face.v[next(k)], face.v[previous(k)]);
            put(batch, count, u.planes, v.planes, shared, t);
            waiting[count++] = c;
            if (count == EdgeBatch::size) flush();
        }
    }
    flush();
}

/// Makes the mesh, with the costs of all edges. Locked are the vertices that `input` locks, those at which straight borders
/// meet, and those at which the surface is not a manifold with consistent windings. Releases the arrays of the input.
/// \return no mesh, and positions and triangles as they were, if more than `most_unfit` vertices are locked that the
///     input does not lock
inline std::optional<Mesh> load(const RoundInput& input, std::size_t most_unfit, const RunContext& context) {
    std::optional<Mesh> made(std::in_place);
    Mesh& mesh = *made;
    mesh.alive = input.triangles.size();
    if (input.links.empty()) input.links = link_corners(input.triangles, input.positions.size(), context);
    mesh.faces.resize(mesh.alive);
    parallel_blocks(mesh.alive, elements_per_block, context, [&](std::size_t first, std::size_t end) {
        for (std::size_t f = first; f < end; ++f)
            mesh.faces[f] = {input.triangles[f], input.links[f], static_cast<Index>(f), 0};
    });
    release(input.links);
    release(input.triangles);
    mesh.vertices.resize(input.positions.size());
    if (input.borders) mesh.parts = input.borders->at;
    parallel_blocks(mesh.vertices.size(), elements_per_block, context,
                    [&](std::size_t first, std::size_t end) {
                        for (std::size_t v = first; v < end; ++v) {
                            Vertex& at = mesh.vertices[v];
                            at.p = engine::to_array(input.positions[v]);
                            const Index part = mesh.parts.empty() ? no_index : mesh.parts[v];
                            at.straight = part != no_index;
                            if (part == engine::PlanarBorders::corner) at.lock = unfit;
                            if (input.locked[v]) at.lock |= user_lock;
                            at.slot = at.source = static_cast<Index>(v);
                        }
                    });
    const std::vector<Vector> roots = sum_planes(mesh, context);
    for (const Vertex& v : mesh.vertices) mesh.unfit_vertices += v.lock == unfit;
    if (mesh.unfit_vertices > most_unfit) {
        input.triangles.reserve(mesh.alive);
        for (const Face& f : mesh.faces) input.triangles.push_back(f.v);
        return {};
    }
    release(input.positions);
    mesh.keys.resize(3 * mesh.alive);
    parallel_blocks(mesh.alive, elements_per_block, context, [&](std::size_t first, std::size_t end) {
        vectorised([&] { evaluate_edges(mesh, roots, static_cast<Index>(first), static_cast<Index>(end)); });
    });
    return made;
}

/// Removes vertices and faces without use. O(faces)
inline void compact(Mesh& mesh, const RunContext& context) {
    Index vertices = 0, faces = 0;
    for (Vertex& v : mesh.vertices) {
        if (v.slot != no_index) v.cell = vertices++;
    }
    for (Face& f : mesh.faces) {
        if (f.v[0] != no_index) f.place = faces++;
    }
    parallel_blocks(mesh.faces.size(), elements_per_block, context, [&](std::size_t first, std::size_t end) {
        for (std::size_t i = first; i < end; ++i) {
            Face& f = mesh.faces[i];
            if (f.v[0] == no_index) continue;
            for (Index& v : f.v) v = mesh.vertices[v].cell;
            for (Corner& c : f.o) c = c == no_index ? c : 4 * mesh.faces[c >> 2].place + (c & 3);
        }
    });
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
        const Vertex moved = mesh.vertices[v];
        if (moved.slot != no_index) mesh.vertices[moved.cell] = moved;
    }
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
        const Face moved = mesh.faces[f];
        if (moved.v[0] == no_index) continue;
        for (unsigned k = 0; k < 3; ++k) mesh.keys[3 * moved.place + k] = mesh.keys[3 * f + k];
        mesh.faces[moved.place] = moved;
    }
    mesh.vertices.resize(vertices);
    mesh.faces.resize(faces);
    mesh.keys.resize(std::size_t{3} * faces);
}

/// The surface of a mesh without unused elements.
/// \param slots  number of vertex slots of the input
inline CompactedMesh surface_of(const Mesh& mesh, std::size_t slots) {
    CompactedMesh out;
    out.vertex_map.assign(slots, no_index);
    for (Index v = 0; v < mesh.vertices.size(); ++v) {
        const Vertex& at = mesh.vertices[v];
        out.vertex_map[at.slot] = v;
        out.vertices.push_back(at.slot);
        out.source_slots.push_back(at.source);
        out.positions.push_back(engine::to_eigen(at.p));
    }
    for (const Face& f : mesh.faces) {
        out.faces.push_back(f.slot);
        out.triangles.push_back(f.v);
    }
    return out;
}

}  // namespace rounds
}  // namespace detail
FAQEM_NAMESPACE_END

#pragma once
/// \file
/// The surface on which memoryless collapses are made in rounds: a corner table in single precision.

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "faqem/detail/base/parallel.hpp"
#include "faqem/detail/rounds/kernels.hpp"
#include "faqem/detail/rounds/rounds.hpp"
#include "faqem/export.hpp"

FAQEM_DETAIL_BEGIN
namespace rounds {

inline constexpr float never = std::numeric_limits<float>::infinity();

/// Why vertices do not move: `unfit` ones are on a border, at a fold or a narrow face, or where the surface is not a
/// manifold.
inline constexpr std::uint32_t user_lock = 1, unfit = 2;

/// One cache line.
struct alignas(64) Vertex {
    std::array<double, 3> p;        ///< engine units
    Planes planes;                  ///< of its faces; they pass through the vertex
    std::uint32_t cell;             ///< in sum_planes() the first corner, in compact() the place to move to
    std::uint32_t lock : 2 = 0;     ///< user_lock, unfit, both, or 0: it may move
    std::uint32_t degree : 30 = 0;  ///< used in sum_planes()
    Index slot;                     ///< of the input; no_index: removed
    Index source;                   ///< the slot of the input with the same position, or no_index
};

struct Face {
    std::array<Index, 3> v;   ///< no_index in the first: removed
    std::array<Corner, 3> o;  ///< the corner across the edge opposite corner k, or no_index
    Index slot;               ///< of the input
    Index place;              ///< in compact(): to move to
};

struct Mesh {
    std::vector<Vertex> vertices;
    std::vector<Face> faces;
    std::vector<float> keys;  ///< three per face; see key()
    /// One per face of the input: 1 if its winding is reversed here. May be empty if none is.
    std::vector<std::uint8_t> reversed;
    /// One per vertex of the input: what it was merged into, or no_index. Empty: not recorded.
    std::vector<Index> merged_into;
    std::size_t alive = 0;  ///< number of faces
    std::size_t unfit = 0;  ///< number of vertices that cannot move though the input does not lock them
    double area = 0;        ///< in engine units
    /// Null, or the surface whose vertices are bound to faces: then first_bound has one entry per face, next_bound one per
    /// vertex of `original`, which are linked lists.
    const engine::OriginalSurface* original = nullptr;
    std::vector<Index> first_bound, next_bound;
    float distance_weight = 0;  ///< of a squared distance in the units of single precision
    /// Factors from engine units to those of single precision, in which edges are about 1 long, and back. Powers of two.
    double scale = 1, unit = 1;

    /// Cost of the edge opposite a corner, at the smaller of its two corners; `never` at the other one, at edges
    /// with a locked end, and at edges that were refused since an end moved.
    float& key(Corner c) { return keys[c - (c >> 2)]; }
    float key(Corner c) const { return keys[c - (c >> 2)]; }

    /// The corners of a face in the winding of the input.
    Triangle triangle(const Face& f) const {
        return reversed.empty() || !reversed[f.slot] ? f.v : Triangle{f.v[0], f.v[2], f.v[1]};
    }

    Vector difference(Index from, Index to) const {
        const auto &a = vertices[from].p, &b = vertices[to].p;
        return {static_cast<float>((b[0] - a[0]) * scale), static_cast<float>((b[1] - a[1]) * scale),
                static_cast<float>((b[2] - a[2]) * scale)};
    }
};

template <class T>
void release(std::vector<T>& memory) {
    std::vector<T>().swap(memory);
}

/// sqrt(area) x n of a face; 0 if it is narrow.
inline Vector root_of(const Mesh& mesh, const Face& f) {
    const Vector a = mesh.difference(f.v[0], f.v[1]), b = mesh.difference(f.v[0], f.v[2]),
                 c = mesh.difference(f.v[1], f.v[2]), n = cross(a, b);
    const float longest = std::max({dot(a, a), dot(b, b), dot(c, c)});
    if (!(dot(n, n) > narrow * longest * longest)) return {};
    const float w = std::sqrt(0.5f / std::max(length(n), 1e-30f));
    return {w * n[0], w * n[1], w * n[2]};
}

/// Whether two neighbouring faces, given by root_of(), are such that the vertices between them cannot move: a face is
/// narrow, or the normals are more than 120 degrees apart, as at the rim of a thin blade, which planes of faces do not
/// preserve.
inline bool is_unfit(const Vector& a, const Vector& b) {
    const float ab = dot(a, b);
    if (ab > 0) return false;
    const float aa = dot(a, a), bb = dot(b, b);
    return !(aa > 0) || !(bb > 0) || ab * ab > 0.25f * aa * bb;
}

inline void add_square(const Vector& n, Planes& q) {
    q[0] += n[0] * n[0], q[1] += n[0] * n[1], q[2] += n[0] * n[2];
    q[3] += n[1] * n[1], q[4] += n[1] * n[2], q[5] += n[2] * n[2];
}

/// Sets the scale by the median of the longest edges of some faces: a stray face may be far larger or smaller.
inline void set_scale(Mesh& mesh) {
    const std::size_t step = (mesh.faces.size() / 4096) | 1;
    std::vector<double> squares;
    for (std::size_t f = 0; f < mesh.faces.size(); f += step) {
        double longest = 0;
        for (unsigned k = 0; k < 3; ++k) {
            const Vertex &a = mesh.vertices[mesh.faces[f].v[k]], &b = mesh.vertices[mesh.faces[f].v[next(k)]];
            longest = std::max(longest, (engine::to_eigen(a.p) - engine::to_eigen(b.p)).squaredNorm());
        }
        squares.push_back(longest);
    }
    const auto median = squares.begin() + static_cast<std::ptrdiff_t>(squares.size() / 2);
    std::nth_element(squares.begin(), median, squares.end());
    if (!(*median > 0)) return;
    const int exponent = std::ilogb(*median) / 2;
    mesh.scale = std::ldexp(1.0, -exponent);
    mesh.unit = std::ldexp(1.0, exponent);
}

/// Sums the planes of all vertices that are not locked, and locks those around which the faces are not
/// one closed fan or two neighbours are unfit.
/// \return root_of() of all faces
inline std::vector<Vector> sum_planes(Mesh& mesh, const RunContext& context) {
    std::vector<Vector> roots(mesh.faces.size());
    parallel_each(roots.size(), elements_per_block, context,
                  [&](std::size_t f) { roots[f] = root_of(mesh, mesh.faces[f]); });
    mesh.area = 0;
    for (const auto& n : roots) mesh.area += static_cast<double>(dot(n, n));
    mesh.area *= mesh.unit * mesh.unit;
    for (Index f = static_cast<Index>(roots.size()); f-- > 0;) {
        for (unsigned k = 0; k < 3; ++k) {
            Vertex& at = mesh.vertices[mesh.faces[f].v[k]];
            at.cell = 4 * f + k;
            ++at.degree;
        }
    }
    parallel_each(mesh.vertices.size(), elements_per_block, context, [&](std::size_t v) {
        Vertex& at = mesh.vertices[v];
        at.planes = {};
        bool is_fit = true;
        Corner c = at.lock ? no_index : at.cell;
        while (c != no_index) {
            --at.degree;
            add_square(roots[c >> 2], at.planes);
            const Corner across = mesh.faces[c >> 2].o[next(c & 3)];
            if (across != no_index && is_unfit(roots[c >> 2], roots[across >> 2])) is_fit = false;
            c = across == no_index ? no_index : (across & ~3u) | next(across & 3);
            if (c == at.cell) break;
        }
        // Without a last corner there is a border; with corners left there are several fans.
        if (!at.lock && (c == no_index || at.degree > 0 || !is_fit)) at.lock = unfit;
        at.degree = 0;
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
        for (int i = 0; i < count; ++i) mesh.key(waiting[i]) = batch.cost[i];
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
            add_square(roots[across >> 2], shared);
            const auto t = mesh.difference(face.v[next(k)], face.v[previous(k)]);
            put(batch, count, u.planes, v.planes, shared, t);
            waiting[count++] = c;
            if (count == EdgeBatch::size) flush();
        }
    }
    flush();
}

/// Finds windings for which neighbours agree: those of the first face of each component. O(faces)
/// \return one per face: 1 if its winding has to be reversed
inline std::vector<std::uint8_t> reversed_faces(std::span<const Triangle> triangles,
                                                std::span<const Links> links) {
    constexpr std::uint8_t unknown = 2;
    std::vector<std::uint8_t> reversed(triangles.size(), unknown);
    std::vector<Index> found;
    for (Index first = 0; first < reversed.size(); ++first) {
        if (reversed[first] != unknown) continue;
        reversed[first] = 0;
        for (found.push_back(first); !found.empty();) {
            const Index f = found.back();
            found.pop_back();
            for (unsigned k = 0; k < 3; ++k) {
                const Corner across = links[f][k];
                if (across == no_index || reversed[across >> 2] != unknown) continue;
                reversed[across >> 2] = reversed[f] ^ !have_one_winding(triangles, 4 * f + k, across);
                found.push_back(across >> 2);
            }
        }
    }
    return reversed;
}

/// A face with the winding that Mesh::reversed gives it. Edges between groups have no links, nor those whose faces still
/// differ, as a Moebius strip has.
inline Face face_of(Index f, const RoundInput& input, const std::vector<std::uint8_t>& reversed) {
    Face face{input.triangles[f], input.links[f], f, 0};
    const auto is_reversed = [&](Index g) { return !reversed.empty() && reversed[g]; };
    for (unsigned k = 0; k < 3; ++k) {
        Corner& c = face.o[k];
        if (c == no_index) continue;
        const Index g = c >> 2;
        const bool agrees = have_one_winding(input.triangles, 4 * f + k, c);
        if (agrees != (is_reversed(f) == is_reversed(g)) ||
            (!input.groups.empty() && input.groups[f] != input.groups[g]))
            c = no_index;
        else if (is_reversed(g) && (c & 3) != 0)
            c ^= 3;
    }
    if (is_reversed(f)) std::swap(face.v[1], face.v[2]), std::swap(face.o[1], face.o[2]);
    return face;
}

/// Makes the mesh, with the costs of all edges. Locked are the vertices that `input` locks, and the
/// unfit ones. Releases the arrays of the input.
/// \return no mesh, and positions and triangles as they were, if more than `most_unfit` vertices are unfit
inline std::optional<Mesh> load(const RoundInput& input, std::size_t most_unfit, const RunContext& context) {
    std::optional<Mesh> made(std::in_place);
    Mesh& mesh = *made;
    mesh.alive = input.triangles.size();
    if (input.links.empty()) input.links = link_corners(input.triangles, input.positions.size(), context);
    mesh.faces.resize(mesh.alive);
    std::atomic<bool> lacks_links = false;  // because of windings or groups
    const auto set_faces = [&] {
        parallel_each(mesh.alive, elements_per_block, context, [&](std::size_t f) {
            mesh.faces[f] = face_of(static_cast<Index>(f), input, mesh.reversed);
            if (mesh.reversed.empty() && mesh.faces[f].o != input.links[f]) lacks_links = true;
        });
    };
    set_faces();
    if (lacks_links) {
        mesh.reversed = reversed_faces(input.triangles, input.links);
        set_faces();
    }
    release(input.links);
    release(input.triangles);
    mesh.vertices.resize(input.positions.size());
    const bool has_borders = input.borders && !input.borders->at.empty();
    parallel_each(mesh.vertices.size(), elements_per_block, context, [&](std::size_t v) {
        Vertex& at = mesh.vertices[v];
        at.p = engine::to_array(input.positions[v]);
        if (has_borders && input.borders->at[v] != no_index) at.lock = unfit;
        if (input.locked[v]) at.lock |= user_lock;
        at.slot = at.source = static_cast<Index>(v);
    });
    set_scale(mesh);
    const std::vector<Vector> roots = sum_planes(mesh, context);
    mesh.unfit = static_cast<std::size_t>(std::count_if(mesh.vertices.begin(), mesh.vertices.end(),
                                                        [](const Vertex& v) { return v.lock == unfit; }));
    if (mesh.unfit > most_unfit) {
        input.triangles.reserve(mesh.alive);
        for (const Face& f : mesh.faces) input.triangles.push_back(mesh.triangle(f));
        return {};
    }
    release(input.positions);
    mesh.keys.resize(3 * mesh.alive);
    parallel_blocks(mesh.alive, elements_per_block, context, [&](std::size_t first, std::size_t end) {
        engine::vectorised(
            [&] { evaluate_edges(mesh, roots, static_cast<Index>(first), static_cast<Index>(end)); });
    });
    return made;
}

/// Removes vertices and faces without use. O(faces)
inline void compact(Mesh& mesh, const RunContext& context) {
    Index vertices = 0, faces = 0;
    for (Vertex& v : mesh.vertices)
        if (v.slot != no_index) v.cell = vertices++;
    for (Face& f : mesh.faces)
        if (f.v[0] != no_index) f.place = faces++;
    parallel_each(mesh.faces.size(), elements_per_block, context, [&](std::size_t i) {
        Face& f = mesh.faces[i];
        if (f.v[0] == no_index) return;
        for (Index& v : f.v) v = mesh.vertices[v].cell;
        for (Corner& c : f.o) c = c == no_index ? c : 4 * mesh.faces[c >> 2].place + (c & 3);
    });
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
        const Vertex moved = mesh.vertices[v];
        if (moved.slot != no_index) mesh.vertices[moved.cell] = moved;
    }
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
        const Face moved = mesh.faces[f];
        if (moved.v[0] == no_index) continue;
        for (unsigned k = 0; k < 3; ++k) mesh.keys[3 * moved.place + k] = mesh.keys[3 * f + k];
        if (mesh.original) mesh.first_bound[moved.place] = mesh.first_bound[f];
        mesh.faces[moved.place] = moved;
    }
    mesh.vertices.resize(vertices);
    mesh.faces.resize(faces);
    mesh.keys.resize(std::size_t{3} * faces);
    if (mesh.original) mesh.first_bound.resize(faces);
}

/// For each vertex slot of the input, the vertex of a compact mesh that it was merged into, or no_index. O(slots)
/// \param slots  number of vertex slots of the input
inline std::vector<Index> merged_vertices(const Mesh& mesh, std::size_t slots) {
    std::vector<Index> now(slots, no_index);
    for (Index v = 0; v < mesh.vertices.size(); ++v) now[mesh.vertices[v].slot] = v;
    for (Index v = 0; v < mesh.merged_into.size(); ++v) {
        // Each vertex on the way to a known one becomes known, so that long chains are walked once.
        Index known = v;
        while (now[known] == no_index) known = mesh.merged_into[known];
        for (Index at = v; at != known; at = mesh.merged_into[at]) now[at] = now[known];
    }
    return now;
}

/// The surface of a compact mesh.
/// \param slots  number of vertex slots of the input
inline CompactedMesh surface_of(const Mesh& mesh, std::size_t slots) {
    CompactedMesh out;
    out.vertex_map = merged_vertices(mesh, slots);
    for (const Vertex& at : mesh.vertices) {
        out.vertices.push_back(at.slot);
        out.source_slots.push_back(at.source);
        out.positions.push_back(engine::to_eigen(at.p));
    }
    for (const Face& f : mesh.faces) {
        out.faces.push_back(f.slot);
        out.triangles.push_back(mesh.triangle(f));
    }
    return out;
}

}  // namespace rounds
FAQEM_DETAIL_END

#pragma once
/// \file
/// Small meshes for tests, and brute-force queries on meshes.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "faqem/engine/mesh/collapse_mesh.hpp"
#include "faqem/engine/mesh/pair_table.hpp"
#include "faqem/mesh.hpp"

namespace faqem::test {

inline const double pi = std::acos(-1.0);
inline constexpr double infinity = std::numeric_limits<double>::infinity();

/// The entry of a face that was removed.
inline constexpr Triangle removed_face = {no_index, no_index, no_index};

/// The vertices of an edge or a pair in ascending order.
using Ends = std::pair<Index, Index>;

inline Ends ends(Index a, Index b) { return std::minmax(a, b); }

/// Random numbers that are the same with every standard library.
class Random {
public:
    explicit Random(std::uint32_t seed) : bits_(seed) {}
    /// In [0, 1).
    double unit() { return static_cast<double>(bits_()) / 4294967296.0; }
    double between(double low, double high) { return low + (high - low) * unit(); }
    /// In [0, size).
    Index below(std::size_t size) { return static_cast<Index>(bits_() % size); }

private:
    std::mt19937 bits_;
};

inline TriangleMesh make(std::vector<Vec3> positions, std::vector<Triangle> triangles) {
    TriangleMesh mesh;
    mesh.positions = std::move(positions);
    mesh.triangles = std::move(triangles);
    return mesh;
}

/// The positions of a mesh as Eigen vectors.
inline std::vector<engine::Vector3> vectors(const TriangleMesh& mesh) {
    std::vector<engine::Vector3> all;
    for (const Vec3& p : mesh.positions) all.push_back(engine::to_eigen(p));
    return all;
}

/// The tetrahedron of the origin and the three unit vectors, with outward normals.
inline TriangleMesh tetrahedron() {
    return make({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}});
}

/// The cube [0, 1]^3 with twelve triangles; the vertex at (x, y, z) has index x + 2 y + 4 z.
inline TriangleMesh cube() {
    return make({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {1, 1, 1}},
                {{0, 2, 3},
                 {0, 3, 1},
                 {4, 5, 7},
                 {4, 7, 6},
                 {0, 1, 5},
                 {0, 5, 4},
                 {2, 6, 7},
                 {2, 7, 3},
                 {0, 4, 6},
                 {0, 6, 2},
                 {1, 3, 7},
                 {1, 7, 5}});
}

/// n x n unit squares in the plane z = 0; the vertex at (x, y) has index x + (n + 1) y. The diagonal of each
/// square is from its lower left to its upper right vertex.
inline TriangleMesh grid(Index n) {
    TriangleMesh mesh;
    for (Index y = 0; y <= n; ++y) {
        for (Index x = 0; x <= n; ++x) mesh.positions.push_back({double(x), double(y), 0});
    }
    for (Index y = 0; y < n; ++y) {
        for (Index x = 0; x < n; ++x) {
            const Index v = x + (n + 1) * y;
            mesh.triangles.push_back({v, v + 1, v + n + 2});
            mesh.triangles.push_back({v, v + n + 2, v + n + 1});
        }
    }
    return mesh;
}

/// grid(n) scaled to the square [0, side]^2 at z = height.
inline TriangleMesh square(Index n, double side, double height) {
    TriangleMesh mesh = grid(n);
    for (Vec3& p : mesh.positions) p = {side * p[0] / n, side * p[1] / n, height};
    return mesh;
}

/// grid(n) at z = height, then a copy of it below, at z = -height and turned over, with the same vertices on the rim. Copies
/// of these on the rim have no faces.
inline TriangleMesh two_layers(Index n, double height) {
    TriangleMesh mesh = grid(n);
    const auto shift = static_cast<Index>(mesh.positions.size());
    const auto is_rim = [&](Index v) { return v % (n + 1) % n == 0 || v / (n + 1) % n == 0; };
    for (const Triangle& t : grid(n).triangles) {
        const auto below = [&](Index v) { return is_rim(v) ? v : v + shift; };
        mesh.triangles.push_back({below(t[0]), below(t[2]), below(t[1])});
    }
    for (Index v = 0; v < shift; ++v) {
        Vec3& p = mesh.positions[v];
        if (!is_rim(v)) p[2] = height;
        mesh.positions.push_back({p[0], p[1], -p[2]});
    }
    return mesh;
}

/// A sphere around the origin of rings x 2 rings quads of two triangles, with outward normals. Each pole
/// consists of many vertices at the same position.
inline TriangleMesh globe(Index rings, double radius) {
    TriangleMesh mesh;
    const Index segments = 2 * rings;
    for (Index i = 0; i <= rings; ++i) {
        const double t = pi * i / rings;
        const double ring = i % rings == 0 ? 0 : radius * std::sin(t);
        for (Index j = 0; j < segments; ++j) {
            const double s = 2 * pi * j / segments;
            mesh.positions.push_back({ring * std::cos(s), ring * std::sin(s), radius * std::cos(t)});
            if (i == rings) continue;
            const Index a = i * segments + j, b = i * segments + (j + 1) % segments;
            mesh.triangles.push_back({a, a + segments, b});
            mesh.triangles.push_back({b, a + segments, b + segments});
        }
    }
    return mesh;
}

/// A disc of n triangles around vertex 0; its boundary is on the unit circle.
inline TriangleMesh fan(Index n) {
    TriangleMesh mesh;
    mesh.positions.push_back({0, 0, 0});
    for (Index i = 0; i < n; ++i) {
        mesh.positions.push_back({std::cos(2 * pi * i / n), std::sin(2 * pi * i / n), 0});
        mesh.triangles.push_back({0, 1 + i, 1 + (i + 1) % n});
    }
    return mesh;
}

/// An open cylinder of unit radius along z with outward normals; vertex i of a ring has index i + n * ring.
inline TriangleMesh cylinder(Index n, Index rings, double height) {
    TriangleMesh mesh;
    for (Index r = 0; r <= rings; ++r) {
        for (Index i = 0; i < n; ++i) {
            mesh.positions.push_back(
                {std::cos(2 * pi * i / n), std::sin(2 * pi * i / n), height * r / rings});
            if (r == rings) continue;
            const Index a = i + n * r, b = (i + 1) % n + n * r;
            mesh.triangles.push_back({a, b, b + n});
            mesh.triangles.push_back({a, b + n, a + n});
        }
    }
    return mesh;
}

/// The unit sphere: an icosahedron whose faces are split into four `level` times.
inline TriangleMesh icosphere(int level) {
    const double g = (1 + std::sqrt(5.0)) / 2;
    TriangleMesh mesh =
        make({{-1, g, 0},
              {1, g, 0},
              {-1, -g, 0},
              {1, -g, 0},
              {0, -1, g},
              {0, 1, g},
              {0, -1, -g},
              {0, 1, -g},
              {g, 0, -1},
              {g, 0, 1},
              {-g, 0, -1},
              {-g, 0, 1}},
             {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
              {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
              {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}});
    for (; level > 0; --level) {
        std::map<std::pair<Index, Index>, Index> middle;
        std::vector<Triangle> finer;
        const auto between = [&](Index a, Index b) {
            const auto [at, fresh] =
                middle.try_emplace(std::minmax(a, b), static_cast<Index>(mesh.positions.size()));
            if (fresh) {
                const Vec3 p = mesh.positions[a], q = mesh.positions[b];
                mesh.positions.push_back({(p[0] + q[0]) / 2, (p[1] + q[1]) / 2, (p[2] + q[2]) / 2});
            }
            return at->second;
        };
        for (const auto [a, b, c] : mesh.triangles) {
            const Index ab = between(a, b), bc = between(b, c), ca = between(c, a);
            finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
        }
        mesh.triangles = finer;
    }
    for (Vec3& p : mesh.positions) {
        const double r = std::hypot(p[0], p[1], p[2]);
        p = {p[0] / r, p[1] / r, p[2] / r};
    }
    return mesh;
}

/// A torus with major radius 1 and minor radius 0.4, of m x n quads of two triangles.
inline TriangleMesh torus(Index m, Index n) {
    TriangleMesh mesh;
    for (Index i = 0; i < m; ++i) {
        for (Index j = 0; j < n; ++j) {
            const double a = 2 * pi * i / m, b = 2 * pi * j / n, r = 1 + 0.4 * std::cos(b);
            mesh.positions.push_back({r * std::cos(a), r * std::sin(a), 0.4 * std::sin(b)});
            const Index p = i * n + j, q = i * n + (j + 1) % n;
            const Index s = (i + 1) % m * n + j, t = (i + 1) % m * n + (j + 1) % n;
            mesh.triangles.push_back({p, s, t});
            mesh.triangles.push_back({p, t, q});
        }
    }
    return mesh;
}

/// A Moebius strip of `around` x `across` quads.
inline TriangleMesh moebius(Index around, Index across) {
    TriangleMesh mesh;
    for (Index i = 0; i < around; ++i) {
        for (Index j = 0; j <= across; ++j) {
            const double a = 2 * pi * i / around, v = 0.5 * (double(j) / across - 0.5);
            const double r = 1 + v * std::cos(a / 2);
            mesh.positions.push_back({r * std::cos(a), r * std::sin(a), v * std::sin(a / 2)});
        }
    }
    const auto vertex = [&](Index i, Index j) { return i < around ? i * (across + 1) + j : across - j; };
    for (Index i = 0; i < around; ++i) {
        for (Index j = 0; j < across; ++j) {
            mesh.triangles.push_back({vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1)});
            mesh.triangles.push_back({vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1)});
        }
    }
    return mesh;
}

/// A unit square:    3 - 2
///                   | / |
///                   0 - 1
inline TriangleMesh quad() {
    return make({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}});
}

/// The arrays of quad().
inline const std::vector<engine::Vector3> quad_positions = vectors(quad());
inline const std::vector<Triangle> quad_faces = quad().triangles;

/// Two triangles of which 0 1 2 is kept when vertices 2 and 3 are merged.
inline TriangleMesh hinge() {
    return make({{0, 0, 0}, {2, 0, 0}, {1, 1, 0}, {3, 1, 0}}, {{0, 1, 2}, {1, 3, 2}});
}

/// Two triangles that share only vertex 0.
inline TriangleMesh bow_tie() {
    return make({{0, 0, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, {-1, -1, 0}}, {{0, 1, 2}, {0, 3, 4}});
}

/// Three triangles that share the edge 0-1.
inline TriangleMesh book() {
    return make({{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {-1, 1, 0}, {-1, -1, 0}},
                {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}});
}

/// Random faces over random vertices, with non-manifold edges and duplicate faces; corners of a face are
/// distinct.
inline TriangleMesh soup(std::uint32_t seed, std::size_t vertices, std::size_t faces) {
    Random random(seed);
    TriangleMesh mesh;
    for (std::size_t v = 0; v < vertices; ++v) {
        mesh.positions.push_back({random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)});
    }
    while (mesh.triangles.size() < faces) {
        const Triangle t = {random.below(vertices), random.below(vertices), random.below(vertices)};
        if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) mesh.triangles.push_back(t);
    }
    return mesh;
}

/// A copy of the mesh with random offsets in [-amount, amount] along each axis.
inline TriangleMesh shaken(TriangleMesh mesh, double amount, std::uint32_t seed) {
    Random random(seed);
    for (Vec3& p : mesh.positions) {
        for (double& x : p) x += random.between(-amount, amount);
    }
    return mesh;
}

/// A sphere without symmetries: every vertex of icosphere(level) is moved a little.
inline TriangleMesh lump(int level) { return shaken(icosphere(level), 0.01, 3); }

inline TriangleMesh moved(TriangleMesh mesh, const Vec3& by) {
    for (Vec3& p : mesh.positions) p = {p[0] + by[0], p[1] + by[1], p[2] + by[2]};
    return mesh;
}

inline TriangleMesh scaled(TriangleMesh mesh, double by) {
    for (Vec3& p : mesh.positions) p = {p[0] * by, p[1] * by, p[2] * by};
    return mesh;
}

inline TriangleMesh inside_out(TriangleMesh mesh) {
    for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
    return mesh;
}

/// Both meshes in one, the vertices and faces of `b` after those of `a`.
inline TriangleMesh both(TriangleMesh a, const TriangleMesh& b) {
    const auto first = static_cast<Index>(a.positions.size());
    a.positions.insert(a.positions.end(), b.positions.begin(), b.positions.end());
    for (const auto [p, q, r] : b.triangles) a.triangles.push_back({p + first, q + first, r + first});
    return a;
}

/// The mesh with three vertices of its own for each face.
inline TriangleMesh separated(const TriangleMesh& mesh) {
    TriangleMesh result;
    for (const auto& [a, b, c] : mesh.triangles) {
        const auto first = static_cast<Index>(result.positions.size());
        for (const Index v : {a, b, c}) result.positions.push_back(mesh.positions[v]);
        result.triangles.push_back({first, first + 1, first + 2});
    }
    return result;
}

/// The cube [0, 1]^3 with n x n squares of two triangles on each side, two sides for each axis. Sides have no common
/// vertices; normals are outward.
inline TriangleMesh fine_cube(Index n) {
    TriangleMesh mesh;
    for (const int axis : {0, 1, 2}) {
        for (const double height : {0.0, 1.0}) {
            TriangleMesh side = square(n, 1, height);
            for (Vec3& p : side.positions) std::rotate(p.begin(), p.begin() + (2 - axis), p.end());
            mesh = both(std::move(mesh), height > 0 ? side : inside_out(side));
        }
    }
    return mesh;
}

inline engine::CollapseMesh collapse_mesh_of(const TriangleMesh& mesh) {
    std::vector<engine::Vector3> positions;
    for (const Vec3& p : mesh.positions) positions.push_back(engine::to_eigen(p));
    return {positions, mesh.triangles};
}

/// The pair of vertices u and v, in any order; no_index if there is none.
inline Index pair_of(const engine::PairTable& pairs, Index u, Index v) {
    Index found = no_index;
    pairs.for_each_pair(u, [&](engine::Neighbour n) {
        if (n.vertex == v) found = n.pair;
    });
    return found;
}

/// Number of faces of each edge; the smaller vertex comes first.
using Edges = std::map<std::pair<Index, Index>, std::uint32_t>;

inline Edges edges(const std::vector<Triangle>& triangles) {
    Edges found;
    for (const Triangle& t : triangles) {
        if (t[0] == no_index) continue;
        for (unsigned i = 0; i < 3; ++i) ++found[std::minmax(t[i], t[(i + 1) % 3])];
    }
    return found;
}

/// Euler characteristic: referenced vertices minus edges plus faces.
inline int euler(const std::vector<Triangle>& triangles) {
    std::set<Index> used;
    for (const Triangle& t : triangles) used.insert(t.begin(), t.end());
    return static_cast<int>(used.size()) - static_cast<int>(edges(triangles).size()) +
           static_cast<int>(triangles.size());
}

/// True if every edge has exactly two faces.
inline bool closed_manifold(const std::vector<Triangle>& triangles) {
    const Edges all = edges(triangles);
    return std::all_of(all.begin(), all.end(), [](const auto& edge) { return edge.second == 2; });
}

/// Barycentric coordinates of a regular grid over a triangle, including its edges and corners.
/// \param n  number of intervals along an edge, > 0
inline std::vector<Vec3> spread(int n) {
    std::vector<Vec3> result;
    for (int i = 0; i <= n; ++i) {
        for (int j = 0; i + j <= n; ++j)
            result.push_back({i / double(n), j / double(n), (n - i - j) / double(n)});
    }
    return result;
}

inline Vec3 minus(const Vec3& a, const Vec3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

/// Normal of a face whose length is twice the area.
inline Vec3 normal(const TriangleMesh& mesh, const Triangle& t) {
    const Vec3 e = minus(mesh.positions[t[1]], mesh.positions[t[0]]);
    const Vec3 f = minus(mesh.positions[t[2]], mesh.positions[t[0]]);
    return {e[1] * f[2] - e[2] * f[1], e[2] * f[0] - e[0] * f[2], e[0] * f[1] - e[1] * f[0]};
}

}  // namespace faqem::test

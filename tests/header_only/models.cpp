#include "header_only/models.hpp"

#include <faqem/simplify.hpp>

#include <cmath>

namespace models {

using faqem::Index;
using faqem::TriangleMesh;

namespace {

/// A wave like a sine of x turns, whose bytes do not depend on a library of functions.
double wave(double x) {
    const double t = x - std::floor(x);
    return t < 0.5 ? 16 * t * (0.5 - t) : 16 * (t - 0.5) * (t - 1);
}

/// The quads of an n x m grid of vertices in two triangles each.
void add_quads(Index n, Index m, TriangleMesh& mesh) {
    for (Index y = 0; y + 1 < m; ++y) {
        for (Index x = 0; x + 1 < n; ++x) {
            const Index a = y * n + x, b = a + 1, c = a + n, d = c + 1;
            mesh.triangles.push_back({a, b, d});
            mesh.triangles.push_back({a, d, c});
        }
    }
}

}  // namespace

TriangleMesh wavy_grid(Index n) {
    // A body that another file of the program uses, too.
    faqem::validate({.target = faqem::ratio(0.1)});
    TriangleMesh mesh;
    for (Index y = 0; y <= n; ++y) {
        for (Index x = 0; x <= n; ++x) {
            const double u = static_cast<double>(x) / n, v = static_cast<double>(y) / n;
            mesh.positions.push_back(
                {u, v, 0.05 * wave(1.4 * u) * wave(1.1 * v + 0.25) + 0.01 * u * v * (x % 3)});
        }
    }
    add_quads(n + 1, n + 1, mesh);
    return mesh;
}

TriangleMesh open_tube(Index n, Index m) {
    TriangleMesh mesh;
    for (Index y = 0; y <= m; ++y) {
        for (Index x = 0; x <= n; ++x) {
            const double turn = static_cast<double>(x % n) / n, r = 1 + 0.1 * wave(0.08 * y);
            mesh.positions.push_back({r * wave(turn + 0.25), r * wave(turn), 0.1 * y});
        }
    }
    add_quads(n + 1, m + 1, mesh);
    return mesh;
}

TriangleMesh fins(Index n) {
    TriangleMesh mesh = wavy_grid(n);
    const std::size_t quads = mesh.triangles.size() / 2;
    for (std::size_t q = 0; q < quads; ++q) {
        const faqem::Triangle& t = mesh.triangles[2 * q];
        const Index tip = static_cast<Index>(mesh.positions.size());
        faqem::Vec3 position = mesh.positions[t[0]];
        position[2] += 0.03;
        mesh.positions.push_back(position);
        mesh.triangles.push_back({t[0], t[2], tip});
    }
    return mesh;
}

}  // namespace models

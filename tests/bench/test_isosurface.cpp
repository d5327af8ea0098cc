// Tests of the mesh generator of the benchmarks.
#include <set>

#include "bench/isosurface.hpp"
#include "faqem/compare.hpp"
#include "faqem/engine/mesh/vector.hpp"
#include "support/catch.hpp"

using namespace faqem;
using namespace faqem::bench;

TEST_CASE("isosurface generates a closed manifold with outward normals") {
    for (const std::uint64_t seed : {1, 2, 3}) {
        CAPTURE(seed);
        const TriangleMesh mesh = isosurface(40, seed);
        const MeshInfo i = info(mesh.view());
        CHECK(i.faces == mesh.triangles.size());
        CHECK(i.vertices == mesh.positions.size());
        CHECK(i.degenerate_faces == 0);
        CHECK(i.boundary_edges == 0);
        CHECK(i.nonmanifold_edges == 0);
        CHECK(i.components < 5);  // the main component and small ones caused by noise
        CHECK(i.diagonal < std::sqrt(3.0));
        // Each edge must occur once in each direction.
        std::set<std::pair<Index, Index>> edges;
        double volume = 0;
        for (const Triangle& t : mesh.triangles) {
            const auto at = [&](std::size_t k) { return engine::to_eigen(mesh.positions[t[k]]); };
            volume += at(0).dot(at(1).cross(at(2)));
            for (std::size_t k = 0; k < 3; ++k) CHECK(edges.emplace(t[k], t[(k + 1) % 3]).second);
        }
        CHECK(volume > 0);
        for (const auto& [a, b] : edges) CHECK(edges.contains({b, a}));
    }
}

TEST_CASE("isosurface is deterministic and depends on the seed") {
    const TriangleMesh a = isosurface(24, 7), b = isosurface(24, 7), c = isosurface(24, 8);
    CHECK(a.positions == b.positions);
    CHECK(a.triangles == b.triangles);
    CHECK(a.positions != c.positions);
}

TEST_CASE("isosurface_of generates approximately the requested number of faces") {
    for (const double faces : {20e3, 100e3}) {
        const auto found =
            static_cast<double>(isosurface_of(static_cast<std::size_t>(faces), 1).triangles.size());
        CHECK(found == Approx(faces).epsilon(0.1));
    }
}

TEST_CASE("shuffle permutes the vertices and preserves the faces") {
    const TriangleMesh mesh = isosurface(24, 1);
    TriangleMesh other = mesh;
    shuffle(other.positions, other.triangles, 5);
    REQUIRE(other.triangles.size() == mesh.triangles.size());
    CHECK(other.triangles != mesh.triangles);
    bool same = true;
    for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
        for (std::size_t k = 0; k < 3; ++k) {
            same &= other.positions[other.triangles[f][k]] == mesh.positions[mesh.triangles[f][k]];
        }
    }
    CHECK(same);
}

#include <meshoptimizer.h>

#include <limits>

#include "faqem/detail/base/stopwatch.hpp"
#include "simplifier.hpp"

namespace faqem::bench {

Outcome meshoptimizer(const TriangleMesh& in, std::size_t target_faces) {
    std::vector<Vec3f> positions(in.positions.size());
    for (std::size_t v = 0; v < positions.size(); ++v) {
        for (std::size_t k = 0; k < 3; ++k) positions[v][k] = static_cast<float>(in.positions[v][k]);
    }
    std::vector<unsigned int> indices;
    indices.reserve(3 * in.triangles.size());
    for (const Triangle& t : in.triangles) indices.insert(indices.end(), t.begin(), t.end());

    // Positions that are equal after rounding to float are welded: meshoptimizer would treat them as seams
    // and not move them.
    std::vector<unsigned int> remap(positions.size());
    const std::size_t unique = meshopt_generateVertexRemap(remap.data(), nullptr, positions.size(),
                                                           positions.data(), positions.size(), sizeof(Vec3f));
    std::vector<Vec3f> unique_positions(unique);
    std::vector<Vec3> exact(unique);
    for (std::size_t v = 0; v < positions.size(); ++v) {
        unique_positions[remap[v]] = positions[v];
        exact[remap[v]] = in.positions[v];
    }
    for (unsigned int& v : indices) v = remap[v];

    std::vector<unsigned int> out(indices.size());
    const detail::Stopwatch core;
    out.resize(meshopt_simplify(out.data(), indices.data(), indices.size(), unique_positions.front().data(),
                                unique, sizeof(Vec3f), 3 * target_faces, std::numeric_limits<float>::max(), 0,
                                nullptr));
    const double seconds = core.seconds();

    // meshoptimizer returns a subset of the vertices, so that their original double positions can be
    // returned.
    TriangleMesh mesh;
    std::vector<Index> compact(unique, no_index);
    mesh.triangles.resize(out.size() / 3);
    for (std::size_t c = 0; c < out.size(); ++c) {
        Index& v = compact[out[c]];
        if (v == no_index) {
            v = static_cast<Index>(mesh.positions.size());
            mesh.positions.push_back(exact[out[c]]);
        }
        mesh.triangles[c / 3][c % 3] = v;
    }
    return {std::move(mesh), seconds, {}};
}

}  // namespace faqem::bench

#pragma once
/// \file
/// An OriginalSurface together with the arrays that it references.

#include "faqem/engine/tracking/original_surface.hpp"
#include "support/meshes.hpp"

namespace faqem::test {

struct OriginalOf {
    explicit OriginalOf(const TriangleMesh& mesh)
        : positions(vectors(mesh)), triangles(mesh.triangles), surface(positions, triangles) {
        for (Index v = 0; v < positions.size(); ++v) tracked.add(v, v);
    }
    OriginalOf(const OriginalOf&) = delete;

    std::vector<engine::Vector3> positions;
    std::vector<Triangle> triangles;
    engine::OriginalSurface surface;
    engine::TrackedVertices tracked;  ///< every vertex maps to itself
};

}  // namespace faqem::test

#pragma once
/// \file
/// The original of a test mesh, with the arrays it looks at.

#include "support/meshes.hpp"
#include "faqem/engine/tracking/reference_surface.hpp"

namespace faqem::test {

struct OriginalOf {
    explicit OriginalOf(const TriangleMesh& mesh)
        : positions(vectors(mesh)), triangles(mesh.triangles), surface(positions, triangles) {
        for (Index v = 0; v < positions.size(); ++v) lineage.add(v, v);
    }
    OriginalOf(const OriginalOf&) = delete;

    std::vector<engine::Vector3> positions;
    std::vector<Triangle> triangles;
    engine::Original surface;
    engine::Lineage lineage;  ///< before the first collapse
};

}  // namespace faqem::test

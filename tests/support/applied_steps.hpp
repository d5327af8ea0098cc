#pragma once

#include <vector>

#include "faqem/detail/simplify/compaction.hpp"
#include "faqem/engine/mesh/collapse_mesh.hpp"

namespace faqem::test {

/// The surface after some steps, applied one by one to a CollapseMesh.
inline detail::CompactedMesh applied(const std::vector<engine::Vector3>& positions,
                                     const std::vector<Triangle>& triangles,
                                     const std::vector<detail::RoundStep>& steps) {
    engine::CollapseMesh mesh(positions, triangles);
    detail::SlotTrace trace(positions.size());
    for (const auto& [survivor, gone, to] : steps) {
        trace.before_collapse(survivor, gone, mesh.position(survivor), mesh.position(gone), to);
        mesh.collapse(survivor, gone, to);
    }
    return detail::compacted(mesh, trace);
}

}  // namespace faqem::test

#pragma once

#include <algorithm>
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

/// Whether both have the same collapses, in the same order, and the same patches.
inline bool same_steps(const detail::RoundSteps& a, const detail::RoundSteps& b) {
    return std::equal(a.steps.begin(), a.steps.end(), b.steps.begin(), b.steps.end(),
                      [](const detail::RoundStep& x, const detail::RoundStep& y) {
                          return x.survivor == y.survivor && x.gone == y.gone && x.to == y.to;
                      }) &&
           a.patch_faces == b.patch_faces && a.patch_begin == b.patch_begin;
}

}  // namespace faqem::test

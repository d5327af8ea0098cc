#include <memory>
#include <utility>

#include "bake/texture/bake_job.hpp"

namespace faqem::detail {
namespace {

// Without textures and transferred normals, the map is needed only for skin weights, morph targets and custom attributes.
bool needs_map(const Part& part, const BakeOptions& bake) {
    const bool is_bare = bake.kind == Bake::none && bake.normals != Normals::transfer;
    return !is_bare || !part.joints.empty() || !part.morph_targets.empty() || !part.custom_attributes.empty();
}

}  // namespace

void map_parts(BakeJob& job, std::span<const SimplifyResult> simplified) {
    double done = 0;
    for (std::size_t p = 0; p < job.source.parts.size(); ++p) {
        job.report_progress(Phase::map, done++ / static_cast<double>(job.source.parts.size()));
        BakePart part{static_cast<Index>(p), &job.source.parts[p], &simplified[p], nullptr};
        if (part.faces() > 0 && !job.skipped[p] && needs_map(*part.source, job.options.bake)) {
            part.map = std::make_unique<const SurfaceMap>(make_surface_map(
                part.simplified->history, job.options.bake.mapping, part.source->triangles, job.workers()));
        }
        job.parts.push_back(std::move(part));
    }
    for (const BakePart& part : job.parts) {
        job.report_progress(Phase::map, 1);
        const bool has_normals =
            part.faces() > 0 && !job.skipped[part.index] && job.options.bake.normals != Normals::none;
        job.normals.push_back(has_normals ? make_normals(part, job.options.bake, job.workers())
                                          : CornerNormals{});
    }
}

}  // namespace faqem::detail

#include <algorithm>
#include <memory>
#include <utility>

#include "bake/texture/bake_job.hpp"

namespace faqem::detail {
namespace {

// Whether the bake makes an image, or decides whether to make one. Without textures and colours there is none, unless
// a normal map or a correspondence is asked for, or several materials with different factors share a page.
bool may_make_images(const Asset& asset, const BakeOptions& bake) {
    return !asset.images.empty() || asset.materials.size() > 1 || bake.normal_map == NormalMap::on ||
           bake.correspondence == Recording::on ||
           std::any_of(asset.parts.begin(), asset.parts.end(),
                       [](const Part& part) { return !part.uvs.empty() || !part.colors.empty(); });
}

// Normals need no map, see make_normals().
bool needs_map(const Asset& asset, const Part& part, const BakeOptions& bake) {
    if (!part.joints.empty() || !part.morph_targets.empty() || !part.custom_attributes.empty() ||
        bake.mapping != Mapping::projection)
        return true;
    return bake.kind != Bake::none && (!makes_atlas(bake.kind) || may_make_images(asset, bake));
}

}  // namespace

void map_parts(BakeJob& job, std::span<const SimplifyResult> simplified) {
    double done = 0;
    for (std::size_t p = 0; p < job.source.parts.size(); ++p) {
        job.report_progress(Phase::map, done++ / static_cast<double>(job.source.parts.size()));
        BakePart part{static_cast<Index>(p), &job.source.parts[p], &simplified[p], nullptr};
        if (part.faces() > 0 && !job.skipped[p] && needs_map(job.source, *part.source, job.options.bake)) {
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

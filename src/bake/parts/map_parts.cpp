#include "bake/parts/map_parts.hpp"

#include <algorithm>
#include <memory>

#include "bake/parts/corner_normals.hpp"

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

std::vector<BakePart> map_parts(const Asset& source, std::span<const SimplifyResult> simplified,
                                std::span<const std::uint8_t> kept, const BakeOptions& bake,
                                BakeProgress& progress) {
    std::vector<BakePart> parts;
    for (std::size_t p = 0; p < source.parts.size(); ++p) {
        progress.report(Phase::map, static_cast<double>(p) / static_cast<double>(source.parts.size()));
        BakePart& part = parts.emplace_back();
        part.index = static_cast<Index>(p);
        part.source = &source.parts[p];
        part.simplified = &simplified[p];
        part.is_kept = kept[p] != 0;
        if (part.faces() > 0 && !part.is_kept && needs_map(source, *part.source, bake)) {
            part.map = std::make_unique<const SurfaceMap>(make_surface_map(
                simplified[p].history, bake.mapping, part.source->triangles, progress.workers()));
        }
    }
    for (BakePart& part : parts) {
        progress.report(Phase::map, 1);
        if (part.faces() > 0 && !part.is_kept && bake.normals != Normals::none)
            part.normals = make_normals(part, bake, progress.workers());
    }
    return parts;
}

}  // namespace faqem::detail

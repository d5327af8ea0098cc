#pragma once
/// \file
/// The simplified parts with what every kind of baking needs: surface maps and normals.

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "asset/scene/part_arrays.hpp"
#include "bake/parts/corner_normals.hpp"
#include "bake/parts/corner_transfer.hpp"
#include "bake/parts/corners.hpp"
#include "faqem/asset.hpp"
#include "faqem/detail/base/parallel.hpp"

namespace faqem::detail {

/// Whether the bake makes an image, or decides whether to make one. Without textures and colours there is none, unless
/// a normal map or a correspondence is asked for, or several materials with different factors share a page.
inline bool may_make_images(const Asset& asset, const BakeOptions& bake) {
    return !asset.images.empty() || asset.materials.size() > 1 || bake.normal_map == NormalMap::on ||
           bake.correspondence == Recording::on || some_part_has(asset, &Part::colors);
}

/// Normals need no map, see make_normals().
inline bool needs_map(const Asset& asset, const BakePart& of, const BakeOptions& bake) {
    const Part& part = *of.source;
    if (!part.joints.empty() || !part.morph_targets.empty() || !part.custom_attributes.empty() ||
        (makes_atlas(bake.kind) && !part.uvs.empty() && !has_corner_attributes(of)))
        return true;
    return bake.kind != Bake::none && (!makes_atlas(bake.kind) || may_make_images(asset, bake));
}

/// Makes the surface maps and the normals of all parts that are not kept.
/// \param source, simplified  by part; must outlive the result
/// \param kept  by part: BakePart::is_kept
/// \return by part of the source
/// \throws engine::Cancelled
inline std::vector<BakePart> map_parts(const Asset& source, std::span<const SimplifyResult> simplified,
                                       std::span<const std::uint8_t> kept, const BakeOptions& bake,
                                       const RunContext& context) {
    std::vector<BakePart> parts(source.parts.size());
    const bool has_normals = source.smoothing == Smoothing::unknown && some_part_has(source, &Part::normals);
    const bool writes_normals =
        bake.normals == Normals::automatic ? has_normals : bake.normals != Normals::none;
    for (std::size_t p = 0; p < parts.size(); ++p) {
        parts[p].index = static_cast<Index>(p);
        parts[p].source = &source.parts[p];
        parts[p].simplified = &simplified[p];
        parts[p].is_kept = kept[p] != 0;
        parts[p].writes_normals = writes_normals;
    }
    // Several parts at a time: the tree of a map is built by one thread.
    const auto map_part = [&](std::size_t p, std::size_t, const RunContext& block_context) {
        BakePart& part = parts[p];
        if (part.faces() == 0 || part.is_kept) return;
        if (needs_map(source, part, bake))
            part.map = std::make_unique<const HistoryMap>(
                make_surface_map(part.simplified->history, part.source->triangles, block_context));
        if (writes_normals || makes_atlas(bake.kind)) part.normals = make_normals(part, bake, block_context);
    };
    reported_blocks(parts.size(), 1, context, Phase::map, 0, 1, map_part);
    context.report(Phase::map, 1);
    return parts;
}

}  // namespace faqem::detail

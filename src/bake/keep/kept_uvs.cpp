#include "bake/keep/kept_uvs.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "asset/scene/material_textures.hpp"
#include "asset/scene/source_traits.hpp"
#include "bake/keep/picture_loss.hpp"
#include "bake/page/normal_map.hpp"
#include "bake/page/page_mesh.hpp"
#include "bake/parts/output_part.hpp"
#include "bake/source/page_groups.hpp"
#include "bake/source/source_sampler.hpp"
#include "faqem/engine/mesh/union_find.hpp"
#include "scene/material_groups.hpp"
#include "scene/vector_conversion.hpp"

namespace faqem::detail {
namespace {

// By how many dB pictures with kept UVs may have a lower PSNR: in the mean of small and large ones, and each. Unlit
// and lit pictures are judged apart: a better surface does not make up for torn colours.
constexpr double allowed_mean_loss = 0.25, allowed_loss = 0.8;

// The same where new images would have less than an eighth of the resolution, or blur single texels that the source
// shows without filter: closer views show the difference.
constexpr double allowed_loss_if_coarse = 2, coarse_share = 1.0 / 64;

// Points per side of a view: of a scene with one set of parts, and at least.
constexpr std::uint32_t view_points = 256, min_view_points = 64;

std::uint64_t lost_components(const Report& report) {
    return report.components_collapsed + report.components_deleted;
}

// By how many times as many components may be lost: which of the smallest ones are lost is a matter of chance.
constexpr std::uint64_t allowed_component_factor = 2;

// By how many faces a part may have more with UVs, if the model has no more than its target.
std::uint64_t allowed_more_faces(std::uint64_t faces) { return std::max<std::uint64_t>(2, faces / 100); }

// Whether a part was simplified with UVs about as far as without, and lost hardly more on the way. Coincident faces of
// different colour are one face where UVs are kept.
bool is_as_complete(const SimplifyResult& kept, const SimplifyResult& free) {
    const std::uint64_t faces = free.mesh.triangles.size();
    return !kept.mesh.triangles.empty() && kept.mesh.triangles.size() <= faces + allowed_more_faces(faces) &&
           kept.report.faces_dropped <= free.report.faces_dropped &&
           lost_components(kept.report) <= allowed_component_factor * lost_components(free.report);
}

// Sets of parts that share images.
engine::UnionFind image_sharing_parts(const Asset& asset) {
    engine::UnionFind result(asset.parts.size());
    std::vector<Index> user(asset.images.size(), no_index);
    for (Index p = 0; p < asset.parts.size(); ++p) {
        for (const Index m : materials_of(asset.parts[p])) {
            for_each_texture(asset.materials[m], [&](const TextureRef& texture) {
                if (!texture) return;
                if (user[texture.image] == no_index) user[texture.image] = p;
                result.unite(user[texture.image], p);
            });
        }
    }
    return result;
}

// What new pages would have, by part.
struct ExpectedPages {
    std::vector<double> texel_sides;           // ComparedScenes::page_texels
    std::vector<std::uint8_t> has_normal_map;  // ComparedScenes::gets_normal_map
    std::vector<double> share;                 // of the texels of the source, at most 1
};

ExpectedPages expected_pages(const Asset& source, const BakeOptions& bake, std::span<const BakePart> parts,
                             const SourceSampler& sampler, const RunContext& context) {
    const MaterialGroups groups = page_groups(source, bake, kept_flags(parts));
    std::vector<std::vector<PageFace>> faces(groups.groups.size());
    std::vector<double> needed(groups.groups.size(), 0);  // texels
    std::vector<double> area(parts.size(), 0), texels(parts.size(), 0);
    for (const BakePart& part : parts) {
        if (part.is_kept) continue;
        const TriangleMesh& mesh = part.simplified->mesh;
        for (Index f = 0; f < part.faces(); ++f) {
            const Index group =
                groups.group_of(face_material(*part.source, part.simplified->history.remaining_faces[f]));
            faces[group].push_back({part.index, f});
            const double own = triangle_area(mesh.positions, mesh.triangles[f]);
            constexpr double third = 1.0 / 3;
            const Index at = part.map->map(f, {third, third, third}).face;
            const double density =
                std::max(sampler.texel_density(part.index, at), sampler.region_density(part.index, at));
            const double wanted = own * density * density;
            if (!std::isfinite(wanted)) continue;
            area[part.index] += own;
            texels[part.index] += wanted;
            needed[group] += wanted;
        }
    }
    ExpectedPages result{std::vector<double>(parts.size(), 0), std::vector<std::uint8_t>(parts.size(), 0),
                         std::vector<double>(parts.size(), 1)};
    const double side = bake.texture_size;
    for (std::size_t g = 0; g < faces.size(); ++g) {
        const bool normal_map =
            wants_normal_map(bake.normal_map, source, groups.groups[g], parts, faces[g], context);
        const double share = std::min(1.0, usual_page_fill * side * side / needed[g]);
        for (const PageFace& face : faces[g]) {
            if (normal_map) result.has_normal_map[face.part] = 1;
            result.share[face.part] = std::min(result.share[face.part], share);
            const double spacing = std::sqrt(area[face.part] / (texels[face.part] * share));
            if (spacing > result.texel_sides[face.part] && std::isfinite(spacing))
                result.texel_sides[face.part] = spacing;
        }
    }
    return result;
}

// By how many dB one mean squared difference is worse than another.
double decibels_worse(double one, double other) {
    return psnr(other, invisible_difference) - psnr(one, invisible_difference);
}

bool is_as_good(const std::array<KeptAndBaked, 2>& differences, bool is_coarse) {
    const double allowed = is_coarse ? allowed_loss_if_coarse : allowed_loss;
    std::array<double, 2> sum{};  // unlit, lit
    for (const auto& [kept, baked] : differences) {
        const std::array<double, 2> lost = {decibels_worse(kept.unlit, baked.unlit),
                                            decibels_worse(kept.lit, baked.lit)};
        for (std::size_t k = 0; k < sum.size(); ++k) {
            if (!(lost[k] <= allowed)) return false;
            sum[k] += lost[k];
        }
    }
    const double mean = *std::max_element(sum.begin(), sum.end()) / static_cast<double>(differences.size());
    return is_coarse || mean <= allowed_mean_loss;
}

// Removes sets that would bring the model above its target: those with more faces than without UVs, from the first that
// does not fit.
void limit_faces(const SimplifiedParts& simplified, std::vector<PartSet>& sets) {
    std::uint64_t allowed = simplified.report.target_faces;
    for (const SimplifyResult& part : simplified.parts)
        allowed -= std::min<std::uint64_t>(allowed, part.mesh.triangles.size());
    std::erase_if(sets, [&](const PartSet& set) {
        std::uint64_t with = 0, without = 0;
        for (const Index p : set) {
            with += simplified.with_uvs[p].mesh.triangles.size();
            without += simplified.parts[p].mesh.triangles.size();
        }
        if (with <= without) return false;
        if (with - without > allowed) return true;
        allowed -= with - without;
        return false;
    });
}

}  // namespace

std::vector<PartSet> sets_with_uvs(const Asset& source, std::span<const BakePart> parts,
                                   const SimplifiedParts& simplified) {
    engine::UnionFind sets = image_sharing_parts(source);
    std::vector<PartSet> result(parts.size());
    std::vector<std::uint8_t> is_possible(parts.size(), 1);
    for (const BakePart& part : parts) {
        if (part.is_kept || part.source->triangles.empty()) continue;
        const Index set = sets.find(part.index);
        result[set].push_back(part.index);
        if (!is_as_complete(simplified.with_uvs[part.index], simplified.parts[part.index]))
            is_possible[set] = 0;
    }
    for (std::size_t s = 0; s < result.size(); ++s)
        if (!is_possible[s]) result[s].clear();
    std::erase_if(result, [](const PartSet& set) { return set.empty(); });
    limit_faces(simplified, result);
    return result;
}

ComparedUvs compare_uvs(const Asset& source, const BakeOptions& bake, std::span<const BakePart> parts,
                        const PartsWithUvs& candidates, DecodedImages& decoded, const RunContext& context) {
    const std::vector<PartSet>& sets = candidates.sets;
    const Channels seen{CoreTexture::base_color, CoreTexture::normal};
    const SourceSampler sampler(source, seen, context, kept_flags(parts), &decoded);
    const SourceSampler kept_sampler(candidates.asset, seen, context, {}, &decoded);
    const ExpectedPages pages = expected_pages(source, bake, parts, sampler, context);
    const ComparedScenes scenes{
        source, parts, sampler, candidates.asset, kept_sampler, pages.texel_sides, pages.has_normal_map};
    const double side = view_points / std::sqrt(static_cast<double>(sets.size()));
    const auto size = std::max(min_view_points, static_cast<std::uint32_t>(side));
    const std::vector<std::uint8_t> needs_uvs = parts_that_need_uvs(source);
    std::vector<Index> good;
    PictureDifference sum;
    double points = 0;
    for (const PartSet& set : sets) {
        // A part with UVs that no texture uses has nothing that a page would show better; of several materials, the free
        // simplification may leave no faces, and so no borders.
        const bool must_be_kept = std::ranges::any_of(set, [&](Index p) {
            const Part& part = source.parts[p];
            return needs_uvs[p] != 0 || (has_spare_uvs_only(source, part) && materials_of(part).size() <= 1);
        });
        const bool is_coarse = std::ranges::any_of(set, [&](Index p) {
            return shows_single_texels(source, source.parts[p]) || pages.share[p] < coarse_share;
        });
        const ComparedPictures pictures = compare_pictures(scenes, set, size, context);
        const bool is_good = must_be_kept || is_as_good(pictures.differences, is_coarse);
        if (is_good) good.insert(good.end(), set.begin(), set.end());
        const KeptAndBaked& large = pictures.differences.back();
        const auto own_points = static_cast<double>(pictures.points);
        if (own_points > 0) sum += (is_good ? large.kept : large.baked) * own_points;
        points += own_points;
    }
    std::sort(good.begin(), good.end());
    return {std::move(good), sum * (1 / points)};
}

void keep_uvs(const SimplifiedParts& simplified, std::span<const Index> which, std::span<BakePart> parts) {
    for (const Index p : which) {
        if (parts[p].is_kept) continue;
        parts[p].simplified = &simplified.with_uvs[p];
        parts[p].map.reset();
        parts[p].normals = {};
        parts[p].is_kept = true;
    }
}

}  // namespace faqem::detail

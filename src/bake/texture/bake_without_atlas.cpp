#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "asset/scene/material_textures.hpp"
#include "asset/scene/messages.hpp"
#include "bake/page/normal_map.hpp"
#include "bake/parts/corner_transfer.hpp"
#include "bake/parts/output_part.hpp"
#include "bake/parts/vertex_attributes.hpp"
#include "bake/source/extension_layers.hpp"
#include "bake/source/source_sampler.hpp"
#include "bake/texture/bake_job.hpp"
#include "faqem/error.hpp"
#include "render/texture_sampling.hpp"
#include "scene/material_groups.hpp"

namespace faqem::detail {
namespace {

// Names of a material's textures for a warning: "base colour, normal".
std::string texture_names(const Material& m, bool with_base) {
    std::string result;
    for (const CoreSlot& slot : core_slots)
        if (m.*slot.texture && (with_base || slot.texture != &Material::base_color_texture))
            result += (result.empty() ? "" : ", ") + std::string(slot.title);
    return result;
}

// Removes all textures of a material, with a warning. The emissive factor is reset if there was an emissive
// texture: without it the whole surface would emit light.
Material without_textures(const Asset& source, Index index, bool base_is_stored_elsewhere,
                          std::vector<std::string>& warnings) {
    Material result = material_or_default(source, index);
    const std::string names = texture_names(result, !base_is_stored_elsewhere);
    if (!names.empty()) warnings.push_back(material_title(source, index) + ": textures left out: " + names);
    if (result.emissive_texture) result.emissive = {0, 0, 0};
    remove_textures(result);  // save() warns about those of extensions
    result.rebaked = true;
    return result;
}

// Tangents of the faces whose material has a normal map. Tangents stored in a file are assumed to be computed
// from the UVs without the texture transform; viewers compute missing ones from the transformed UVs.
std::vector<Vec4f> kept_tangents(const Asset& source, const BakePart& part,
                                 const std::vector<Index>& materials,
                                 const std::vector<std::vector<Vec2f>>& uvs) {
    std::vector<Vec4f> result;
    std::map<Index, std::vector<Index>> faces_of;
    for (Index f = 0; f < part.faces(); ++f) faces_of[materials[f]].push_back(f);
    for (const auto& [material, faces] : faces_of) {
        const TextureRef* texture_ref = tangent_texture(material_or_default(source, material));
        if (!texture_ref || texture_ref->uv_set >= uvs.size()) continue;
        std::vector<Vec2f> moved = uvs[texture_ref->uv_set];
        if (part.source->tangents.empty()) {
            const UvTransform transform = uv_transform(*texture_ref);
            for (Vec2f& uv : moved) uv = transform.apply(uv);
        }
        set_tangents(part, faces, moved, result);
    }
    return result;
}

// Keeps the UVs and vertex colours of a part.
// \return the number of faces that cross borders of UV charts
std::uint64_t keep_part(const BakeJob& job, const BakePart& part, Part& to) {
    if (!has_corner_attributes(part) && job.needs_attributes) {
        throw InputError("", part_title(job.source, part.index),
                         "the simplified mesh must have the source's UVs and vertex colours as attributes, "
                         "which simplify_parts() transfers if bake.kind is Bake::keep");
    }
    KeptCorners kept = kept_corners(part, job.context);
    if (part.writes_normals)
        kept.values.tangents = kept_tangents(job.source, part, kept.materials, kept.values.uvs);
    to = make_output_part(part, std::move(kept.values), std::move(kept.materials), job.context);
    return kept.crossing_faces;
}

}  // namespace

void bake_vertex(const BakeJob& job, UnencodedResult& out) {
    BakeOptions bake = job.options;
    bake.kind = Bake::vertex;  // also if an atlas was requested, but has too few texels
    const std::vector<std::uint8_t> kept = kept_flags(job.parts);
    const MaterialGroups groups = group_materials(job.source, bake, kept);
    const SourceSampler sampler(job.source, {CoreTexture::base_color}, job.context, kept);
    Asset& asset = out.asset.asset;
    for (const MaterialGroup& group : groups.groups) {
        for (const Index m : group.materials) {
            Material material = without_textures(job.source, m, true, out.asset.report.warnings);
            material.base_color = {1, 1, 1, 1};
            if (m == group.materials.front()) asset.materials.push_back(std::move(material));
        }
    }
    for (const BakePart& part : job.parts) {
        job.context.report(Phase::bake, part.index / static_cast<double>(job.parts.size()));
        Part& to = asset.parts.emplace_back();
        if (part.is_kept) continue;
        CornerValues values;
        if (part.map) values.colors = corner_colors(part, sampler, job.context);
        std::vector<Index> materials = remaining_materials(part);
        for (Index& m : materials) m = groups.group_of(m);
        to = make_output_part(part, std::move(values), std::move(materials), job.context);
    }
}

void bake_keep(const BakeJob& job, UnencodedResult& out) {
    Asset& asset = out.asset.asset;
    asset.materials = job.source.materials;
    asset.images = job.source.images;
    std::uint64_t crossing_faces = 0;
    for (const BakePart& part : job.parts) {
        job.context.check_now();
        Part& to = asset.parts.emplace_back();
        if (!part.is_kept) crossing_faces += keep_part(job, part, to);
    }
    warn_of_crossing_faces(crossing_faces, out.asset.report.warnings);
}

void bake_none(const BakeJob& job, UnencodedResult& out) {
    Asset& asset = out.asset.asset;
    std::vector<std::string>& warnings = out.asset.report.warnings;
    for (std::size_t m = 0; m < job.source.materials.size(); ++m)
        asset.materials.push_back(without_textures(job.source, static_cast<Index>(m), false, warnings));
    for (const BakePart& part : job.parts) {
        Part& to = asset.parts.emplace_back();
        if (part.is_kept) continue;
        if (!part.source->colors.empty())
            warnings.push_back(part_title(job.source, part.index) + ": vertex colours left out");
        to = make_output_part(part, {}, remaining_materials(part), job.context);
    }
}

}  // namespace faqem::detail

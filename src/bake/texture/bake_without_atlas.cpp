#include <algorithm>

#include <map>
#include "asset/scene/messages.hpp"

#include "bake/texture/bake_job.hpp"
#include "bake/texture/normal_map.hpp"
#include "bake/transfer/corner_transfer.hpp"
#include "bake/transfer/custom_attributes.hpp"
#include "bake/transfer/extension_layers.hpp"
#include "bake/transfer/texture_sampling.hpp"
#include "bake/transfer/vertex_attributes.hpp"
#include "faqem/error.hpp"

namespace faqem::detail {
namespace {

// Names of a material's textures for a warning: "base colour, normal".
std::string texture_names(const Material& m, bool with_base) {
    std::string result;
    const auto add = [&](const TextureRef& texture, const char* name) {
        if (texture) result += (result.empty() ? "" : ", ") + std::string(name);
    };
    if (with_base) add(m.base_color_texture, "base colour");
    add(m.metallic_roughness_texture, "metallic-roughness");
    add(m.normal_texture, "normal");
    add(m.occlusion_texture, "occlusion");
    add(m.emissive_texture, "emissive");
    return result;
}

// Removes all textures of a material, with a warning. The emissive factor is reset if there was an emissive
// texture: without it the whole surface would emit light.
Material without_textures(BakeJob& job, Index index, bool base_is_kept_elsewhere) {
    Material result = material_or_default(job.source, index);
    const std::string names = texture_names(result, !base_is_kept_elsewhere);
    if (!names.empty()) job.warn(material_title(job.source, index) + ": textures left out: " + names);
    if (result.emissive_texture) result.emissive = {0, 0, 0};
    result.base_color_texture = result.metallic_roughness_texture = result.normal_texture =
        result.occlusion_texture = result.emissive_texture = {};
    result.normal_scale = result.occlusion_strength = 1;
    result.extension_textures.clear();  // save() warns about these
    result.rebaked = true;
    return result;
}

void finish_part(BakeJob& job, const BakePart& part, CornerValues values, std::vector<Index> materials) {
    values.custom = corner_custom_attributes(part, job.cancellation_check());
    WeldedPart welded = weld_corners(part, values);
    transfer_skin_and_morphs(part, welded, job.cancellation_check());
    welded.part.face_material = std::move(materials);
    job.result.asset.parts.push_back(std::move(welded.part));
}

// Adds an empty part for an untouched one. Returns false for other parts.
bool leave_empty(BakeJob& job, const BakePart& part) {
    if (job.skipped[part.index]) job.result.asset.parts.emplace_back();
    return job.skipped[part.index] != 0;
}

// By face of the result: the material of a face of the source.
std::vector<Index> materials_of(const BakePart& part, const std::vector<Index>& faces) {
    std::vector<Index> result;
    for (Index f : faces) result.push_back(face_material(*part.source, f));
    return result;
}

std::vector<Index> kept_materials(const BakePart& part) {
    return materials_of(part, part.simplified->history.kept_faces);
}

// Tangents of the faces whose material has a normal map. Tangents stored in a file are assumed to be computed
// from the UVs without the texture transform; viewers compute missing ones from the transformed UVs.
std::vector<Vec4f> kept_tangents(const BakeJob& job, const BakePart& part,
                                 const std::vector<Index>& materials,
                                 const std::vector<std::vector<Vec2f>>& uvs) {
    std::vector<Vec4f> result;
    std::map<Index, std::vector<Index>> faces_of;
    for (Index f = 0; f < part.faces(); ++f) faces_of[materials[f]].push_back(f);
    for (const auto& [material, faces] : faces_of) {
        const TextureRef* texture_ref = tangent_texture(material_or_default(job.source, material));
        if (!texture_ref || texture_ref->uv_set >= uvs.size()) continue;
        std::vector<Vec2f> moved = uvs[texture_ref->uv_set];
        if (part.source->tangents.empty()) {
            const UvTransform transform = uv_transform(*texture_ref);
            for (Vec2f& uv : moved) {
                const auto to = transform.apply(uv[0], uv[1]);
                uv = {static_cast<float>(to[0]), static_cast<float>(to[1])};
            }
        }
        set_tangents(part, job.normals[part.index], faces, moved, result);
    }
    return result;
}

}  // namespace

void bake_vertex(BakeJob& job) {
    BakeOptions bake = job.options.bake;
    bake.kind = Bake::vertex;  // also if an atlas was requested, but has too few texels
    const MaterialGroups groups = group_materials(job.source, bake, job.skipped);
    Channels wanted;
    wanted.base = true;
    const SourceSampler sampler(job.source, wanted, job.workers(), job.skipped);
    for (const MaterialGroup& group : groups.groups) {
        Material material = without_textures(job, group.materials.front(), true);
        for (std::size_t m = 1; m < group.materials.size(); ++m)
            without_textures(job, group.materials[m], true);
        material.base_color = {1, 1, 1, 1};
        job.result.asset.materials.push_back(std::move(material));
    }
    double done = 0;
    for (const BakePart& part : job.parts) {
        job.report_progress(Phase::bake, done++ / static_cast<double>(job.parts.size()));
        if (leave_empty(job, part)) continue;
        const CornerNormals& normals = job.normals[part.index];
        CornerValues values{normals.normals, {}, {}};
        if (part.map) values.colors = corner_colors(part, sampler, normals, job.workers());
        std::vector<Index> materials = kept_materials(part);
        for (Index& m : materials) m = groups.group_of(m);
        finish_part(job, part, std::move(values), std::move(materials));
    }
}

void bake_keep(BakeJob& job) {
    job.result.asset.materials = job.source.materials;
    job.result.asset.images = job.source.images;
    std::uint64_t crossing_faces = 0;
    for (const BakePart& part : job.parts) {
        job.cancellation_check().now();
        if (leave_empty(job, part)) continue;
        const std::size_t sets = part.source->uvs.size();
        const bool colors = !part.source->colors.empty();
        const std::size_t width = 2 * sets + (colors ? 4 : 0), corners = 3 * part.faces();
        const std::vector<float>& own = part.simplified->mesh.attributes.values;
        const bool has_own = own.size() == corners * width;
        if (!has_own && !job.is_late) {
            throw InputError(
                "", part_title(job.source, part.index),
                "the simplified mesh must have the source's UVs and vertex colours as attributes, which "
                "simplify_parts() transfers if bake.kind is Bake::keep");
        }
        const TransferredCorners transferred =
            has_own ? TransferredCorners{} : transfer_corners(part, job.workers());
        crossing_faces += transferred.crossing_faces;
        const std::vector<float>& from = has_own ? own : transferred.values;
        std::vector<Index> materials = has_own ? kept_materials(part) : materials_of(part, transferred.faces);
        CornerValues values{job.normals[part.index].normals, std::vector<std::vector<Vec2f>>(sets), {}};
        for (std::size_t c = 0; c < corners; ++c) {
            const float* corner = from.data() + c * width;
            for (std::size_t s = 0; s < sets; ++s)
                values.uvs[s].push_back({corner[2 * s], corner[2 * s + 1]});
            if (!colors) continue;
            corner += 2 * sets;
            values.colors.push_back({corner[0], corner[1], corner[2], corner[3]});
        }
        values.tangents = kept_tangents(job, part, materials, values.uvs);
        finish_part(job, part, std::move(values), std::move(materials));
    }
    if (crossing_faces > 0) {
        job.warn(std::to_string(crossing_faces) +
                 " faces cross borders of the source's UV charts: the image is stretched there");
    }
}

void bake_none(BakeJob& job) {
    for (std::size_t m = 0; m < job.source.materials.size(); ++m) {
        job.result.asset.materials.push_back(without_textures(job, static_cast<Index>(m), false));
    }
    for (const BakePart& part : job.parts) {
        if (leave_empty(job, part)) continue;
        if (!part.source->colors.empty())
            job.warn(part_title(job.source, part.index) + ": vertex colours left out");
        finish_part(job, part, {job.normals[part.index].normals, {}, {}}, kept_materials(part));
    }
}

}  // namespace faqem::detail

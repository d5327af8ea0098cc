#include <algorithm>
#include <array>
#include <optional>

#include "bake/job.hpp"
#include "bake/page.hpp"
#include "bake/vertex_transfer.hpp"

namespace faqem::detail {
namespace {

// One group's faces and page.
struct GroupPage {
    Channels channels;
    std::vector<PageFace> faces;
    std::optional<PageAtlas> atlas;  // none where no image is needed
};

bool has_colors(const Part& part) {
    return std::any_of(part.colors.begin(), part.colors.end(), [](const Vec4f& c) {
        return c != Vec4f{1, 1, 1, 1};
    });
}

// An image is made where a material has one, and where factors differ.
Channels needed_channels(const Asset& asset, const MaterialGroup& group) {
    Channels result;
    const Material& first = group.material;
    for (Index m : group.materials) {
        const Material& material = material_or_default(asset, m);
        result.base = result.base || material.base_color_texture || material.base_color != first.base_color;
        if (first.unlit) continue;
        result.metallic_roughness = result.metallic_roughness || material.metallic_roughness_texture ||
                                    material.metallic != first.metallic ||
                                    material.roughness != first.roughness;
        result.occlusion = result.occlusion || material.occlusion_texture;
        result.emissive = result.emissive || material.emissive_texture || material.emissive != first.emissive;
    }
    return result;
}

std::vector<GroupPage> group_pages(const BakeJob& job, const MaterialGroups& groups) {
    std::vector<GroupPage> pages(groups.groups.size());
    for (std::size_t g = 0; g < pages.size(); ++g) {
        pages[g].channels = needed_channels(job.source, groups.groups[g]);
    }
    for (const SmallPart& part : job.parts) {
        const bool colors = has_colors(*part.source);
        const std::vector<Index>& kept = part.small->history.kept_faces;
        for (Index f = 0; f < part.faces(); ++f) {
            GroupPage& page = pages[groups.of(face_material(*part.source, kept[f]))];
            page.faces.push_back({part.index, f});
            page.channels.base = page.channels.base || colors;
        }
    }
    return pages;
}

TextureRef add_image(Asset& asset, const Pixels& pixels, const std::string& name) {
    TextureRef ref;
    ref.image = static_cast<Index>(asset.images.size());
    ref.wrap_u = ref.wrap_v = Wrap::clamp;
    asset.images.push_back(encode_png(pixels, name));
    return ref;
}

Material page_material(Asset& asset, const Material& first, const Channels& channels,
                       const PageImages& images) {
    Material result = first;
    result.rebaked = true;
    result.normal_texture = result.base_color_texture = result.metallic_roughness_texture =
        result.occlusion_texture = result.emissive_texture = {};
    result.normal_scale = result.occlusion_strength = 1;
    const std::string name =
        first.name.empty() ? "material" + std::to_string(asset.materials.size()) : first.name;
    if (channels.base) {
        result.base_color = {1, 1, 1, 1};
        result.base_color_texture = add_image(asset, images.base, name + "_baseColor");
    }
    if (channels.metallic_roughness || channels.occlusion) {
        const TextureRef orm =
            add_image(asset, images.occlusion_roughness_metallic, name + "_occlusionRoughnessMetallic");
        if (channels.occlusion) result.occlusion_texture = orm;
        if (channels.metallic_roughness) {
            result.metallic = result.roughness = 1;
            result.metallic_roughness_texture = orm;
        }
    }
    if (channels.emissive) {
        result.emissive = {1, 1, 1};
        result.emissive_texture = add_image(asset, images.emissive, name + "_emissive");
    }
    return result;
}

void warn_of_normal_maps(BakeJob& job, const MaterialGroups& groups) {
    for (const MaterialGroup& group : groups.groups) {
        for (Index m : group.materials) {
            if (!material_or_default(job.source, m).normal_texture) continue;
            job.warn(material_title(job.source, m) + ": the normal map is not baked anew and was left out");
        }
    }
}

// UVs of the corners of all parts, in 0..1.
std::vector<std::vector<Vec2f>> corner_uvs(const BakeJob& job, const std::vector<GroupPage>& pages) {
    std::vector<std::vector<Vec2f>> result(job.parts.size());
    for (const GroupPage& page : pages) {
        if (!page.atlas) continue;
        const Atlas& atlas = page.atlas->atlas;
        for (std::size_t i = 0; i < page.faces.size(); ++i) {
            const PageFace& face = page.faces[i];
            std::vector<Vec2f>& uvs = result[face.part];
            uvs.resize(3 * job.parts[face.part].faces(), Vec2f{0, 0});
            for (std::size_t c = 0; c < 3; ++c) {
                const auto& uv = atlas.places[i].uv[c];
                uvs[std::size_t{3} * face.face + c] = {static_cast<float>(uv[0] / atlas.width),
                                                       static_cast<float>(uv[1] / atlas.height)};
            }
        }
    }
    return result;
}

}  // namespace

bool bake_pages(BakeJob& job) {
    const MaterialGroups groups = group_materials(job.source, Bake::per_triangle);
    std::vector<GroupPage> pages = group_pages(job, groups);
    Channels wanted;
    for (const GroupPage& page : pages) {
        wanted.base = wanted.base || page.channels.base;
        wanted.metallic_roughness = wanted.metallic_roughness || page.channels.metallic_roughness;
        wanted.occlusion = wanted.occlusion || page.channels.occlusion;
        wanted.emissive = wanted.emissive || page.channels.emissive;
    }
    const SourceSurface surface(job.source, wanted);
    double pieces = 0;
    for (GroupPage& page : pages) {
        if (!page.channels.any() || page.faces.empty()) continue;
        page.atlas = make_page_atlas(job, surface, page.faces);
        if (!page.atlas) return false;
        pieces += static_cast<double>(page.atlas->pieces());
    }
    warn_of_normal_maps(job, groups);
    Asset& out = job.result.asset;
    double done = 0;
    for (std::size_t g = 0; g < pages.size(); ++g) {
        const GroupPage& page = pages[g];
        const Material& first = groups.groups[g].material;
        PageImages images;
        if (page.atlas) {
            images = bake_page(job, surface,
                               {page.atlas->atlas, page.atlas->charts, page.atlas->tiles, page.atlas->across,
                                page.faces, page.channels, first.alpha_mode},
                               done, pieces);
            done += static_cast<double>(page.atlas->pieces());
        }
        if (page.atlas) {
            job.result.report.pages.push_back(page.atlas->summary);
            job.result.report.pages.back().material = first.name;
            if (page.atlas->summary.faces_alone > 0) {
                job.warn("atlas: " + std::to_string(page.atlas->summary.faces_alone) +
                         " faces lie alone: the bound on the work for their charts was reached");
            }
        }
        out.materials.push_back(page_material(out, first, page.atlas ? page.channels : Channels{}, images));
    }
    std::vector<std::vector<Vec2f>> uvs = corner_uvs(job, pages);
    for (const SmallPart& part : job.parts) {
        CornerLayers layers{job.normals[part.index].normals, {}, {}};
        if (!uvs[part.index].empty()) layers.uvs.push_back(std::move(uvs[part.index]));
        JoinedPart joined = join_corners(part, layers);
        transfer_skin_and_morphs(part, joined);
        for (Index f : part.small->history.kept_faces) {
            joined.part.face_material.push_back(groups.of(face_material(*part.source, f)));
        }
        out.parts.push_back(std::move(joined.part));
    }
    return true;
}

}  // namespace faqem::detail

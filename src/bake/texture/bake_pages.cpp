#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "asset/scene/material_textures.hpp"
#include "asset/scene/messages.hpp"
#include "bake/atlas/point2.hpp"
#include "bake/texture/bake_job.hpp"
#include "bake/texture/normal_map.hpp"
#include "bake/texture/page_baker.hpp"
#include "bake/texture/page_material.hpp"
#include "bake/transfer/custom_attributes.hpp"
#include "bake/transfer/extension_layers.hpp"
#include "bake/transfer/vertex_attributes.hpp"
#include "faqem/engine/mesh/vector.hpp"

namespace faqem::detail {
namespace {

// The page of a material group.
struct GroupPage {
    Index material = no_index;  // the group's first material
    Channels channels;
    std::vector<PageFace> faces;
    std::vector<ExtensionLayer> layers;
    std::optional<PageAtlas> atlas;  // empty if no image is needed
};

bool has_non_white_colors(const Part& part) {
    return std::any_of(part.colors.begin(), part.colors.end(), [](const Vec4f& c) {
        return c != Vec4f{1, 1, 1, 1};
    });
}

// Channels that need an image: those for which a material has one, or for which the factors differ.
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
        pages[g].material = groups.groups[g].materials.front();
        pages[g].channels = needed_channels(job.source, groups.groups[g]);
        std::vector<ExtensionLayer>& layers = pages[g].layers;
        layers = extension_layers(groups.groups[g].material);
        const auto is_normal_map = [](const ExtensionLayer& layer) { return layer.is_normal_map(); };
        if (job.options.bake.normal_map == NormalMap::off) std::erase_if(layers, is_normal_map);
        pages[g].channels.layers = !layers.empty();
        pages[g].channels.layer_normals = std::any_of(layers.begin(), layers.end(), is_normal_map);
    }
    for (const BakePart& part : job.parts) {
        if (job.skipped[part.index]) continue;
        const bool colors = has_non_white_colors(*part.source);
        const std::vector<Index>& kept = part.simplified->history.kept_faces;
        for (Index f = 0; f < part.faces(); ++f) {
            GroupPage& page = pages[groups.group_of(face_material(*part.source, kept[f]))];
            page.faces.push_back({part.index, f});
            page.channels.base = page.channels.base || colors;
        }
    }
    for (std::size_t g = 0; g < pages.size(); ++g) {
        pages[g].channels.normal = wants_normal_map(job, groups.groups[g], pages[g].faces);
    }
    return pages;
}

void warn_of_normal_maps(BakeJob& job, const MaterialGroups& groups, const std::vector<GroupPage>& pages) {
    for (std::size_t g = 0; g < pages.size(); ++g) {
        if (pages[g].channels.normal) continue;
        for (Index m : groups.groups[g].materials) {
            if (!material_or_default(job.source, m).normal_texture) continue;
            job.warn(material_title(job.source, m) + ": the normal map was left out");
        }
    }
}

// UVs by part and corner, in [0, 1].
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
                const Point2& uv = atlas.placements[i].uv[c];
                uvs[std::size_t{3} * face.face + c] = {static_cast<float>(uv.x / atlas.width),
                                                       static_cast<float>(uv.y / atlas.height)};
            }
        }
    }
    return result;
}

// Pages whose texel density is a smaller fraction of the source's cause a warning. The usual reasons are a
// tiled texture that does not fit on a page, and many textures on one page.
constexpr double min_relative_density = 0.5;

// Texel density of the page divided by that of the source, both root mean squares over the simplified
// surface.
double relative_density(const BakeJob& job, const SourceSampler& sampler, const GroupPage& page) {
    std::vector<double> densities(page.faces.size());  // of the source at the middle of the face
    parallel_blocks(page.faces.size(), 256, job.workers(), [&](std::size_t begin, std::size_t end) {
        constexpr double third = 1.0 / 3;
        for (std::size_t i = begin; i < end; ++i) {
            const PageFace& at = page.faces[i];
            const SurfacePoint point = job.parts[at.part].map->map(at.face, {third, third, third});
            densities[i] = sampler.texel_density(at.part, point.face);
        }
    });
    double own = 0, wanted = 0;
    for (std::size_t i = 0; i < page.faces.size(); ++i) {
        const PageFace& at = page.faces[i];
        const BakePart& part = job.parts[at.part];
        const Triangle& t = part.simplified->mesh.triangles[at.face];
        const auto corner = [&](std::size_t k) {
            return engine::to_eigen(part.simplified->mesh.positions[t[k]]);
        };
        const Triangle2& uv = page.atlas->atlas.placements[i].uv;
        const double area = engine::area_vector(corner(0), corner(1), corner(2)).norm();
        const double texels = std::abs(twice_signed_area(uv[0], uv[1], uv[2]));
        if (!std::isfinite(area * densities[i] * densities[i])) continue;
        own += texels;
        wanted += area * densities[i] * densities[i];
    }
    return wanted > 0 ? std::sqrt(own / wanted) : 0;
}

void add_to_report(BakeJob& job, const SourceSampler& sampler, const GroupPage& page, PageImages& images) {
    const Atlas& atlas = page.atlas->atlas;
    const Index material = static_cast<Index>(job.result.asset.materials.size());
    BakedPage baked = page.atlas->summary;
    baked.material = material_or_default(job.source, page.material).name;
    baked.fill = static_cast<double>(images.texels) / (static_cast<double>(atlas.width) * atlas.height);
    baked.density = relative_density(job, sampler, page);
    baked.samples = images.samples;
    baked.uncertain_texels = images.uncertain_texels;
    if (baked.density > 0 &&
        baked.density < min_relative_density * job.options.bake.texel_density.value_or(1)) {
        const std::string side = std::to_string(std::lround(1 / baked.density));
        job.warn("atlas of " + material_title(job.source, page.material) + ": one texel for " + side + " x " +
                 side + " texels of the source; texture_size is " +
                 std::to_string(job.options.bake.texture_size));
    }
    job.result.report.pages.push_back(std::move(baked));
    if (page.atlas->summary.faces_outside_charts > 0) {
        job.warn("atlas: " + std::to_string(page.atlas->summary.faces_outside_charts) +
                 " faces became charts of their own because the work limit of their region was reached");
    }
    if (job.options.bake.correspondence == Recording::on) {
        job.result.correspondence.push_back({material, atlas.width, atlas.height, std::move(images.origins)});
    }
}

// Tangents by part and corner; empty for parts without a normal map.
std::vector<std::vector<Vec4f>> corner_tangents(const BakeJob& job, const std::vector<GroupPage>& pages,
                                                const std::vector<std::vector<Vec2f>>& uvs) {
    std::vector<std::vector<Vec4f>> result(job.parts.size());
    for (const GroupPage& page : pages) {
        if (!page.atlas || !page.channels.needs_tangents()) continue;
        for (std::size_t begin = 0, end = 0; begin < page.faces.size(); begin = end) {
            const Index part = page.faces[begin].part;
            std::vector<Index> faces;
            for (; end < page.faces.size() && page.faces[end].part == part; ++end) {
                faces.push_back(page.faces[end].face);
            }
            set_tangents(job.parts[part], job.normals[part], faces, uvs[part], result[part]);
        }
    }
    return result;
}

// Removes the UVs of parts that no texture of the result is on, and the tangents where no normal map is. With a
// correspondence, UVs are kept: they place the faces on the page that it describes.
void remove_unused_uvs(const BakeJob& job, const std::vector<GroupPage>& pages,
                       std::vector<std::vector<Vec2f>>& uvs, std::vector<std::vector<Vec4f>>& tangents) {
    std::vector<bool> has_texture(job.parts.size(), job.options.bake.correspondence == Recording::on);
    std::vector<bool> has_normal_map(job.parts.size(), false);
    for (std::size_t g = 0; g < pages.size(); ++g) {
        const Material& material = job.result.asset.materials[g];
        const bool textured = has_textures(material), bumpy = tangent_texture(material) != nullptr;
        for (const PageFace& face : pages[g].faces) {
            if (textured) has_texture[face.part] = true;
            if (bumpy) has_normal_map[face.part] = true;
        }
    }
    for (std::size_t p = 0; p < job.parts.size(); ++p) {
        if (!has_texture[p]) uvs[p].clear();
        if (!has_normal_map[p]) tangents[p].clear();
    }
}

}  // namespace

bool bake_pages(BakeJob& job) {
    const MaterialGroups groups = group_materials(job.source, job.options.bake, job.skipped);
    std::vector<GroupPage> pages = group_pages(job, groups);
    Channels wanted;
    for (const GroupPage& page : pages) wanted = wanted | page.channels;
    const SourceSampler sampler(job.source, wanted, job.workers(), job.skipped, &job.images);
    job.images.clear();  // the sampler has those that it needs
    double pieces = 0;
    for (GroupPage& page : pages) {
        if (!page.channels.any() || page.faces.empty()) continue;
        page.atlas = make_page_atlas(job, sampler, page.faces);
        if (!page.atlas) return false;
        pieces += static_cast<double>(page.atlas->pieces());
    }
    warn_of_normal_maps(job, groups, pages);
    std::vector<std::vector<Vec2f>> uvs = corner_uvs(job, pages);
    std::vector<std::vector<Vec4f>> tangents = corner_tangents(job, pages, uvs);
    Asset& out = job.result.asset;
    double done = 0;
    for (std::size_t g = 0; g < pages.size(); ++g) {
        const GroupPage& page = pages[g];
        const Material& first = groups.groups[g].material;
        PageImages images;
        if (page.atlas) {
            images =
                bake_page(job, sampler,
                          {page.atlas->atlas, page.atlas->charts, page.atlas->tiles, page.atlas->adjacent,
                           page.faces, tangents, page.channels, first.alpha_mode, page.layers, page.material},
                          done, pieces);
            done += static_cast<double>(page.atlas->pieces());
        }
        if (page.atlas) add_to_report(job, sampler, page, images);
        out.materials.push_back(page_material(job, groups.groups[g], page.atlas ? page.channels : Channels{},
                                              page.layers, std::move(images)));
    }
    remove_unused_uvs(job, pages, uvs, tangents);
    for (const BakePart& part : job.parts) {
        if (job.skipped[part.index]) {
            out.parts.emplace_back();
            continue;
        }
        CornerValues values{job.normals[part.index].normals, {}, {}, std::move(tangents[part.index])};
        if (!uvs[part.index].empty()) values.uvs.push_back(std::move(uvs[part.index]));
        values.custom = corner_custom_attributes(part, job.cancellation_check());
        WeldedPart welded = weld_corners(part, values);
        transfer_skin_and_morphs(part, welded, job.cancellation_check());
        for (Index f : part.simplified->history.kept_faces) {
            welded.part.face_material.push_back(groups.group_of(face_material(*part.source, f)));
        }
        out.parts.push_back(std::move(welded.part));
    }
    return true;
}

}  // namespace faqem::detail

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "asset/scene/material_textures.hpp"
#include "asset/scene/messages.hpp"
#include "bake/page/normal_map.hpp"
#include "bake/page/page_baker.hpp"
#include "bake/page/page_layout.hpp"
#include "bake/page/page_mesh.hpp"
#include "bake/parts/corner_transfer.hpp"
#include "bake/parts/output_part.hpp"
#include "bake/source/extension_layers.hpp"
#include "bake/source/page_groups.hpp"
#include "bake/texture/bake_job.hpp"
#include "bake/texture/page_material.hpp"
#include "faqem/detail/base/parallel.hpp"
#include "scene/material_groups.hpp"

namespace faqem::detail {
namespace {

// The page of a material group.
struct Page {
    Channels channels;
    std::vector<ExtensionLayer> layers;
    PageMesh mesh;                     // only its faces, if no image is needed
    std::optional<PageLayout> layout;  // empty if no image is needed
};

// By part and corner; empty for parts without.
struct PartUvs {
    std::vector<std::vector<Vec2f>> uvs;       // in [0, 1]
    std::vector<std::vector<Vec4f>> tangents;  // for normal maps
};

// Channels that need an image: those for which a material has one, or for which the factors differ.
Channels needed_channels(const Asset& asset, const MaterialGroup& group) {
    Channels result;
    const Material& first = group.material;
    const auto add = [&](CoreTexture texture, bool is_needed) {
        const bool is_shown = !first.unlit || texture == CoreTexture::base_color;
        result[texture] = result[texture] || (is_needed && is_shown);
    };
    for (Index m : group.materials) {
        const Material& material = material_or_default(asset, m);
        for (std::size_t i = 0; i < core_slots.size(); ++i)
            if (core_slots[i].content != TextureContent::normal)
                add(static_cast<CoreTexture>(i), bool(material.*core_slots[i].texture));
        add(CoreTexture::base_color, material.base_color != first.base_color);
        add(CoreTexture::metallic_roughness,
            material.metallic != first.metallic || material.roughness != first.roughness);
        add(CoreTexture::emissive, material.emissive != first.emissive);
    }
    return result;
}

void plan_layers(const Material& material, NormalMap normal_map, Page& page) {
    const auto is_normal_map = [](const ExtensionLayer& layer) { return layer.is_normal_map(); };
    page.layers = extension_layers(material);
    if (normal_map == NormalMap::off) std::erase_if(page.layers, is_normal_map);
    page.channels.layers = !page.layers.empty();
    page.channels.layer_normals = std::ranges::any_of(page.layers, is_normal_map);
}

// The pages of all groups, with their faces and channels.
std::vector<Page> plan_pages(const BakeJob& job, const MaterialGroups& groups) {
    std::vector<Page> pages(groups.groups.size());
    for (std::size_t g = 0; g < pages.size(); ++g) {
        pages[g].channels = needed_channels(job.source, groups.groups[g]);
        plan_layers(groups.groups[g].material, job.options.normal_map, pages[g]);
    }
    for (const BakePart& part : job.parts) {
        if (part.is_kept) continue;
        const bool colors = has_non_white_colors(*part.source);
        const std::vector<Index> materials = remaining_materials(part);
        for (Index f = 0; f < part.faces(); ++f) {
            Page& page = pages[groups.group_of(materials[f])];
            page.mesh.faces.push_back({part.index, f});
            page.channels[CoreTexture::base_color] = page.channels[CoreTexture::base_color] || colors;
        }
    }
    for (std::size_t g = 0; g < pages.size(); ++g) {
        pages[g].channels[CoreTexture::normal] =
            wants_normal_map(job.options.normal_map, job.source, groups.groups[g], job.parts,
                             pages[g].mesh.faces, job.context);
    }
    return pages;
}

// By triangle of a page: BakePart::given_uvs, if all have them.
std::vector<Triangle2> given_uvs(std::span<const BakePart> parts, std::span<const PageFace> faces) {
    std::vector<Triangle2> result;
    for (const PageFace& at : faces) {
        const std::vector<Vec2f>& uvs = parts[at.part].given_uvs;
        if (uvs.empty()) return {};
        Triangle2& triangle = result.emplace_back();
        for (std::size_t c = 0; c < 3; ++c) {
            const Vec2f& uv = uvs[std::size_t{3} * at.face + c];
            triangle[c] = {uv[0], uv[1]};
        }
    }
    return result;
}

// Lays out the pages that need an image, several at a time: the steps of a single page do not keep all threads busy.
// \return false as bake_pages()
bool layout_pages(const BakeJob& job, const SourceSampler& sampler, std::vector<Page>& pages) {
    const auto needs_layout = [](const Page& page) {
        return page.channels.any() && !page.mesh.faces.empty();
    };
    parallel_blocks(
        pages.size(), 1, job.context, [&](std::size_t i, std::size_t, const RunContext& block_context) {
            Page& page = pages[i];
            if (!needs_layout(page)) return;
            page.mesh =
                make_page_mesh(job.parts, std::move(page.mesh.faces), sampler, job.options, block_context);
            page.layout = layout_page(page.mesh, given_uvs(job.parts, page.mesh.faces), job.options.kind,
                                      job.options.texture_size, block_context);
        });
    return std::ranges::all_of(pages, [&](const Page& page) { return page.layout || !needs_layout(page); });
}

void warn_of_normal_maps(const Asset& source, const MaterialGroups& groups, const std::vector<Page>& pages,
                         std::vector<std::string>& warnings) {
    for (std::size_t g = 0; g < pages.size(); ++g) {
        if (pages[g].channels[CoreTexture::normal]) continue;
        for (Index m : groups.groups[g].materials)
            if (material_or_default(source, m).normal_texture)
                warnings.push_back(material_title(source, m) + ": the normal map was left out");
    }
}

void set_uvs(std::span<const BakePart> parts, const Page& page, std::vector<std::vector<Vec2f>>& uvs) {
    const Atlas& atlas = page.layout->atlas;
    for (std::size_t i = 0; i < page.mesh.faces.size(); ++i) {
        const PageFace& face = page.mesh.faces[i];
        uvs[face.part].resize(3 * parts[face.part].faces(), Vec2f{0, 0});
        for (std::size_t c = 0; c < 3; ++c) {
            const Point2& uv = atlas.placements[i][c];
            uvs[face.part][std::size_t{3} * face.face + c] = {static_cast<float>(uv.x / atlas.width),
                                                              static_cast<float>(uv.y / atlas.height)};
        }
    }
}

void set_page_tangents(std::span<const BakePart> parts, const Page& page, PartUvs& to) {
    const std::vector<PageFace>& all = page.mesh.faces;
    for (std::size_t begin = 0, end = 0; begin < all.size(); begin = end) {
        const Index part = all[begin].part;
        std::vector<Index> faces;
        for (; end < all.size() && all[end].part == part; ++end) faces.push_back(all[end].face);
        set_tangents(parts[part], faces, to.uvs[part], to.tangents[part]);
    }
}

PartUvs uvs_of_pages(std::span<const BakePart> parts, const std::vector<Page>& pages) {
    PartUvs result{std::vector<std::vector<Vec2f>>(parts.size()),
                   std::vector<std::vector<Vec4f>>(parts.size())};
    for (const Page& page : pages)
        if (page.layout) set_uvs(parts, page, result.uvs);
    for (const Page& page : pages)
        if (page.layout && page.channels.needs_tangents()) set_page_tangents(parts, page, result);
    return result;
}

// Pages whose texel density is a smaller fraction of the source's cause a warning, and those on which that of a material
// is. The usual reasons are a tiled texture that does not fit on a page, many textures on one page, and a label whose
// texels are much smaller than those around it.
constexpr double min_relative_density = 0.5, min_density_of_material = 0.25;

void report_page(const BakeJob& job, const Page& page, Index first_material, const PageImages& images,
                 Report& report) {
    const Atlas& atlas = page.layout->atlas;
    BakedPage baked = page.layout->summary;
    baked.material = material_or_default(job.source, first_material).name;
    baked.fill = static_cast<double>(images.texels) / (static_cast<double>(atlas.width) * atlas.height);
    const PageDensity density = relative_density(job.parts, page.mesh, atlas);
    baked.density = density.mean;
    baked.samples = images.samples;
    baked.uncertain_texels = images.uncertain_texels;
    const double wanted = job.options.texel_density.value_or(1);
    if (density.mean > 0 &&
        (density.mean < min_relative_density * wanted || density.lowest < min_density_of_material * wanted)) {
        const std::string side = std::to_string(std::lround(1 / density.lowest));
        const std::string where =
            density.material == first_material ? "" : " in " + material_title(job.source, density.material);
        report.warnings.push_back("atlas of " + material_title(job.source, first_material) +
                                  ": one texel for " + side + " x " + side + " texels of the source" + where +
                                  "; texture_size is " + std::to_string(job.options.texture_size));
    }
    if (baked.faces_outside_charts > 0) {
        report.warnings.push_back("atlas: " + std::to_string(baked.faces_outside_charts) +
                                  " faces became charts of their own because the work limit of their region "
                                  "was reached");
    }
    report.pages.push_back(std::move(baked));
}

// Bakes the images of all pages, and makes their materials.
void bake_images(const BakeJob& job, const SourceSampler& sampler, const MaterialGroups& groups,
                 const std::vector<Page>& pages, const PartUvs& uvs, UnencodedResult& out) {
    std::size_t pieces = 0;
    for (const Page& page : pages) pieces += page.layout ? page.layout->pieces() : 0;
    const auto share = [&](std::size_t done) {
        return static_cast<double>(done) / static_cast<double>(pieces);
    };
    std::size_t done = 0;
    std::vector<Material>& materials = out.asset.asset.materials;
    for (std::size_t g = 0; g < pages.size(); ++g) {
        const Page& page = pages[g];
        const MaterialGroup& group = groups.groups[g];
        if (!page.layout) {
            materials.push_back(page_material(job.source, job.options, group, {}, {}, {}, out));
            continue;
        }
        const bool records_origins = job.options.correspondence == Recording::on;
        const std::size_t before = std::exchange(done, done + page.layout->pieces());
        PageImages images = bake_page({job.parts, sampler, page.mesh, *page.layout, uvs.tangents,
                                       page.channels, group.material.alpha_mode, page.layers,
                                       group.materials.front(), job.options.samples, records_origins},
                                      share(before), share(done), job.context);
        out.missing_texels += images.missing_texels;
        out.shown_texels += static_cast<std::uint64_t>(std::ranges::count(images.known, 1));
        report_page(job, page, group.materials.front(), images, out.asset.report);
        if (records_origins) {
            const Atlas& atlas = page.layout->atlas;
            out.asset.correspondence.push_back(
                {static_cast<Index>(materials.size()), atlas.width, atlas.height, std::move(images.origins)});
        }
        materials.push_back(page_material(job.source, job.options, group, page.channels, page.layers,
                                          std::move(images), out));
    }
}

// Removes the UVs of parts that no texture of the result is on, and the tangents where no normal map is. With a
// correspondence, UVs are kept: they place the faces on the page that it describes.
void remove_unused_uvs(const std::vector<Page>& pages, const std::vector<Material>& materials, bool keeps_uvs,
                       PartUvs& of) {
    std::vector<bool> has_texture(of.uvs.size(), keeps_uvs), has_normal_map(of.uvs.size(), false);
    for (std::size_t g = 0; g < pages.size(); ++g) {
        const bool textured = has_textures(materials[g]), bumpy = tangent_texture(materials[g]) != nullptr;
        for (const PageFace& face : pages[g].mesh.faces) {
            if (textured) has_texture[face.part] = true;
            if (bumpy) has_normal_map[face.part] = true;
        }
    }
    for (std::size_t p = 0; p < of.uvs.size(); ++p) {
        if (!has_texture[p]) of.uvs[p].clear();
        if (!has_normal_map[p]) of.tangents[p].clear();
    }
}

// Warns of the UV sets of a part that neither its textures nor the result use.
void warn_of_dropped_uvs(const Asset& source, const BakePart& part, std::vector<std::string>& warnings) {
    std::vector<std::uint8_t> is_used(part.source->uvs.size(), 0);
    for (const Index m : materials_of(*part.source))
        for_each_texture(source.materials[m], [&](const TextureRef& texture) {
            if (texture && texture.uv_set < is_used.size()) is_used[texture.uv_set] = 1;
        });
    std::string sets;
    for (std::size_t s = 0; s < is_used.size(); ++s)
        if (!is_used[s]) sets += (sets.empty() ? "" : ", ") + std::to_string(s);
    if (!sets.empty() && part.faces() > 0)
        warnings.push_back(part_title(source, part.index) +
                           ": texture coordinates that no texture uses were left out for a new page: set " +
                           sets);
}

// The parts of the result. Those without a texture keep the UVs of the source, if these had none either.
void add_parts(const BakeJob& job, const MaterialGroups& groups, PartUvs& from, UnencodedResult& out) {
    std::uint64_t crossing_faces = 0;
    for (const BakePart& part : job.parts) {
        Part& to = out.asset.asset.parts.emplace_back();
        if (part.is_kept) continue;
        CornerValues values;
        std::vector<Index> materials = remaining_materials(part);
        if (from.uvs[part.index].empty() && part.faces() > 0 &&
            has_spare_uvs_only(job.source, *part.source)) {
            KeptCorners kept = kept_corners(part, job.context);
            values.uvs = std::move(kept.values.uvs);
            crossing_faces += kept.crossing_faces;
        } else {
            warn_of_dropped_uvs(job.source, part, out.asset.report.warnings);
        }
        values.tangents = std::move(from.tangents[part.index]);
        if (!from.uvs[part.index].empty()) values.uvs.push_back(std::move(from.uvs[part.index]));
        for (Index& m : materials) m = groups.group_of(m);
        to = make_output_part(part, std::move(values), std::move(materials), job.context);
    }
    warn_of_crossing_faces(crossing_faces, out.asset.report.warnings);
}

}  // namespace

bool bake_pages(const BakeJob& job, DecodedImages decoded, UnencodedResult& out) {
    const std::vector<std::uint8_t> kept = kept_flags(job.parts);
    const MaterialGroups groups = page_groups(job.source, job.options, kept);
    std::vector<Page> pages = plan_pages(job, groups);
    Channels wanted;
    for (const Page& page : pages) wanted = wanted | page.channels;
    const SourceSampler sampler(job.source, wanted, job.context, kept, &decoded);
    decoded.clear();  // the sampler has those that it needs
    if (!layout_pages(job, sampler, pages)) return false;
    warn_of_normal_maps(job.source, groups, pages, out.asset.report.warnings);
    PartUvs uvs = uvs_of_pages(job.parts, pages);
    bake_images(job, sampler, groups, pages, uvs, out);
    remove_unused_uvs(pages, out.asset.asset.materials, job.options.correspondence == Recording::on, uvs);
    add_parts(job, groups, uvs, out);
    return true;
}

}  // namespace faqem::detail

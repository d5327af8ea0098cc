#include "bake/source/page_groups.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "asset/image/image_size.hpp"
#include "asset/scene/material_textures.hpp"
#include "render/texture_sampling.hpp"

namespace faqem::detail {
namespace {

// The texture of a material whose image has the most texels.
struct FinestTexture {
    Index image = no_index;  // no_index: the material has no texture
    std::uint32_t uv_set = 0;
    double texels = 0;      // of the image
    double repetition = 1;  // images per unit of area in UV space
};

std::vector<double> image_texels(const Asset& asset) {
    std::vector<double> texels;
    for (const Image& image : asset.images) texels.push_back(static_cast<double>(readable_pixels(image)));
    return texels;
}

// By material, the default material last.
std::vector<FinestTexture> finest_textures(const Asset& asset) {
    const std::vector<double> texels = image_texels(asset);
    std::vector<FinestTexture> result(asset.materials.size() + 1);
    for (std::size_t m = 0; m < asset.materials.size(); ++m) {
        for_each_texture(asset.materials[m], [&](const TextureRef& texture) {
            if (!texture || !(texels[texture.image] > result[m].texels)) return;
            const double repetition = std::abs(double{texture.scale[0]} * double{texture.scale[1]});
            result[m] = {texture.image, texture.uv_set, texels[texture.image], repetition};
        });
    }
    return result;
}

// Texels of every image that the faces whose material has it as its finest one show, each texel at most once.
std::vector<double> texels_shown_of_images(const Asset& asset, std::span<const FinestTexture> finest,
                                           std::span<const std::uint8_t> skipped_parts) {
    std::vector<double> shown(asset.images.size(), 0);
    for (std::size_t p = 0; p < asset.parts.size(); ++p) {
        if (!skipped_parts.empty() && skipped_parts[p]) continue;
        const Part& part = asset.parts[p];
        for (std::size_t f = 0; f < part.triangles.size(); ++f) {
            const Index material = face_material(part, f);
            if (material == no_index) continue;
            const FinestTexture& texture = finest[material];
            if (texture.image == no_index || texture.uv_set >= part.uvs.size()) continue;
            const double texels =
                texture.texels * texture.repetition * uv_area(part.uvs[texture.uv_set], part.triangles[f]);
            if (texels > 0) shown[texture.image] = std::min(shown[texture.image] + texels, texture.texels);
        }
    }
    return shown;
}

// Appends the pages of a group.
void split_group(const MaterialGroup& group, const Asset& asset, std::span<const FinestTexture> finest,
                 const std::vector<double>& shown, double page_texels, std::vector<MaterialGroup>& to) {
    const auto image_of = [&](Index m) { return m == no_index ? no_index : finest[m].image; };
    std::vector<Index> images;  // each once, in the order of the materials
    double total = 0;
    for (const Index m : group.materials) {
        const Index image = image_of(m);
        if (image == no_index || std::find(images.begin(), images.end(), image) != images.end()) continue;
        images.push_back(image);
        total += shown[image];
    }
    const double pages = std::min(std::round(total / page_texels), static_cast<double>(images.size()));
    if (!(pages >= 2)) return to.push_back(group);
    std::vector<std::size_t> page_of_image;
    double before = 0;
    for (const Index image : images) {
        const double middle = (before + shown[image] / 2) / total;  // of the image's share, in [0, 1]
        page_of_image.push_back(static_cast<std::size_t>(std::min(std::floor(middle * pages), pages - 1)));
        before += shown[image];
    }
    std::vector<MaterialGroup> split(static_cast<std::size_t>(pages));
    for (const Index m : group.materials) {
        const auto image = std::find(images.begin(), images.end(), image_of(m));
        const std::size_t page =
            image == images.end() ? 0 : page_of_image[static_cast<std::size_t>(image - images.begin())];
        MaterialGroup& own = split[page];
        if (own.materials.empty()) own.material = material_or_default(asset, m);
        own.materials.push_back(m);
    }
    for (MaterialGroup& own : split)
        if (!own.materials.empty()) to.push_back(std::move(own));
}

}  // namespace

MaterialGroups page_groups(const Asset& asset, const BakeOptions& bake,
                           std::span<const std::uint8_t> skipped_parts) {
    const MaterialGroups merged = group_materials(asset, bake, skipped_parts);
    const std::vector<FinestTexture> finest = finest_textures(asset);
    const std::vector<double> shown = texels_shown_of_images(asset, finest, skipped_parts);
    const double side = bake.texture_size / bake.texel_density.value_or(1);
    MaterialGroups result{{}, merged.group_of_material};
    for (const MaterialGroup& group : merged.groups)
        split_group(group, asset, finest, shown, side * side, result.groups);
    for (std::size_t g = 0; g < result.groups.size(); ++g) {
        for (const Index m : result.groups[g].materials) {
            const std::size_t slot = m == no_index ? asset.materials.size() : m;
            result.group_of_material[slot] = static_cast<Index>(g);
        }
    }
    return result;
}

}  // namespace faqem::detail

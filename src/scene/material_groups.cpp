#include "scene/material_groups.hpp"

#include <algorithm>

#include "asset/scene/material_textures.hpp"

namespace faqem::detail {
namespace {

bool has_equal_factors(const Material& a, const Material& b) {
    return a.base_color == b.base_color && a.metallic == b.metallic && a.roughness == b.roughness &&
           a.emissive == b.emissive;
}

bool can_merge(const Material& a, const Material& b, Bake kind) {
    if (!a.extensions.empty() || !b.extensions.empty()) return false;
    if (!a.extension_textures.empty() || !b.extension_textures.empty()) return false;
    if (a.alpha_mode != b.alpha_mode || a.double_sided != b.double_sided || a.unlit != b.unlit) return false;
    if (a.alpha_mode == AlphaMode::mask && a.alpha_cutoff != b.alpha_cutoff) return false;
    if (kind != Bake::vertex) return true;
    return a.metallic == b.metallic && a.roughness == b.roughness && a.emissive == b.emissive &&
           !a.emissive_texture == !b.emissive_texture;
}

}  // namespace

bool has_plain_materials(const Asset& asset, const BakeOptions& bake) {
    if (bake.kind != Bake::automatic || bake.normal_map == NormalMap::on ||
        bake.correspondence == Recording::on)
        return false;
    return std::none_of(asset.materials.begin(), asset.materials.end(),
                        [](const Material& material) { return has_textures(material); }) &&
           std::none_of(asset.parts.begin(), asset.parts.end(), [](const Part& part) {
               return !part.colors.empty() || !part.joints.empty() || !part.morph_targets.empty();
           });
}

const Material& material_or_default(const Asset& asset, Index material) {
    static const Material standard;
    return material == no_index ? standard : asset.materials[material];
}

std::vector<Index> materials_of(const Part& part) {
    std::vector<Index> result = part.face_material;
    std::sort(result.begin(), result.end());
    result.erase(std::unique(result.begin(), result.end()), result.end());
    if (!result.empty() && result.back() == no_index) result.pop_back();
    return result;
}

std::vector<bool> used_materials(const Asset& asset, std::span<const std::uint8_t> skipped_parts) {
    const std::size_t count = asset.materials.size();
    std::vector<bool> used(count + 1, false);
    for (std::size_t p = 0; p < asset.parts.size(); ++p) {
        if (!skipped_parts.empty() && skipped_parts[p]) continue;
        const Part& part = asset.parts[p];
        for (std::size_t f = 0; f < part.triangles.size(); ++f)
            used[std::min<std::size_t>(face_material(part, f), count)] = true;
    }
    return used;
}

MaterialGroups group_materials(const Asset& asset, const BakeOptions& bake,
                               std::span<const std::uint8_t> skipped_parts) {
    const bool is_plain = has_plain_materials(asset, bake);
    const std::size_t count = asset.materials.size();
    const std::vector<bool> used = used_materials(asset, skipped_parts);
    MaterialGroups result;
    result.group_of_material.assign(count + 1, no_index);
    for (std::size_t m = 0; m <= count; ++m) {
        if (!used[m]) continue;
        const Index index = m == count ? no_index : static_cast<Index>(m);
        const Material& material = material_or_default(asset, index);
        std::size_t g = 0;
        const auto fits = [&](const Material& first) {
            return can_merge(first, material, bake.kind) && (!is_plain || has_equal_factors(first, material));
        };
        while (g < result.groups.size() && !fits(result.groups[g].material)) ++g;
        if (g == result.groups.size()) result.groups.push_back({material, {}});
        result.groups[g].materials.push_back(index);
        result.group_of_material[m] = static_cast<Index>(g);
    }
    return result;
}

}  // namespace faqem::detail

#include "scene/material_groups.hpp"

#include <algorithm>
#include <tuple>

#include "asset/scene/part_arrays.hpp"
#include "faqem/engine/mesh/index_lists.hpp"
#include "faqem/engine/mesh/weld.hpp"
#include "scene/vector_conversion.hpp"

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

// Properties by which coincident faces look different: the material, and whether the winding contradicts the normals.
using FaceAppearance = std::pair<Index, bool>;

bool is_wound_against_normals(const Part& part, const Triangle& t) {
    if (part.normals.empty()) return false;
    Vector3 normal = Vector3::Zero();
    for (const Index v : t) normal += to_vector(part.normals[v]);
    return normal.dot(area_vector(part.positions, t)) < 0;
}

std::vector<FaceAppearance> face_appearances(const Part& part) {
    std::vector<FaceAppearance> result;
    result.reserve(part.triangles.size());
    for (const Triangle& t : part.triangles)
        result.push_back(
            {face_material(part, static_cast<Index>(result.size())), is_wound_against_normals(part, t)});
    return result;
}

// Welded corners by face, the smallest one first: duplicate faces are equal, faces of opposite winding are
// not.
std::vector<Triangle> canonical_corners(const Part& part) {
    const std::vector<Index> representative = engine::weld_exact(part.positions);
    std::vector<Triangle> result;
    result.reserve(part.triangles.size());
    for (const Triangle& t : part.triangles) {
        Triangle& p =
            result.emplace_back(Triangle{representative[t[0]], representative[t[1]], representative[t[2]]});
        std::rotate(p.begin(), std::ranges::min_element(p), p.end());
    }
    return result;
}

}  // namespace

bool has_plain_materials(const Asset& asset, const BakeOptions& bake) {
    if (bake.kind != Bake::automatic || bake.normal_map == NormalMap::on ||
        bake.correspondence == Recording::on)
        return false;
    return std::ranges::none_of(asset.materials,
                                [](const Material& material) { return has_textures(material); }) &&
           !some_part_has(asset, &Part::colors) && !some_part_has(asset, &Part::joints) &&
           !some_part_has(asset, &Part::morph_targets);
}

std::vector<Index> materials_of(const Part& part) {
    std::vector<Index> result = part.face_material;
    std::ranges::sort(result);
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

bool has_non_white_colors(const Part& part) {
    return std::ranges::any_of(part.colors, [](const Vec4f& c) { return c != Vec4f{1, 1, 1, 1}; });
}

bool has_spare_uvs_only(const Asset& asset, const Part& part) {
    const std::vector<Index> materials = materials_of(part);
    return !part.uvs.empty() && !has_non_white_colors(part) &&
           std::ranges::none_of(materials, [&](Index m) { return has_textures(asset.materials[m]); });
}

std::vector<std::uint8_t> parts_with_own_uvs(const Asset& asset, const BakeOptions& bake) {
    std::vector<std::uint8_t> result(asset.parts.size(), 0);
    if (!makes_atlas(bake.kind) || bake.normal_map == NormalMap::on || bake.correspondence == Recording::on)
        return result;
    const MaterialGroups groups = group_materials(asset, bake);
    std::vector<std::uint8_t> has_page;
    for (const MaterialGroup& group : groups.groups)
        has_page.push_back(std::ranges::any_of(group.materials, [&](Index m) {
            const Material& material = material_or_default(asset, m);
            return has_textures(material) || !has_equal_factors(material, group.material);
        }));
    const auto page_of = [&](const Part& part, std::size_t f) -> std::uint8_t& {
        return has_page[groups.group_of(face_material(part, f))];
    };
    for (const Part& part : asset.parts)
        if (has_non_white_colors(part))
            for (std::size_t f = 0; f < part.triangles.size(); ++f) page_of(part, f) = 1;
    for (std::size_t p = 0; p < result.size(); ++p) {
        const Part& part = asset.parts[p];
        result[p] = has_spare_uvs_only(asset, part);
        for (std::size_t f = 0; result[p] && f < part.triangles.size(); ++f) result[p] = !page_of(part, f);
    }
    return result;
}

std::vector<Index> separate_coincident_faces(const Part& part, std::vector<Index> groups) {
    const std::vector<FaceAppearance> appearances = face_appearances(part);
    if (appearances.empty() || std::equal(appearances.begin() + 1, appearances.end(), appearances.begin()))
        return groups;
    const std::vector<Triangle> corners = canonical_corners(part);
    const auto group = [&](Index f) { return groups.empty() ? Index{0} : groups[f]; };
    std::vector<Index> order = engine::all_indices(corners.size());
    std::ranges::sort(order, {}, [&](Index f) { return std::tuple(corners[f], group(f), f); });
    std::vector<Index> separated;
    for (std::size_t i = 1, first = 0; i < order.size(); ++i) {
        const Index a = order[first], b = order[i];
        if (corners[a] != corners[b] || group(a) != group(b))
            first = i;
        else if (appearances[a] != appearances[b])
            separated.push_back(b);
    }
    if (separated.empty()) return groups;
    if (groups.empty()) groups.assign(corners.size(), 0);
    const Index next = *std::ranges::max_element(groups) + 1;
    for (const Index f : separated) {
        const auto [material, reversed] = appearances[f];
        groups[f] = next + 2 * (material == no_index ? 0 : 1 + material) + (reversed ? 1 : 0);
    }
    return groups;
}

}  // namespace faqem::detail

#include "asset/scene/material_textures.hpp"

#include "asset/gltf/source_document.hpp"

#include <set>
#include <type_traits>
#include <vector>

#include "support/catch.hpp"

using namespace faqem;
using namespace faqem::detail;

namespace {

// A material whose textures have the images 0 to 4, in the order of CoreTexture.
Material numbered_textures() {
    Material material;
    material.base_color_texture.image = 0;
    material.metallic_roughness_texture.image = 1;
    material.normal_texture.image = 2;
    material.occlusion_texture.image = 3;
    material.emissive_texture.image = 4;
    material.normal_scale = 0.5f;
    material.occlusion_strength = 0.25f;
    material.extension_textures.emplace_back().texture.image = 5;
    return material;
}

template <class... Members>
std::set<const TextureRef*> textures_among(const Members&... members) {
    std::set<const TextureRef*> result;
    const auto add = [&](const auto& member) {
        if constexpr (std::is_same_v<decltype(member), const TextureRef&>) result.insert(&member);
    };
    (add(members), ...);
    return result;
}

}  // namespace

TEST_CASE("each core texture of a material has a row") {
    const Material material = numbered_textures();
    const auto& [name, base_color, base_color_texture, metallic, roughness, metallic_roughness_texture,
                 normal_texture, normal_scale, occlusion_texture, occlusion_strength, emissive,
                 emissive_texture, alpha_mode, alpha_cutoff, double_sided, unlit, extension_textures,
                 extensions, source, rebaked] = material;
    std::set<const TextureRef*> listed;
    for (const CoreSlot& slot : core_slots) listed.insert(&(material.*slot.texture));
    CHECK(listed.size() == core_slots.size());
    CHECK(listed == textures_among(name, base_color, base_color_texture, metallic, roughness,
                                   metallic_roughness_texture, normal_texture, normal_scale,
                                   occlusion_texture, occlusion_strength, emissive, emissive_texture,
                                   alpha_mode, alpha_cutoff, double_sided, unlit, extension_textures,
                                   extensions, source, rebaked));
}

TEST_CASE("core textures are numbered in the order of their rows") {
    const Material material = numbered_textures();
    const auto image = [&](CoreTexture texture) {
        return (material.*core_slots.at(static_cast<std::size_t>(texture)).texture).image;
    };
    CHECK(image(CoreTexture::base_color) == 0);
    CHECK(image(CoreTexture::metallic_roughness) == 1);
    CHECK(image(CoreTexture::normal) == 2);
    CHECK(image(CoreTexture::occlusion) == 3);
    CHECK(image(CoreTexture::emissive) == 4);
    std::vector<Index> images;
    for_each_texture(material, [&](const TextureRef& texture) { images.push_back(texture.image); });
    CHECK(images == std::vector<Index>{0, 1, 2, 3, 4, 5});
}

TEST_CASE("core textures are found by their key") {
    for (const CoreSlot& slot : core_slots) CHECK(find_core_slot(slot.key) == &slot);
    CHECK(find_core_slot("occlusionTexture")->texture == &Material::occlusion_texture);
    CHECK_FALSE(find_core_slot("clearcoatTexture"));
}

TEST_CASE("a material without textures has none of their factors") {
    Material material = numbered_textures();
    CHECK(has_textures(material));
    remove_textures(material);
    CHECK_FALSE(has_textures(material));
    CHECK(material.normal_scale == 1);
    CHECK(material.occlusion_strength == 1);
    CHECK(material.extension_textures.empty());
}

TEST_CASE("the default material is metal in scenes of glTF only") {
    Asset asset;
    CHECK(material_or_default(asset, no_index).metallic == 0);
    asset.source = std::make_shared<SourceDocument>();
    CHECK(material_or_default(asset, no_index).metallic == 1);
    asset.materials.resize(1);
    CHECK(&material_or_default(asset, 0) == &asset.materials[0]);
}

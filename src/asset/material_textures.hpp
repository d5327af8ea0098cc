#pragma once
/// \file
/// All textures of a material.

#include "faqem/asset.hpp"

namespace faqem::detail {

/// Calls visit(texture) for the five textures of glTF's material, in a fixed order, whether they are set or not.
/// \param material  Material or const Material
template <class M, class Visit>
void for_each_core_texture(M& material, const Visit& visit) {
    visit(material.base_color_texture);
    visit(material.metallic_roughness_texture);
    visit(material.normal_texture);
    visit(material.occlusion_texture);
    visit(material.emissive_texture);
}

/// As for_each_core_texture(), then those of extensions.
template <class M, class Visit>
void for_each_texture(M& material, const Visit& visit) {
    for_each_core_texture(material, visit);
    for (auto& extension : material.extension_textures) visit(extension.texture);
}

}  // namespace faqem::detail

#pragma once
/// \file
/// Iteration over the textures of a material.

#include "faqem/asset.hpp"

namespace faqem::detail {

/// Calls visit(texture) for the five textures of the core glTF material in a fixed order, including unset
/// ones.
/// \tparam M  Material or const Material
template <class M, class Visit>
void for_each_core_texture(M& material, const Visit& visit) {
    visit(material.base_color_texture);
    visit(material.metallic_roughness_texture);
    visit(material.normal_texture);
    visit(material.occlusion_texture);
    visit(material.emissive_texture);
}

/// Same as for_each_core_texture(), followed by the textures of material extensions.
template <class M, class Visit>
void for_each_texture(M& material, const Visit& visit) {
    for_each_core_texture(material, visit);
    for (auto& extension : material.extension_textures) visit(extension.texture);
}

}  // namespace faqem::detail

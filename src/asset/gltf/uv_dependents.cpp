#include "asset/gltf/uv_dependents.hpp"

#include <algorithm>
#include <string>

#include "asset/gltf/source_document.hpp"

namespace faqem::detail {

std::vector<std::uint8_t> materials_with_moving_textures(const Json& document) {
    std::vector<std::uint8_t> result(array_size(document, "materials"), 0);
    for (const Json& animation : member(document, "animations")) {
        for (const Json& channel : member(animation, "channels")) {
            const std::string pointer = animated_pointer(channel);
            if (pointer.find("/KHR_texture_transform/") == std::string::npos) continue;
            for (std::size_t m = 0; m < result.size(); ++m)
                if (pointer.starts_with("/materials/" + std::to_string(m) + "/")) result[m] = 1;
        }
    }
    return result;
}

std::vector<Index> variant_materials(const Asset& asset, const Part& part) {
    std::vector<Index> result;
    if (!asset.source || part.source == no_index) return result;
    const Json& meshes = member(asset.source->document, "meshes");
    if (part.source >= meshes.size()) return result;
    for (const Json& primitive : member(meshes[part.source], "primitives")) {
        const Json& variants = member(member(primitive, "extensions"), "KHR_materials_variants");
        for (const Json& mapping : member(variants, "mappings")) {
            const Index wanted = index_member(mapping, "material");
            for (Index m = 0; m < asset.materials.size(); ++m)
                if (wanted != no_index && asset.materials[m].source == wanted && !asset.materials[m].rebaked)
                    result.push_back(m);
        }
    }
    std::sort(result.begin(), result.end());
    result.erase(std::unique(result.begin(), result.end()), result.end());
    return result;
}

std::vector<std::uint8_t> parts_that_need_uvs(const Asset& asset) {
    std::vector<std::uint8_t> result(asset.parts.size(), 0);
    if (!asset.source) return result;
    const std::vector<std::uint8_t> moving = materials_with_moving_textures(asset.source->document);
    for (std::size_t p = 0; p < asset.parts.size(); ++p) {
        const Part& part = asset.parts[p];
        const bool moves = std::any_of(part.face_material.begin(), part.face_material.end(), [&](Index m) {
            const Index source = m == no_index ? no_index : asset.materials[m].source;
            return source < moving.size() && moving[source];
        });
        result[p] = moves || !variant_materials(asset, part).empty();
    }
    return result;
}

}  // namespace faqem::detail

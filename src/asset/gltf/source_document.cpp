#include "asset/gltf/source_document.hpp"

#include <algorithm>
#include <string>

#include "asset/gltf/accessor.hpp"
#include "asset/scene/source_traits.hpp"

namespace faqem::detail {
namespace {

/// The primitives of the mesh of a part, or null.
const Json& primitives_of(const Asset& asset, const Part& part) {
    static const Json none;
    if (!asset.source) return none;
    const Json& meshes = member(asset.source->document, "meshes");
    return part.source < meshes.size() ? member(meshes[part.source], "primitives") : none;
}

}  // namespace

bool is_dynamic(const Asset& asset) {
    if (asset.source && !member(asset.source->document, "animations").empty()) return true;
    return std::ranges::any_of(
        asset.parts, [](const Part& part) { return !part.joints.empty() || !part.morph_targets.empty(); });
}

std::vector<Index> variant_materials(const Asset& asset, const Part& part) {
    std::vector<Index> result;
    for (const Json& primitive : primitives_of(asset, part)) {
        const Json& variants = member(primitive, "extensions", "KHR_materials_variants");
        for (const Json& mapping : member(variants, "mappings")) {
            const Index wanted = index_member(mapping, "material");
            for (Index m = 0; m < asset.materials.size(); ++m)
                if (wanted != no_index && asset.materials[m].source == wanted && !asset.materials[m].rebaked)
                    result.push_back(m);
        }
    }
    std::ranges::sort(result);
    result.erase(std::unique(result.begin(), result.end()), result.end());
    return result;
}

std::vector<std::uint8_t> materials_with_moving_textures(const Asset& asset) {
    std::vector<std::uint8_t> result(asset.materials.size(), 0);
    if (!asset.source) return result;
    for (const Json& animation : member(asset.source->document, "animations")) {
        for (const Json& channel : member(animation, "channels")) {
            const std::string pointer = animated_pointer(channel);
            if (pointer.find("/KHR_texture_transform/") == std::string::npos) continue;
            for (std::size_t m = 0; m < result.size(); ++m) {
                const Index source = asset.materials[m].source;
                if (source != no_index && pointer.starts_with(child_path("/materials", source) + "/"))
                    result[m] = 1;
            }
        }
    }
    return result;
}

std::vector<std::uint8_t> parts_that_need_uvs(const Asset& asset) {
    const std::vector<std::uint8_t> moving = materials_with_moving_textures(asset);
    std::vector<std::uint8_t> result;
    for (const Part& part : asset.parts) {
        const bool moves =
            std::ranges::any_of(part.face_material, [&](Index m) { return m != no_index && moving[m]; });
        result.push_back(moves || !variant_materials(asset, part).empty());
    }
    return result;
}

MotionSteps motion_steps(const Asset& asset, const Part& part) {
    MotionSteps steps{0, std::vector<double>(part.morph_targets.size(), 0)};
    const auto step = [&](const Json& attributes, const char* name) {
        const Index accessor = index_member(attributes, name);
        return accessor == no_index ? 0 : integer_step(asset.source->document["accessors"][accessor]);
    };
    for (const Json& primitive : primitives_of(asset, part)) {
        steps.weight = std::max(steps.weight, step(member(primitive, "attributes"), "WEIGHTS_0"));
        const Json& targets = member(primitive, "targets");
        for (std::size_t t = 0; t < targets.size() && t < steps.shift.size(); ++t)
            steps.shift[t] = std::max(steps.shift[t], step(targets[t], "POSITION"));
    }
    return steps;
}

}  // namespace faqem::detail

#include <memory>
#include <string>
#include <utility>

#include "asset/scene/affine.hpp"
#include "asset/scene/measured_instances.hpp"
#include "asset/scene/rest_pose.hpp"
#include "faqem/error.hpp"
#include "render/rasterizer.hpp"

namespace faqem::render {

namespace {

using detail::TexelEncoding;

/// The instance of a part that its transform alone places: a posed part is added to the asset.
Instance placed_instance(Asset& asset, const detail::PosedInstance& instance) {
    if (!instance.pose) return {instance.part, instance.transform};
    asset.parts.push_back(detail::posed_part(asset.parts[instance.part], instance));
    return {static_cast<Index>(asset.parts.size() - 1), detail::identity_transform};
}

Texture load_texture(const Image& image, TexelEncoding encoding, std::vector<std::string>& warnings) {
    try {
        return std::make_shared<const detail::MipImage>(decode(image), encoding);
    } catch (const Error& error) {
        warnings.push_back("image '" + image.name +
                           "' cannot be decoded and is drawn white: " + error.what());
        return nullptr;
    }
}

void load_textures(Scene& scene) {
    const std::size_t count = scene.asset.images.size();
    scene.color_textures.resize(count);
    scene.normal_maps.resize(count);
    const auto load = [&](const TextureRef& texture_ref, std::vector<Texture>& textures,
                          TexelEncoding encoding) {
        if (texture_ref.image >= count || textures[texture_ref.image]) return;
        textures[texture_ref.image] =
            load_texture(scene.asset.images[texture_ref.image], encoding, scene.warnings);
    };
    for (const Material& material : scene.asset.materials) {
        load(material.base_color_texture, scene.color_textures, TexelEncoding::color_and_data_alpha);
        load(material.emissive_texture, scene.color_textures, TexelEncoding::color_and_data_alpha);
        load(material.normal_texture, scene.normal_maps, TexelEncoding::data);
    }
}

}  // namespace

Scene make_scene(Asset asset) {
    Scene scene;
    scene.asset = std::move(asset);
    const std::vector<detail::PosedInstance> all = detail::posed_instances(scene.asset);
    const std::vector<std::size_t> shown = detail::measured_indices(scene.asset, instances(scene.asset));
    if (shown.size() < all.size())
        scene.warnings.push_back("only " + std::to_string(shown.size()) + " of " +
                                 std::to_string(all.size()) +
                                 " instances are shown: all have too many faces");
    for (const std::size_t i : shown) {
        const Instance instance = placed_instance(scene.asset, all[i]);
        const Part& part = scene.asset.parts[instance.part];
        const detail::NormalTransform to_world(instance.transform);
        Scene::PartInstance part_instance;
        part_instance.part = instance.part;
        part_instance.mirrored = to_world.is_mirrored();
        for (const Vec3& p : part.positions)
            part_instance.positions.push_back(
                engine::to_eigen(detail::transformed_point(instance.transform, p)));
        for (const Vec3f& n : part.normals)
            part_instance.normals.push_back(Eigen::Vector3f(to_world(n).data()).cast<double>());
        scene.faces += part.triangles.size();
        scene.parts.push_back(std::move(part_instance));
    }
    load_textures(scene);
    return scene;
}

std::vector<PlacedMesh> placed_meshes(const Scene& scene) {
    std::vector<PlacedMesh> result;
    for (const Scene::PartInstance& instance : scene.parts)
        result.push_back({instance.positions, scene.asset.parts[instance.part].triangles});
    return result;
}

}  // namespace faqem::render

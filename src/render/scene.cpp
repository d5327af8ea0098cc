#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "asset/scene/affine.hpp"
#include "asset/scene/measured_instances.hpp"
#include "asset/scene/rest_pose.hpp"
#include "faqem/error.hpp"
#include "render/rasterizer.hpp"

namespace faqem::render {

namespace {

/// Transform of positions and normals of an instance, and whether it reverses the winding.
struct InstanceTransform {
    Eigen::Matrix3d linear, normal;
    Vector3 offset;
    bool mirrored;
};

InstanceTransform instance_transform(const Instance& instance) {
    const auto& m = instance.transform;
    InstanceTransform transform;
    transform.linear << m[0], m[4], m[8], m[1], m[5], m[9], m[2], m[6], m[10];
    transform.offset = {m[12], m[13], m[14]};
    // The cofactor matrix is the determinant times the inverse transpose, also defined if it is singular.
    const Vector3 x = transform.linear.col(0), y = transform.linear.col(1), z = transform.linear.col(2);
    transform.normal << y.cross(z), z.cross(x), x.cross(y);
    transform.mirrored = x.dot(y.cross(z)) < 0;
    if (transform.mirrored) transform.normal = -transform.normal;
    return transform;
}

/// The instance of a part that its transform alone places: a posed part is added to the asset.
Instance placed_instance(Asset& asset, const detail::PosedInstance& instance) {
    if (!instance.pose) return {instance.part, instance.transform};
    asset.parts.push_back(detail::posed_part(asset.parts[instance.part], instance));
    return {static_cast<Index>(asset.parts.size() - 1), detail::identity_transform};
}

std::optional<Texture> load_texture(const Image& image, ColorSpace color_space,
                                    std::vector<std::string>& warnings) {
    try {
        return make_texture(decode(image), color_space);
    } catch (const Error& error) {
        warnings.push_back("image '" + image.name +
                           "' cannot be decoded and is drawn white: " + error.what());
        return std::nullopt;
    }
}

void load_textures(Scene& scene) {
    const std::size_t count = scene.asset.images.size();
    scene.color_textures.resize(count);
    scene.normal_maps.resize(count);
    const auto load = [&](const TextureRef& texture_ref, std::vector<Texture>& textures,
                          ColorSpace color_space) {
        if (texture_ref.image >= count || textures[texture_ref.image]) return;
        if (auto texture = load_texture(scene.asset.images[texture_ref.image], color_space, scene.warnings)) {
            textures[texture_ref.image] = std::move(*texture);
        }
    };
    for (const Material& material : scene.asset.materials) {
        load(material.base_color_texture, scene.color_textures, ColorSpace::srgb);
        load(material.emissive_texture, scene.color_textures, ColorSpace::srgb);
        load(material.normal_texture, scene.normal_maps, ColorSpace::linear);
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
        const InstanceTransform transform = instance_transform(instance);
        Scene::PartInstance part_instance;
        part_instance.part = instance.part;
        part_instance.mirrored = transform.mirrored;
        for (const Vec3& p : part.positions) {
            part_instance.positions.push_back(transform.linear * engine::to_eigen(p) + transform.offset);
        }
        for (const Vec3f& n : part.normals) {
            part_instance.normals.push_back(
                (transform.normal * Vector3(n[0], n[1], n[2])).stableNormalized());
        }
        scene.faces += part.triangles.size();
        scene.parts.push_back(std::move(part_instance));
    }
    load_textures(scene);
    return scene;
}

Camera orbit_camera(const Vector3& centre, double azimuth, double elevation) {
    Camera camera;
    camera.back = {std::sin(azimuth) * std::cos(elevation), std::sin(elevation),
                   std::cos(azimuth) * std::cos(elevation)};
    camera.right = Vector3::UnitY().cross(camera.back).normalized();
    camera.up = camera.back.cross(camera.right);
    camera.eye = centre + camera.back;
    return camera;
}

namespace {

template <class Visit>
void for_each_corner(const Scene& scene, Visit&& visit) {
    for (const Scene::PartInstance& part_instance : scene.parts) {
        for (const Triangle& t : scene.asset.parts[part_instance.part].triangles) {
            for (const Index v : t) visit(part_instance.positions[v]);
        }
    }
}

}  // namespace

double fitting_distance(const Scene& scene, const Camera& camera, const Vector3& centre) {
    double distance = 0;
    for_each_corner(scene, [&](const Vector3& p) {
        const Vector3 d = p - centre;
        const double off_axis = std::max(std::abs(d.dot(camera.right)), std::abs(d.dot(camera.up)));
        distance = std::max(distance, d.dot(camera.back) + off_axis / camera.tan_half_fov);
    });
    return distance;
}

bool bounding_box(const Scene& scene, Vector3& low, Vector3& high) {
    bool any = false;
    for_each_corner(scene, [&](const Vector3& p) {
        low = any ? low.cwiseMin(p) : p;
        high = any ? high.cwiseMax(p) : p;
        any = true;
    });
    return any;
}

}  // namespace faqem::render

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "faqem/error.hpp"
#include "render/rasteriser.hpp"

namespace faqem::tool {

namespace {

/// What an instance's transform does to positions, normals and winding.
struct Placement {
    Eigen::Matrix3d linear, normal;
    Vector3 offset;
    bool mirrored;
};

Placement placement(const Instance& instance) {
    const auto& m = instance.transform;
    Placement place;
    place.linear << m[0], m[4], m[8], m[1], m[5], m[9], m[2], m[6], m[10];
    place.offset = {m[12], m[13], m[14]};
    // The cofactor matrix is det times the inverse transpose, and exists where the inverse does not.
    const Vector3 x = place.linear.col(0), y = place.linear.col(1), z = place.linear.col(2);
    place.normal << y.cross(z), z.cross(x), x.cross(y);
    place.mirrored = x.dot(y.cross(z)) < 0;
    if (place.mirrored) place.normal = -place.normal;
    return place;
}

std::optional<Texture> load_texture(const Image& image, Encoding encoding,
                                    std::vector<std::string>& warnings) {
    try {
        return make_texture(decode(image), encoding);
    } catch (const Error& error) {
        warnings.push_back("image '" + image.name + "' is drawn white: " + error.what());
        return std::nullopt;
    }
}

void load_textures(Scene& scene) {
    const std::size_t count = scene.asset.images.size();
    scene.colours.resize(count);
    scene.normal_maps.resize(count);
    const auto load = [&](const TextureRef& use, std::vector<Texture>& textures, Encoding encoding) {
        if (use.image >= count || textures[use.image]) return;
        if (auto texture = load_texture(scene.asset.images[use.image], encoding, scene.warnings)) {
            textures[use.image] = std::move(*texture);
        }
    };
    for (const Material& material : scene.asset.materials) {
        load(material.base_color_texture, scene.colours, Encoding::srgb);
        load(material.emissive_texture, scene.colours, Encoding::srgb);
        load(material.normal_texture, scene.normal_maps, Encoding::linear);
    }
}

}  // namespace

Scene make_scene(Asset asset) {
    Scene scene;
    scene.asset = std::move(asset);
    for (const Instance& instance : instances(scene.asset)) {
        const Part& part = scene.asset.parts[instance.part];
        const Placement place = placement(instance);
        Scene::PlacedPart placed;
        placed.part = instance.part;
        placed.mirrored = place.mirrored;
        for (const Vec3& p : part.positions) {
            placed.positions.push_back(place.linear * engine::to_eigen(p) + place.offset);
        }
        for (const Vec3f& n : part.normals) {
            placed.normals.push_back((place.normal * Vector3(n[0], n[1], n[2])).stableNormalized());
        }
        scene.faces += part.triangles.size();
        scene.parts.push_back(std::move(placed));
    }
    load_textures(scene);
    return scene;
}

Camera looking_at(const Vector3& centre, double azimuth, double elevation) {
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
    for (const Scene::PlacedPart& placed : scene.parts) {
        for (const Triangle& t : scene.asset.parts[placed.part].triangles) {
            for (const Index v : t) visit(placed.positions[v]);
        }
    }
}

}  // namespace

double fitting_distance(const Scene& scene, const Camera& camera, const Vector3& centre) {
    double distance = 0;
    for_each_corner(scene, [&](const Vector3& p) {
        const Vector3 d = p - centre;
        const double off_axis = std::max(std::abs(d.dot(camera.right)), std::abs(d.dot(camera.up)));
        distance = std::max(distance, d.dot(camera.back) + off_axis / camera.tangent);
    });
    return distance;
}

bool bounds(const Scene& scene, Vector3& low, Vector3& high) {
    bool any = false;
    for_each_corner(scene, [&](const Vector3& p) {
        low = any ? low.cwiseMin(p) : p;
        high = any ? high.cwiseMax(p) : p;
        any = true;
    });
    return any;
}

}  // namespace faqem::tool

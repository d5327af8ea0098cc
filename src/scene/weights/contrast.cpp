#include "scene/weights/contrast.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <memory>

#include "asset/image/srgb.hpp"
#include "asset/scene/material_textures.hpp"
#include "asset/scene/measured_instances.hpp"
#include "asset/scene/part_arrays.hpp"
#include "faqem/detail/base/parallel.hpp"
#include "faqem/error.hpp"
#include "render/texture_sampling.hpp"
#include "render/visible_points.hpp"
#include "scene/layers.hpp"
#include "scene/material_groups.hpp"
#include "scene/part_components.hpp"
#include "scene/placed_parts.hpp"

namespace faqem::detail {
namespace {

using engine::RunContext;
using render::VisiblePoint;

constexpr std::size_t contrast_view_count = 12;
constexpr std::uint32_t contrast_picture_size = 256;
constexpr double most_faces = 1e6;
constexpr double least_factor = 2, largest_factor = 10;

// Of the pixels of a component: the sum of squared differences, and their number.
using Sum = Eigen::Vector2d;
using Color = Eigen::Array3d;

TexelEncoding encoding_of(const Material& material) {
    return material.alpha_mode == AlphaMode::opaque ? TexelEncoding::opaque_color : TexelEncoding::color;
}

DecodedImages base_color_images(const Asset& scene, const RunContext& context) {
    DecodedImages result;
    for (const Material& material : scene.materials) {
        const Index image = material.base_color_texture.image;
        if (image >= scene.images.size()) continue;
        auto& decoded = result[{image, encoding_of(material)}];
        try {
            if (!decoded)
                decoded = std::make_shared<const MipImage>(decode(scene.images[image]), encoding_of(material),
                                                           context);
        } catch (const Error&) {  // Baking reports it.
        }
    }
    return result;
}

// A scene as the cameras see it.
class SceneViews {
public:
    SceneViews(const Asset& scene, const PartComponents& components, const RunContext& context)
        : scene_(scene),
          components_(components),
          instances_(measured_instances(scene)),
          images_(base_color_images(scene, context)) {
        for (const auto& [p, transform] : instances_) {
            const Part& part = scene.parts[p];
            placed_.add(part.positions, part.triangles, transform, scene,
                        [&](std::size_t f) { return face_material(part, f); });
        }
    }

    // The sums of all views, by component.
    std::vector<Sum> sums(const RunContext& context) const {
        const std::vector<render::Camera> cameras =
            render::cameras_around(placed_.meshes, contrast_view_count);
        std::vector<std::vector<Sum>> views(contrast_view_count);
        parallel_each(contrast_view_count, 1, context,
                      [&](std::size_t v) { views[v] = sums_of_view(cameras[v]); });
        std::vector<Sum> result(components_.count, Sum::Zero());
        for (const std::vector<Sum>& view : views)
            for (std::size_t c = 0; c < view.size(); ++c) result[c] += view[c];
        return result;
    }

private:
    std::vector<Sum> sums_of_view(const render::Camera& camera) const {
        const auto component = [&](Index mesh, Index face) {
            return components_.of_face[instances_[mesh].part][face];
        };
        std::vector<VisiblePoint> behind;
        const std::vector<VisiblePoint> front =
            render::visible_points(placed_.meshes, camera, contrast_picture_size, &behind, component);
        std::vector<Sum> result(components_.count, Sum::Zero());
        for (std::size_t i = 0; i < front.size(); ++i) {
            if (front[i].mesh == no_index) continue;
            const Color back = color(behind[i], Color::Constant(0.2)), seen = color(front[i], back);
            const Color difference = seen.unaryExpr(&srgb_from_linear) - back.unaryExpr(&srgb_from_linear);
            result[component(front[i].mesh, front[i].face)] += Sum(difference.square().sum(), 1);
        }
        return result;
    }

    // The base colour at a point in front of another colour, in linear light.
    Color color(const VisiblePoint& at, const Color& behind) const {
        if (at.mesh == no_index) return behind;
        const Part& part = scene_.parts[instances_[at.mesh].part];
        const SurfacePoint point{at.face, at.barycentric};
        const Material& material = material_or_default(scene_, face_material(part, at.face));
        const auto array = [](const std::array<float, 4>& rgba) {
            return Eigen::Array4d(Eigen::Map<const Eigen::Array4f>(rgba.data()).cast<double>());
        };
        Eigen::Array4d own = array(material.base_color);
        if (!part.colors.empty()) own *= array(interpolated<float>(part.colors, part, point));
        if (material.alpha_mode == AlphaMode::opaque) own[3] = 1;
        own.head<3>() *= own[3];
        const TextureRef& texture_ref = material.base_color_texture;
        const auto image = images_.find({texture_ref.image, encoding_of(material)});
        const std::size_t set = texture_ref.uv_set;
        const bool has_uvs = set < part.uvs.size() && !part.uvs[set].empty();
        if (has_uvs && image != images_.end() && image->second) {
            const auto uv = interpolated<double>(part.uvs[set], part, point);
            const auto [u, v] = uv_transform(texture_ref).apply(uv[0], uv[1]);
            own *= array(image->second->sample(texture_ref, u, v, 0));
        }
        return (own.head<3>() + (1 - own[3]) * behind).max(0).min(1);
    }

    const Asset& scene_;
    const PartComponents& components_;
    std::vector<Instance> instances_;
    DecodedImages images_;
    PlacedParts placed_;  // by instance
};

}  // namespace

bool is_weighted_by_pictures(const Asset& scene, const Options& options) {
    return separates_layers(scene, options) && options.visibility != Visibility::weighted &&
           shown_faces(scene, instances(scene)) <= most_faces;
}

std::vector<std::vector<float>> contrast_weights(const Asset& scene, const RunContext& context) {
    std::vector<std::vector<float>> result(scene.parts.size());
    const PartComponents components = part_components(scene);
    if (components.count < 2) return result;
    const std::vector<Sum> sums = SceneViews(scene, components, context).sums(context);
    Sum all = Sum::Zero();
    for (const Sum& sum : sums) all += sum;
    for (std::size_t p = 0; p < result.size(); ++p) {
        const Part& part = scene.parts[p];
        for (std::size_t f = 0; f < part.triangles.size(); ++f) {
            const Sum& own = sums[components.of_face[p][f]];
            // Rounded, so that it does not depend on the last digits of the C library.
            const double factor = std::round(4 * own[0] / own[1] / (all[0] / all[1])) / 4;
            if (!(factor >= least_factor)) continue;
            result[p].resize(part.positions.size(), 1.0f);
            for (const Index v : part.triangles[f])
                result[p][v] = static_cast<float>(std::min(factor, largest_factor));
        }
    }
    return result;
}

}  // namespace faqem::detail

#include "render/rasterizer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "render/visible_points.hpp"

namespace faqem::render {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3f;
using Eigen::Vector4f;

constexpr std::uint32_t samples_per_axis = 2;
constexpr double edge_width = 0.8;  // half the line width, in pixels of the supersampled image
const Vector4f edge_color(0.02f, 0.03f, 0.05f, 1.0f);

/// A corner of a projected triangle.
struct Corner {
    Vector3 world, normal;
    Index vertex;
};

/// What a face shows of a texture.
struct FaceTexture {
    const detail::MipImage* texture = nullptr;  ///< null: none
    std::array<Vector2d, 3> uv;                 ///< with the texture transform applied
    double mip_level = 0;
};

/// A projected triangle with its constant attributes.
struct ScreenTriangle {
    std::array<Corner, 3> corners;
    ScreenFace screen;
    const Part* part;
    const Material* material;
    Index material_index;  ///< the number of materials for the default material
    Vector3 normal;        ///< face normal, towards the eye
    double facing;         ///< 1: front-facing, -1: back-facing
    double screen_area;    ///< twice the signed area in screen space
    /// Made with the first pixel that shows them.
    mutable std::optional<FaceTexture> base_color, normal_map, emissive;
};

const Material default_material;

/// The scene, the options and the buffers of one rendering.
struct RenderTarget {
    const Scene& scene;
    const Camera& camera;
    Shading shading;
    Edges edges;
    Backs backs;
    std::uint32_t size;                ///< width and height in samples
    std::vector<float> inverse_depth;  ///< of the nearest surface that is not blended; 0 without one
    std::vector<Vector4f> color;       ///< linear RGBA, premultiplied
    std::vector<Index> materials;      ///< that of the nearest surface
};

Vector3 interpolate(const ScreenTriangle& face, const Vector3& w, Vector3 Corner::*value) {
    return w[0] * face.corners[0].*value + w[1] * face.corners[1].*value + w[2] * face.corners[2].*value;
}

/// UV of a corner, of a set that the part has.
Vector2d corner_uv(const ScreenTriangle& face, const TextureRef& texture_ref, std::size_t k) {
    const Vec2f& uv = face.part->uvs[texture_ref.uv_set][face.corners[k].vertex];
    return {uv[0], uv[1]};
}

/// Mip level of a face: half the base-2 logarithm of the number of texels per pixel. It is constant per face,
/// since faces are small.
double mip_level(const ScreenTriangle& face, const detail::MipImage& texture,
                 const std::array<Vector2d, 3>& uv) {
    // Coarser levels would mix unrelated charts of an atlas, whose gutters are a few texels wide.
    constexpr double max_level = 3;
    const Vector2d a = uv[1] - uv[0], b = uv[2] - uv[0];
    const double texels = std::abs(a.x() * b.y() - a.y() * b.x()) * texture.width() * texture.height();
    const double ratio = texels / std::max(std::abs(face.screen_area), 1e-9);
    return ratio > 1 ? std::min(0.5 * std::log2(ratio), max_level) : 0;
}

FaceTexture make_face_texture(const ScreenTriangle& face, const TextureRef& texture_ref,
                              const std::vector<Texture>& textures) {
    FaceTexture result;
    const auto& uvs = face.part->uvs;
    const bool has_uvs = texture_ref.uv_set < uvs.size() && !uvs[texture_ref.uv_set].empty();
    if (!has_uvs || texture_ref.image >= textures.size() || !textures[texture_ref.image]) return result;
    result.texture = textures[texture_ref.image].get();
    const detail::UvTransform transform = detail::uv_transform(texture_ref);
    for (std::size_t k = 0; k < 3; ++k) {
        const Vector2d uv = corner_uv(face, texture_ref, k);
        result.uv[k] = Vector2d(transform.apply(uv.x(), uv.y()).data());
    }
    result.mip_level = mip_level(face, *result.texture, result.uv);
    return result;
}

/// RGBA of a texture at the barycentric coordinates w; empty if there is no texture.
/// \param of_face  the texture of the face, which is made if it is empty
std::optional<Vector4f> sample_texture(const ScreenTriangle& face, std::optional<FaceTexture>& of_face,
                                       const TextureRef& texture_ref, const std::vector<Texture>& textures,
                                       const Vector3& w) {
    if (!of_face) of_face = make_face_texture(face, texture_ref, textures);
    if (!of_face->texture) return std::nullopt;
    const Vector2d at = w[0] * of_face->uv[0] + w[1] * of_face->uv[1] + w[2] * of_face->uv[2];
    return Vector4f(of_face->texture->sample(texture_ref, at.x(), at.y(), of_face->mip_level).data());
}

Vector4f base_color(const RenderTarget& target, const ScreenTriangle& face, const Vector3& w) {
    Vector4f color(face.material->base_color.data());
    if (const auto texel = sample_texture(face, face.base_color, face.material->base_color_texture,
                                          target.scene.color_textures, w))
        color = color.cwiseProduct(*texel);
    if (!face.part->colors.empty()) {
        const auto of = [&](const Corner& c) { return Vector4f(face.part->colors[c.vertex].data()); };
        const Vector3f u = w.cast<float>();
        color = color.cwiseProduct(u[0] * of(face.corners[0]) + u[1] * of(face.corners[1]) +
                                   u[2] * of(face.corners[2]));
    }
    return color;
}

/// Applies the normal map of the material to a normal, in the tangent frame of the UVs of the face.
Vector3 normal_mapped(const RenderTarget& target, const ScreenTriangle& face, const Vector3& w,
                      const Vector3& normal) {
    const TextureRef& texture_ref = face.material->normal_texture;
    const auto texel = sample_texture(face, face.normal_map, texture_ref, target.scene.normal_maps, w);
    if (!texel) return normal;
    const auto uv = [&](std::size_t k) { return corner_uv(face, texture_ref, k); };
    const Vector2d d1 = uv(1) - uv(0), d2 = uv(2) - uv(0);
    const Vector3 e1 = face.corners[1].world - face.corners[0].world,
                  e2 = face.corners[2].world - face.corners[0].world;
    const double handedness = d1.x() * d2.y() - d1.y() * d2.x() < 0 ? -1 : 1;
    Vector3 tangent = handedness * (d2.y() * e1 - d1.y() * e2);
    tangent -= normal * normal.dot(tangent);
    tangent.stableNormalize();
    // In glTF the bitangent points up in the image, opposite to v.
    Vector3 bitangent = -handedness * (d1.x() * e2 - d2.x() * e1);
    bitangent -= normal * normal.dot(bitangent);
    bitangent.stableNormalize();
    const Vector3 bump = texel->head<3>().cast<double>() * 2.0 - Vector3::Ones();
    const double scale = face.material->normal_scale;
    const Vector3 perturbed =
        scale * (bump.x() * tangent + bump.y() * bitangent) + std::max(bump.z(), 0.05) * normal;
    return perturbed.stableNormalized();
}

Vector3 shading_normal(const RenderTarget& target, const ScreenTriangle& face, const Vector3& w) {
    Vector3 normal = interpolate(face, w, &Corner::normal);
    if (!(normal.squaredNorm() > 1e-12)) return face.normal;
    normal.normalize();
    normal = normal_mapped(target, face, w, normal);
    return face.facing * normal;
}

/// Shades a surface with a key light from the upper left, a fill light from the right, hemispherical ambient
/// light and a soft specular highlight.
Vector3f lighting(const Camera& camera, const Vector3f& albedo, const Vector3& normal,
                  const Vector3& to_eye) {
    const Vector3 key = (-0.55 * camera.right + 0.75 * camera.up + 0.75 * camera.back).normalized();
    const Vector3 fill = (0.9 * camera.right + 0.15 * camera.up + 0.45 * camera.back).normalized();
    const double up = 0.5 + 0.5 * normal.dot(camera.up);
    const double k = std::max(0.0, normal.dot(key)), f = std::max(0.0, normal.dot(fill));
    const Vector3f sky(0.46f, 0.49f, 0.55f), ground(0.20f, 0.18f, 0.16f);
    const Vector3f light = static_cast<float>(up) * sky + static_cast<float>(1 - up) * ground +
                           static_cast<float>(k) * Vector3f(1.02f, 0.98f, 0.91f) +
                           static_cast<float>(f) * Vector3f(0.16f, 0.18f, 0.22f);
    const Vector3 half = (key + to_eye).normalized();
    const auto shine = static_cast<float>(0.10 * std::pow(std::max(0.0, normal.dot(half)), 28.0));
    return albedo.cwiseProduct(light) + shine * Vector3f::Ones();
}

/// Colour of a face at the barycentric coordinates w, with the alpha of its material; empty if the alpha mask
/// discards the pixel.
std::optional<Vector4f> shade(const RenderTarget& target, const ScreenTriangle& face, const Vector3& w) {
    Vector4f color = base_color(target, face, w);
    const Material& material = *face.material;
    if (material.alpha_mode == AlphaMode::mask && !(color[3] >= material.alpha_cutoff)) return std::nullopt;
    if (material.alpha_mode != AlphaMode::blend) color[3] = 1;
    if (target.shading == Shading::lit && !material.unlit) {
        const Vector3 world = interpolate(face, w, &Corner::world);
        const Vector3f glow(material.emissive.data());
        Vector3f rgb = lighting(target.camera, color.head<3>(), shading_normal(target, face, w),
                                (target.camera.eye - world).normalized());
        if (glow.maxCoeff() > 0) {
            const auto texel = sample_texture(face, face.emissive, material.emissive_texture,
                                              target.scene.color_textures, w);
            rgb += texel ? Vector3f(glow.cwiseProduct(texel->head<3>())) : glow;
        }
        color.head<3>() = rgb;
    }
    return color;
}

/// Distance in pixels to the nearest edge of the face.
double edge_distance(const ScreenTriangle& face, const Vector3& screen_weights) {
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < 3; ++k) {
        const double length = (face.screen[(k + 2) % 3].at - face.screen[(k + 1) % 3].at).norm();
        nearest = std::min(
            nearest, screen_weights[static_cast<Eigen::Index>(k)] * std::abs(face.screen_area) / length);
    }
    return nearest;
}

void draw_pixel(RenderTarget& target, const ScreenTriangle& face, std::size_t pixel,
                const Vector3& screen_weights, double inverse_depth) {
    if (!(inverse_depth > target.inverse_depth[pixel])) return;
    auto color = shade(target, face, perspective_weights(face.screen, screen_weights));
    if (!color) return;
    if (target.edges == Edges::drawn && edge_distance(face, screen_weights) < edge_width)
        *color = 0.6f * edge_color + 0.4f * *color;
    const float alpha = std::clamp((*color)[3], 0.0f, 1.0f);
    Vector4f premultiplied = *color * alpha;
    premultiplied[3] = alpha;
    target.color[pixel] = premultiplied + (1 - alpha) * target.color[pixel];
    target.materials[pixel] = face.material_index;
    if (face.material->alpha_mode == AlphaMode::blend) return;  // blended faces do not write depth
    target.inverse_depth[pixel] = static_cast<float>(inverse_depth);
}

std::optional<ScreenTriangle> project_triangle(const RenderTarget& target,
                                               const Scene::PartInstance& instance, std::size_t f) {
    ScreenTriangle face;
    face.part = &target.scene.asset.parts[instance.part];
    const Index material = face.part->face_material.empty() ? no_index : face.part->face_material[f];
    const std::vector<Material>& materials = target.scene.asset.materials;
    face.material = material < materials.size() ? &materials[material] : &default_material;
    face.material_index = std::min(material, static_cast<Index>(materials.size()));
    const Camera& camera = target.camera;
    for (std::size_t k = 0; k < 3; ++k) {
        Corner& corner = face.corners[k];
        corner.vertex = face.part->triangles[f][k];
        corner.world = instance.positions[corner.vertex];
        corner.normal = instance.normals.empty() ? Vector3::Zero().eval() : instance.normals[corner.vertex];
        face.screen[k] = project(camera, corner.world, target.size);
    }
    face.screen_area = twice_area(face.screen);
    if (!(std::abs(face.screen_area) > 0)) return std::nullopt;
    face.normal = engine::area_vector(face.corners[0].world, face.corners[1].world, face.corners[2].world)
                      .stableNormalized();
    if (face.normal.dot(camera.eye - face.corners[0].world) < 0) face.normal = -face.normal;
    // y points down on the screen, so the area of counter-clockwise faces is negative.
    face.facing = (face.screen_area < 0) != instance.mirrored ? 1 : -1;
    if (target.backs == Backs::hidden && face.facing < 0 && !face.material->double_sided) return std::nullopt;
    return face;
}

/// A face to draw.
struct DrawnFace {
    double nearness;  ///< sum of the inverse depths of its corners
    std::uint32_t instance;
    Index face;
};

/// Draws opaque and masked faces from front to back, so that few pixels are shaded that are hidden in the end, then
/// blended faces from back to front.
void draw_scene(RenderTarget& target) {
    const std::vector<Scene::PartInstance>& instances = target.scene.parts;
    std::vector<DrawnFace> opaque, blended;
    for (std::uint32_t i = 0; i < instances.size(); ++i) {
        const std::size_t faces = target.scene.asset.parts[instances[i].part].triangles.size();
        for (Index f = 0; f < faces; ++f) {
            const auto face = project_triangle(target, instances[i], f);
            if (!face) continue;
            double nearness = 0;
            for (const ScreenPoint& corner : face->screen) nearness += corner.inverse_depth;
            const bool is_blended = face->material->alpha_mode == AlphaMode::blend;
            (is_blended ? blended : opaque).push_back({nearness, i, f});
        }
    }
    std::ranges::stable_sort(opaque, std::ranges::greater{}, &DrawnFace::nearness);
    std::ranges::stable_sort(blended, {}, &DrawnFace::nearness);
    for (const std::vector<DrawnFace>* const faces : {&opaque, &blended})
        for (const DrawnFace& drawn : *faces) {
            const ScreenTriangle face = *project_triangle(target, instances[drawn.instance], drawn.face);
            for_each_pixel(face.screen, face.screen_area, target.size,
                           [&](std::size_t pixel, const Vector3& w, double inverse_depth) {
                               draw_pixel(target, face, pixel, w, inverse_depth);
                           });
        }
}

Frame downsample(const std::vector<Vector4f>& color, const std::vector<Index>& materials,
                 std::uint32_t size) {
    Frame frame;
    frame.size = size;
    frame.pixels.assign(std::size_t{size} * size, Vector4f::Zero());
    frame.materials.resize(frame.pixels.size());
    const std::uint32_t fine = size * samples_per_axis;
    for (std::uint32_t y = 0; y < fine; ++y) {
        for (std::uint32_t x = 0; x < fine; ++x) {
            Vector4f c = color[std::size_t{y} * fine + x];
            // Clamped before averaging, which otherwise makes the edges of highlights jagged.
            for (int k = 0; k < 3; ++k) c[k] = std::min(c[k], 1.0f);
            frame.pixels[std::size_t{y / samples_per_axis} * size + x / samples_per_axis] +=
                c / static_cast<float>(samples_per_axis * samples_per_axis);
            if (x % samples_per_axis == 0 && y % samples_per_axis == 0)
                frame.materials[std::size_t{y / samples_per_axis} * size + x / samples_per_axis] =
                    materials[std::size_t{y} * fine + x];
        }
    }
    return frame;
}

}  // namespace

Frame render(const Scene& scene, const Camera& camera, std::uint32_t size, Shading shading, Edges edges,
             Backs backs) {
    const std::uint32_t fine = size * samples_per_axis;
    const std::size_t samples = std::size_t{fine} * fine;
    RenderTarget target{scene, camera, shading, edges, backs, fine, {}, {}, {}};
    target.inverse_depth.assign(samples, 0);
    target.color.assign(samples, Vector4f::Zero());
    target.materials.assign(samples, no_index);
    draw_scene(target);
    return downsample(target.color, target.materials, size);
}

}  // namespace faqem::render

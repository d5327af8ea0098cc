#include "bake/source/source_sampler.hpp"

#include "asset/scene/messages.hpp"

#include <cmath>
#include <exception>
#include <string>
#include <utility>

#include "asset/image/srgb.hpp"
#include "bake/source/facets.hpp"
#include "faqem/detail/base/vector.hpp"
#include "faqem/error.hpp"
#include "scene/vector_conversion.hpp"

namespace faqem::detail {

namespace {

// Errors name the material that uses the image, since images may have no names.
Pixels decode_for(const Asset& asset, Index image, Index material) {
    try {
        return decode(asset.images[image]);
    } catch (const UnsupportedError& error) {
        throw UnsupportedError("", material_title(asset, material), error.what());
    } catch (const InputError& error) {
        throw InputError("", material_title(asset, material), error.what());
    }
}

}  // namespace

// An image that is not decoded yet.
struct SourceSampler::MissingImage {
    Index image;
    TexelEncoding encoding;
    Index material;  // the first one with the image
    Pixels pixels = {};
    std::exception_ptr error = {};
};

SourceSampler::SourceSampler(const Asset& asset, const Channels& wanted, const RunContext& context,
                             std::span<const std::uint8_t> skipped_parts, DecodedImages* decoded)
    : asset_(asset), wanted_(wanted) {
    DecodedImages own;
    DecodedImages& images = decoded ? *decoded : own;
    const std::vector<bool> used = used_materials(asset, skipped_parts);
    std::vector<MissingImage> missing;
    const auto index = [&](std::size_t m) {
        return m == asset.materials.size() ? no_index : static_cast<Index>(m);
    };
    for (std::size_t m = 0; m <= asset.materials.size(); ++m)
        if (used[m]) load_material(index(m), images, missing);
    decode_images(missing, context, images);
    for (std::size_t m = 0; m <= asset.materials.size(); ++m) {
        if (used[m])
            material_slots_.push_back(load_material(index(m), images, missing));
        else
            material_slots_.emplace_back().material = &material_or_default(asset, index(m));
    }
    densities_.resize(asset.parts.size());
    tangents_.resize(asset.parts.size());
    for (std::size_t p = 0; p < asset.parts.size(); ++p) {
        if (!skipped_parts.empty() && skipped_parts[p]) continue;
        context.check_now();
        measure_densities(asset.parts[p], densities_[p]);
        const auto differs = [&, part = static_cast<Index>(p)](const SurfacePoint& a, const SurfacePoint& b) {
            return has_jump(part, a, b);
        };
        densities_[p].of_regions = region_densities(asset.parts[p], differs);
        if (wanted.needs_tangents()) tangents_[p] = source_tangents(asset, asset.parts[p]);
    }
}

SourceSampler::MaterialSlots SourceSampler::load_material(Index index, const DecodedImages& images,
                                                          std::vector<MissingImage>& missing) {
    MaterialSlots result;
    result.material = &material_or_default(asset_, index);
    const Material& m = *result.material;
    const auto set = [&](TextureSlot& to, bool wanted, const TextureRef& texture_ref,
                         TexelEncoding encoding) {
        if (wanted) to = load_slot(texture_ref, encoding, index, images, missing);
    };
    for (const bool are_normals :
         {false, true}) {  // of several damaged images, that of a normal map is reported last
        for (std::size_t i = 0; i < core_slots.size(); ++i) {
            const TextureContent content = core_slots[i].content;
            if ((content == TextureContent::normal) != are_normals || (are_normals && m.unlit)) continue;
            TexelEncoding encoding = is_color(content) ? TexelEncoding::opaque_color : TexelEncoding::data;
            if (content == TextureContent::color_and_alpha && m.alpha_mode != AlphaMode::opaque)
                encoding = TexelEncoding::color;
            set(result.core[i], wanted_.core[i], m.*core_slots[i].texture, encoding);
        }
    }
    const auto& occlusion = result[CoreTexture::occlusion].image;
    result.shares_occlusion = occlusion && occlusion == result[CoreTexture::metallic_roughness].image &&
                              m.occlusion_texture == m.metallic_roughness_texture;
    if (!wanted_.layers) return result;
    result.extensions.resize(m.extension_textures.size());
    for (const ExtensionLayer& layer : extension_layers(m)) {
        const Index first = layer.textures.front();
        set(result.extensions[first], !layer.is_normal_map() || wanted_.layer_normals,
            m.extension_textures[first].texture, layer.encoding());
    }
    return result;
}

SourceSampler::TextureSlot SourceSampler::load_slot(const TextureRef& texture_ref, TexelEncoding encoding,
                                                    Index material, const DecodedImages& images,
                                                    std::vector<MissingImage>& missing) {
    if (!texture_ref) return {};
    const auto found = images.find({texture_ref.image, encoding});
    if (found == images.end()) {
        const bool is_listed = std::any_of(missing.begin(), missing.end(), [&](const MissingImage& m) {
            return m.image == texture_ref.image && m.encoding == encoding;
        });
        if (!is_listed) missing.push_back({texture_ref.image, encoding, material});
        return {};
    }
    const MipImage& image = *found->second;
    const double texels = double(image.width()) * image.height();
    return {found->second, &texture_ref,
            std::sqrt(texels * std::abs(double(texture_ref.scale[0]) * texture_ref.scale[1])),
            uv_transform(texture_ref)};
}

// Decodes the images on all threads. Of several errors, that of the first image is thrown.
void SourceSampler::decode_images(std::vector<MissingImage>& missing, const RunContext& context,
                                  DecodedImages& images) const {
    parallel_blocks(missing.size(), 1, context, [&](std::size_t i, std::size_t) {
        MissingImage& m = missing[i];
        try {
            m.pixels = decode_for(asset_, m.image, m.material);
            if (m.pixels.width == 0 || m.pixels.height == 0)
                throw InputError("", "material " + std::to_string(m.material),
                                 "an image of it has no pixels");
        } catch (...) {
            m.error = std::current_exception();
        }
    });
    for (MissingImage& m : missing) {
        if (m.error) std::rethrow_exception(m.error);
        context.check_now();
        images[{m.image, m.encoding}] =
            std::make_shared<const MipImage>(std::move(m.pixels), m.encoding, context);
    }
}

void SourceSampler::measure_densities(const Part& part, PartDensity& density) const {
    const std::size_t faces = part.triangles.size();
    std::vector<float> length(faces);  // square root of the area
    double area = 0;
    for (std::size_t f = 0; f < faces; ++f) {
        const double a = triangle_area(part.positions, part.triangles[f]);
        area += a;
        length[f] = static_cast<float>(std::sqrt(a));
    }
    if (area > 0) density.untextured_density = std::sqrt(2 * static_cast<double>(faces) / area);
    density.uv_per_length.resize(part.uvs.size());
    for (std::size_t set = 0; set < part.uvs.size(); ++set) {
        bool needed = false;
        for (const MaterialSlots& slots : material_slots_)
            slots.for_each_image(
                [&](const TextureSlot& slot) { needed = needed || slot.texture_ref->uv_set == set; });
        if (!needed) continue;
        std::vector<float>& ratio = density.uv_per_length[set];
        ratio.resize(faces, 0.0f);
        for (std::size_t f = 0; f < faces; ++f) {
            const double r = std::sqrt(uv_area(part.uvs[set], part.triangles[f])) / length[f];
            if (std::isfinite(r)) ratio[f] = static_cast<float>(r);
        }
    }
}

std::array<double, 2> SourceSampler::uv_at(const TextureSlot& slot, const Part& part,
                                           const SurfacePoint& point) const {
    const std::uint32_t set = slot.texture_ref->uv_set;
    if (set >= part.uvs.size()) return {0, 0};
    const auto [u, v] = interpolated<double>(part.uvs[set], part, point);
    return slot.transform.apply(u, v);
}

LinearColor SourceSampler::fetch(const TextureSlot& slot, Index p, const SurfacePoint& point, double spacing,
                                 FetchCache& cache) const {
    const Part& part = asset_.parts[p];
    const std::uint32_t set = slot.texture_ref->uv_set;
    if (set >= part.uvs.size()) return slot.image->sample(*slot.texture_ref, 0, 0, 0);
    if (cache.set != set) {
        cache.set = set;
        cache.uv = interpolated<double>(part.uvs[set], part, point);
        cache.uv_per_length = densities_[p].uv_per_length[set][point.face];
    }
    const double footprint = cache.uv_per_length * slot.texels_per_uv * spacing;
    if (cache.footprint != footprint) {
        cache.footprint = footprint;
        cache.lod = footprint > 1 ? std::log2(footprint) : 0;
    }
    const auto uv = slot.transform.apply(cache.uv[0], cache.uv[1]);
    return slot.image->sample(*slot.texture_ref, uv[0], uv[1], cache.lod);
}

Vec4f SourceSampler::base_factor(const Material& material, const Part& part,
                                 const SurfacePoint& point) const {
    Vec4f factor = material.base_color;
    if (!part.colors.empty()) {
        const auto color = interpolated<double>(part.colors, part, point);
        for (std::size_t k = 0; k < 4; ++k) factor[k] *= static_cast<float>(color[k]);
    }
    if (material.alpha_mode == AlphaMode::opaque) factor[3] = 1;
    return factor;
}

Vec3f SourceSampler::stored_base_color(Index p, const SurfacePoint& point) const {
    const Part& part = asset_.parts[p];
    const MaterialSlots& s = slots(p, point);
    const Vec4f factor = base_factor(*s.material, part, point);
    Vec3f color = {1, 1, 1};
    if (const TextureSlot& base = s[CoreTexture::base_color]; base.image) {
        const auto uv = uv_at(base, part, point);
        color = base.image->stored_color(*base.texture_ref, uv[0], uv[1]);
    }
    for (std::size_t k = 0; k < 3; ++k) color[k] *= factor[k];
    return color;
}

Appearance SourceSampler::sample(Index p, const SurfacePoint& point, double spacing) const {
    const Part& part = asset_.parts[p];
    const MaterialSlots& s = slots(p, point);
    const Material& m = *s.material;
    Appearance result;
    FetchCache cache;
    const Vec4f factor = base_factor(m, part, point);
    LinearColor base{1, 1, 1, 1};
    if (const TextureSlot& slot = s[CoreTexture::base_color]; slot.image)
        base = fetch(slot, p, point, spacing, cache);
    for (std::size_t k = 0; k < 3; ++k) result.base[k] = base[k] * factor[k] * factor[3];
    result.base[3] = base[3] * factor[3];

    Vec3f& orm = result.plain[orm_image] = {1, m.roughness, m.metallic};
    LinearColor data{};
    if (const TextureSlot& slot = s[CoreTexture::metallic_roughness]; slot.image) {
        data = fetch(slot, p, point, spacing, cache);
        for (std::size_t k = 1; k < 3; ++k) orm[k] *= data[k];
    }
    if (const TextureSlot& slot = s[CoreTexture::occlusion]; slot.image) {
        // Most materials have occlusion, roughness and metalness in one image.
        if (!s.shares_occlusion) data = fetch(slot, p, point, spacing, cache);
        orm[0] = 1 + m.occlusion_strength * (data[0] - 1);
    }
    Vec3f& emissive = result.plain[emissive_image] = m.emissive;
    if (const TextureSlot& slot = s[CoreTexture::emissive]; slot.image) {
        const LinearColor c = fetch(slot, p, point, spacing, cache);
        for (std::size_t k = 0; k < 3; ++k) emissive[k] *= c[k];
    }
    return result;
}

Vector3 SourceSampler::normal(Index p, const SurfacePoint& point, double spacing,
                              const Vector3& face_normal) const {
    const MaterialSlots& s = slots(p, point);
    return perturbed_normal(s[CoreTexture::normal], s.material->normal_scale, p, point, spacing, face_normal);
}

Vector3 SourceSampler::perturbed_normal(const TextureSlot& slot, double scale, Index p,
                                        const SurfacePoint& point, double spacing,
                                        const Vector3& face_normal) const {
    const Part& part = asset_.parts[p];
    const Vector3 smooth = interpolated_normal(part, point);
    Vector3 result = smooth;
    if (slot.image) {
        FetchCache cache;
        const LinearColor c = fetch(slot, p, point, spacing, cache);
        const Vector3 tangent_space_normal(scale * (2 * c[0] - 1.0), scale * (2 * c[1] - 1.0),
                                           2 * c[2] - 1.0);
        std::array<FrameCorner, 3> corners;
        for (std::size_t i = 0; i < 3; ++i)
            corners[i] = {corner_normal(part, point.face, i), tangents_[p][std::size_t{3} * point.face + i]};
        result = blend_frames(corners, point.barycentric).to_mesh(tangent_space_normal);
        const double length = result.norm();
        result = length > 1e-6 && std::isfinite(length) ? Vector3(result / length) : smooth;
    }
    const bool from_behind = smooth.dot(face_normal) < 0 &&
                             winding_normal(part.positions, part.triangles[point.face]).dot(face_normal) < 0;
    return from_behind ? Vector3(-result) : result;
}

LinearColor SourceSampler::layer(Index p, const SurfacePoint& point, double spacing,
                                 const ExtensionLayer& layer) const {
    FetchCache cache;
    return fetch(slots(p, point).extensions[layer.textures.front()], p, point, spacing, cache);
}

Vector3 SourceSampler::layer_normal(Index p, const SurfacePoint& point, double spacing,
                                    const Vector3& face_normal, const ExtensionLayer& layer) const {
    const TextureSlot& slot = slots(p, point).extensions[layer.textures.front()];
    return perturbed_normal(slot, layer.normal_scale, p, point, spacing, face_normal);
}

bool SourceSampler::has_jump(Index p, const SurfacePoint& a, const SurfacePoint& b) const {
    constexpr double visible_jump = 0.06;  // of values in [0, 1], colours in sRGB
    const Appearance first = sample(p, a, 0), second = sample(p, b, 0);
    const auto is_visible = [&](double x, double y) { return !(std::abs(x - y) <= visible_jump); };
    for (std::size_t k = 0; k < 4; ++k)
        if (is_visible(srgb_from_linear(first.base[k]), srgb_from_linear(second.base[k]))) return true;
    for (std::size_t i = 0; i < first.plain.size(); ++i) {
        for (std::size_t k = 0; k < 3; ++k)
            if (is_visible(first.plain[i][k], second.plain[i][k])) return true;
    }
    return false;
}

double SourceSampler::texel_density(Index p, Index face) const {
    const Part& part = asset_.parts[p];
    const MaterialSlots& s = slots(face_material(part, face));
    double density = 0;
    s.for_each_image([&](const TextureSlot& slot) {
        const std::uint32_t set = slot.texture_ref->uv_set;
        if (set < part.uvs.size())
            density = std::max(density, densities_[p].uv_per_length[set][face] * slot.texels_per_uv);
    });
    return std::max(density, densities_[p].untextured_density);
}

}  // namespace faqem::detail

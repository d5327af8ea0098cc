#include "bake/texture/page_material.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "asset/image/srgb.hpp"
#include "asset/scene/material_textures.hpp"

namespace faqem::detail {
namespace {

using TextureMember = TextureRef Material::*;

// Normal maps of this side and less are not halved.
constexpr std::uint32_t min_new_map_side = 64;

// Adds the images of one page to the result, to be encoded later.
struct PageImageList {
    const Asset& source;
    const BakeOptions& bake;
    std::string name;
    UnencodedResult& out;
    double roughness = 1;  ///< mean of the page

    /// \param known  by texel: nonzero if it shows a triangle
    /// \param from   textures of the source that the image is baked from
    TextureRef add(Pixels pixels, std::shared_ptr<const std::vector<std::uint8_t>> known,
                   const std::string& suffix, TextureContent content, const std::vector<TextureRef>& from) {
        std::vector<Image>& images = out.asset.asset.images;
        const TextureRef ref = {
            .image = static_cast<Index>(images.size()), .wrap_u = Wrap::clamp, .wrap_v = Wrap::clamp};
        images.emplace_back();
        // A density that was asked for is kept, as is the resolution that a correspondence has.
        const bool may_shrink = !bake.texel_density && bake.correspondence == Recording::off;
        out.pending.push_back({ref.image, std::move(pixels), std::move(known), name + suffix, content,
                               roughness, may_shrink, is_from_jpeg(from), false, tries_webp(source)});
        return ref;
    }

    bool is_from_jpeg(const std::vector<TextureRef>& from) const {
        return !from.empty() && std::all_of(from.begin(), from.end(), [&](const TextureRef& texture_ref) {
            return source.images[texture_ref.image].mime_type == "image/jpeg";
        });
    }
};

// "sheenColorTexture" -> "_sheenColor"
std::string suffix_of(const ExtensionTexture& texture) {
    constexpr std::string_view ending = "Texture";
    return std::string("_").append(texture.name, 0, texture.name.size() - ending.size());
}

// Whether an image leaves the factors that it is multiplied by unchanged wherever it is known.
bool is_neutral(const ExtensionLayer& layer, const Pixels& pixels, std::span<const std::uint8_t> known) {
    if (layer.is_normal_map()) return is_flat_normal_map(pixels, known);
    const auto values = constant_channels(pixels, known);
    const auto is_one = [](const std::optional<float>& value) { return value && *value == 255; };
    const bool color = std::all_of(values.begin(), values.begin() + 3, is_one);
    return (color || !layer.has_color()) && (is_one(values[3]) || !layer.has_alpha());
}

void add_layers(PageImageList& list, const Material& source, std::span<const ExtensionLayer> layers,
                PageImages& images, Material& result) {
    const auto known = std::make_shared<const std::vector<std::uint8_t>>(std::move(images.known_layers));
    for (std::size_t i = 0; i < layers.size(); ++i) {
        const ExtensionLayer& layer = layers[i];
        if (is_neutral(layer, images.layers[i], *known)) continue;
        const TextureRef ref = list.add(std::move(images.layers[i]), known,
                                        suffix_of(source.extension_textures[layer.textures.front()]),
                                        layer.content, {layer.texture_ref});
        for (const Index t : layer.textures) {
            const ExtensionTexture& texture = source.extension_textures[t];
            result.extension_textures.push_back({texture.extension, texture.name, ref});
        }
    }
}

// Whether a normal map that shows the geometry of the source gets half the sides of the page: the surface varies
// less than its colours.
bool may_halve_new_map(const BakeOptions& bake, const PendingImage& image) {
    return has_image_quality(bake.image_format) && bake.normal_map == NormalMap::automatic &&
           image.may_shrink && std::min(image.pixels.width, image.pixels.height) > min_new_map_side;
}

// Linear value of a constant sRGB channel.
float linear_factor(float value) { return static_cast<float>(linear_from_srgb(value / 255)); }

// The colours of an image as a factor, if they are constant.
std::optional<Vec4f> constant_color(const Pixels& pixels, std::span<const std::uint8_t> known) {
    const auto [r, g, b, a] = constant_channels(pixels, known);
    if (!r || !g || !b || !a) return std::nullopt;
    return Vec4f{linear_factor(*r), linear_factor(*g), linear_factor(*b), *a / 255};
}

// Mean roughness over the texels that are shown; without a texture the factor, which a page has in common.
double mean_roughness(const Channels& channels, const PageImages& images, const Material& material) {
    if (!channels[CoreTexture::metallic_roughness]) return std::clamp(double{material.roughness}, 0.0, 1.0);
    double sum = 0;
    std::uint64_t count = 0;
    for (std::size_t i = 0; i < images.known.size(); ++i) {
        if (!images.known[i]) continue;
        sum += images.plain[orm_image].rgba[4 * i + 1];
        ++count;
    }
    return count > 0 ? sum / 255 / static_cast<double>(count) : 1;
}

// Textures of a group in the given slots.
std::vector<TextureRef> textures_of_group(const Asset& source, const MaterialGroup& group,
                                          std::initializer_list<TextureMember> slots) {
    std::vector<TextureRef> found;
    for (const Index m : group.materials) {
        for (const TextureMember slot : slots)
            if (const TextureRef& texture_ref = material_or_default(source, m).*slot)
                found.push_back(texture_ref);
    }
    return found;
}

// Adds the image that occlusion, roughness and metalness share, or sets the factors if they are constant.
void add_occlusion_roughness_metallic(PageImageList& list, const Channels& channels, PageImages& images,
                                      const std::shared_ptr<const std::vector<std::uint8_t>>& known,
                                      const std::vector<TextureRef>& from, Material& result) {
    const auto [occlusion, roughness, metallic, alpha] =
        constant_channels(images.plain[orm_image], images.known);
    const bool has_occlusion = channels[CoreTexture::occlusion] && occlusion != 255.0f;
    const bool is_varying = channels[CoreTexture::metallic_roughness] && !(roughness && metallic);
    TextureRef texture;
    if (has_occlusion || is_varying)
        texture = list.add(std::move(images.plain[orm_image]), known, "_occlusionRoughnessMetallic",
                           TextureContent::data, from);
    if (has_occlusion) result.occlusion_texture = texture;
    if (!channels[CoreTexture::metallic_roughness]) return;
    result.metallic = is_varying ? 1 : *metallic / 255;
    result.roughness = is_varying ? 1 : *roughness / 255;
    if (is_varying) result.metallic_roughness_texture = texture;
}

}  // namespace

std::array<std::optional<float>, 4> constant_channels(const Pixels& pixels,
                                                      std::span<const std::uint8_t> known) {
    std::array<std::uint8_t, 4> low = {255, 255, 255, 255}, high = {};
    bool is_empty = true;
    for (std::size_t i = 0; i < pixels.rgba.size() / 4; ++i) {
        if (!known[i]) continue;
        is_empty = false;
        for (std::size_t k = 0; k < 4; ++k) {
            low[k] = std::min(low[k], pixels.rgba[4 * i + k]);
            high[k] = std::max(high[k], pixels.rgba[4 * i + k]);
        }
    }
    std::array<std::optional<float>, 4> result;
    for (std::size_t k = 0; k < 4 && !is_empty; ++k)
        if (high[k] - low[k] <= 1) result[k] = static_cast<float>(low[k] + high[k]) / 2;
    return result;
}

bool is_flat_normal_map(const Pixels& pixels, std::span<const std::uint8_t> known) {
    const auto [x, y, z, alpha] = constant_channels(pixels, known);
    const auto is_zero = [](const std::optional<float>& c) { return c && std::abs(*c - 127.5f) <= 1; };
    return is_zero(x) && is_zero(y) && z && *z >= 254;
}

Material page_material(const Asset& source, const BakeOptions& bake, const MaterialGroup& group,
                       const Channels& channels, std::span<const ExtensionLayer> layers, PageImages images,
                       UnencodedResult& out) {
    Material result = group.material;
    remove_textures(result);
    const auto uses = [&](std::initializer_list<TextureMember> slots) {
        return textures_of_group(source, group, slots);
    };
    PageImageList list{
        source, bake,
        result.name.empty() ? "material" + std::to_string(out.asset.asset.materials.size()) : result.name,
        out};
    const auto known = std::make_shared<const std::vector<std::uint8_t>>(images.known);
    list.roughness = mean_roughness(channels, images, group.material);
    if (channels[CoreTexture::base_color]) {
        const std::optional<Vec4f> constant = constant_color(images.base, images.known);
        result.base_color = constant.value_or(Vec4f{1, 1, 1, 1});
        if (!constant)
            result.base_color_texture =
                list.add(std::move(images.base), known, "_baseColor", TextureContent::color,
                         uses({&Material::base_color_texture}));
    }
    if (channels[CoreTexture::metallic_roughness] || channels[CoreTexture::occlusion]) {
        add_occlusion_roughness_metallic(
            list, channels, images, known,
            uses({&Material::metallic_roughness_texture, &Material::occlusion_texture}), result);
    }
    if (channels[CoreTexture::emissive]) {
        const std::optional<Vec4f> constant = constant_color(images.plain[emissive_image], images.known);
        const auto [r, g, b, alpha] = constant.value_or(Vec4f{1, 1, 1, 1});
        result.emissive = {r, g, b};
        if (!constant)
            result.emissive_texture = list.add(std::move(images.plain[emissive_image]), known, "_emissive",
                                               TextureContent::color, uses({&Material::emissive_texture}));
    }
    if (channels[CoreTexture::normal] && !is_flat_normal_map(images.normal, images.known)) {
        const std::vector<TextureRef> from = uses({&Material::normal_texture});
        result.normal_texture =
            list.add(std::move(images.normal), known, "_normal", TextureContent::normal, from);
        PendingImage& image = out.pending.back();
        image.is_new_map = from.empty();
        if (from.empty() && may_halve_new_map(bake, image)) halve(image);
    }
    const bool is_unchanged = group.materials.size() == 1 && group.material.extensions.empty() &&
                              !has_textures(group.material) && !has_textures(result);
    result.rebaked = !is_unchanged;
    add_layers(list, group.material, layers, images, result);
    return result;
}

}  // namespace faqem::detail

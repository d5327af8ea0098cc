#include "bake/keep/kept_images.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "asset/image/image.hpp"
#include "asset/scene/material_textures.hpp"
#include "asset/scene/source_traits.hpp"
#include "bake/keep/uv_texels.hpp"
#include "bake/texture/image_choice.hpp"
#include "render/texture_sampling.hpp"
#include "scene/material_groups.hpp"

namespace faqem::detail {
namespace {

// What materials use an image for.
struct ImageUse {
    bool is_used = false;    // by a part whose images may change
    bool is_fixed = false;   // stays as it is
    bool is_color = false;   // holds colours, not only data
    double roughness = 1;    // least of the materials
    bool is_normal = false;  // holds normals
    bool needs_alpha = false;
    bool is_pixel_art = false;         // shown without filter
    std::array<bool, 2> repeats = {};  // by a texture, in x and y
};

// Calls visit(texture, content); content is null for a texture of an unknown extension.
template <class Visit>
void for_each_content(const Material& m, const Visit& visit) {
    for (const CoreSlot& slot : core_slots) {
        const bool is_opaque = m.alpha_mode == AlphaMode::opaque && is_color(slot.content);
        const TextureContent content = is_opaque ? TextureContent::color : slot.content;
        if (m.*slot.texture) visit(m.*slot.texture, &content);
    }
    for (const ExtensionTexture& e : m.extension_textures) {
        if (!e.texture) continue;
        const KnownTexture* found = find_known_texture(e.extension, e.name);
        visit(e.texture, found ? &found->content : nullptr);
    }
}

void add_use(ImageUse& use, const TextureRef& texture, const TextureContent* content) {
    use.is_used = true;
    use.is_pixel_art = use.is_pixel_art || texture.filter == Filter::nearest;
    use.repeats[0] = use.repeats[0] || texture.wrap_u == Wrap::repeat;
    use.repeats[1] = use.repeats[1] || texture.wrap_v == Wrap::repeat;
    if (!content) {
        use.is_fixed = true;
        return;
    }
    use.is_color = use.is_color || is_color(*content);
    use.is_normal = use.is_normal || *content == TextureContent::normal;
    use.needs_alpha =
        use.needs_alpha || *content == TextureContent::alpha || *content == TextureContent::color_and_alpha;
}

// Roughness of a material in the mean: a texture may make it anything between 0 and the factor.
double assumed_roughness(const Material& material) {
    const double factor = std::clamp(double{material.roughness}, 0.0, 1.0);
    return material.metallic_roughness_texture ? factor / 2 : factor;
}

// The materials of the faces of a part and of its variants.
std::vector<Index> shown_materials(const Asset& asset, const Part& part) {
    std::vector<Index> result = materials_of(part);
    for (const Index m : variant_materials(asset, part)) result.push_back(m);
    return result;
}

std::vector<ImageUse> image_uses(const Asset& asset, std::span<const KeptPart> parts) {
    std::vector<ImageUse> result(asset.images.size());
    for (const KeptPart& kept : parts) {
        for (const Index m : shown_materials(asset, asset.parts[kept.part])) {
            const Material& material = asset.materials[m];
            for_each_content(material, [&](const TextureRef& texture, const TextureContent* content) {
                ImageUse& use = result[texture.image];
                if (kept.keeps_images)
                    use.is_fixed = true;
                else
                    add_use(use, texture, content);
                use.roughness = std::min(use.roughness, assumed_roughness(material));
            });
        }
    }
    const bool has_other_uses = names_objects_by_number(asset);
    for (std::size_t i = 0; i < result.size(); ++i) {
        if (keeps_encoding(asset.images[i])) result[i].is_fixed = true;
        if (has_other_uses) result[i].needs_alpha = true;
    }
    return result;
}

// Whether an animation moves a texture with an image, so that other texels are shown than those of the UVs.
bool is_moved(const Asset& asset, Index image) {
    const std::vector<std::uint8_t> moving = materials_with_moving_textures(asset);
    for (std::size_t m = 0; m < moving.size(); ++m)
        if (moving[m] && !asset.materials[m].rebaked && uses_image(asset.materials[m], image)) return true;
    return false;
}

// Whether the variant of a part shows an image. Which faces show it is not known then.
bool is_in_variant(const Asset& asset, std::span<const KeptPart> parts, Index image) {
    return std::any_of(parts.begin(), parts.end(), [&](const KeptPart& kept) {
        const auto materials = variant_materials(asset, asset.parts[kept.part]);
        return std::any_of(materials.begin(), materials.end(),
                           [&](Index m) { return uses_image(asset.materials[m], image); });
    });
}

// By texel of an image: whether a part shows it.
std::vector<std::uint8_t> texels_of_parts(const Asset& asset, std::span<const KeptPart> parts, Index image,
                                          const Pixels& pixels) {
    UvTexels texels(pixels.width, pixels.height);
    for (const KeptPart& kept : parts) {
        const Part& part = asset.parts[kept.part];
        std::map<Index, std::vector<TextureRef>> textures;  // by material
        for (const Index m : materials_of(part)) {
            for_each_texture(asset.materials[m], [&](const TextureRef& texture) {
                if (texture.image == image && texture.uv_set < part.uvs.size())
                    textures[m].push_back(texture);
            });
        }
        if (textures.empty()) continue;
        for (std::size_t f = 0; f < part.triangles.size(); ++f) {
            const auto of_face = textures.find(part.face_material[f]);
            if (of_face == textures.end()) continue;
            for (const TextureRef& texture : of_face->second) {
                const UvTransform transform = uv_transform(texture);
                std::array<Vec2f, 3> uv;
                for (std::size_t k = 0; k < 3; ++k)
                    uv[k] = transform.apply(part.uvs[texture.uv_set][part.triangles[f][k]]);
                texels.add(uv, texture.wrap_u, texture.wrap_v);
            }
        }
    }
    return std::move(texels).finish();
}

// Whether an image must get fewer texels.
bool exceeds(const Pixels& pixels, const ImageUse& use, std::uint32_t texture_size) {
    return !use.is_pixel_art && std::max(pixels.width, pixels.height) > texture_size && can_be_halved(pixels);
}

// The decoded image without alpha that nothing uses.
Pixels used_pixels(const Image& image, const ImageUse& use) {
    Pixels pixels = decode(image);
    if (!use.needs_alpha && pixels.has_alpha) {
        for (std::size_t i = 3; i < pixels.rgba.size(); i += 4) pixels.rgba[i] = 255;
        pixels.has_alpha = false;
    }
    return pixels;
}

TextureContent content_of(const ImageUse& use) {
    if (use.is_color) return TextureContent::color;
    return use.is_normal ? TextureContent::normal : TextureContent::data;
}

// \param result  has the images of the source
PendingImage kept_image(const Asset& source, const Asset& result, std::span<const KeptPart> parts,
                        Index index, const ImageUse& use, std::uint32_t texture_size) {
    const Image& image = result.images[index];
    PendingImage pending{index,         used_pixels(image, use), {}, image.name, content_of(use),
                         use.roughness, !use.is_pixel_art};
    pending.tries_webp = tries_webp(source);
    pending.repeats = use.repeats;
    if (!exceeds(pending.pixels, use, texture_size)) pending.original = image;
    while (exceeds(pending.pixels, use, texture_size)) pending.pixels = halved(pending.pixels);
    pending.known = std::make_shared<const std::vector<std::uint8_t>>(
        is_moved(result, index) || is_in_variant(result, parts, index)
            ? std::vector<std::uint8_t>(std::size_t{pending.pixels.width} * pending.pixels.height, 1)
            : texels_of_parts(result, parts, index, pending.pixels));
    return pending;
}

}  // namespace

void add_kept_images(const Asset& source, const BakeOptions& bake, std::span<const KeptPart> parts,
                     const RunContext& context, UnencodedResult& out) {
    if (bake.image_format == ImageFormat::source) return;
    const Asset& result = out.asset.asset;
    const std::vector<ImageUse> uses = image_uses(result, parts);
    std::vector<Index> changing;
    for (Index i = 0; i < uses.size(); ++i)
        if (uses[i].is_used && !uses[i].is_fixed) changing.push_back(i);
    const std::size_t first = out.pending.size();
    out.pending.resize(first + changing.size());
    parallel_blocks(
        changing.size(), 1, context, [&](std::size_t i, std::size_t, const RunContext& block_context) {
            block_context.check_now();
            out.pending[first + i] =
                kept_image(source, result, parts, changing[i], uses[changing[i]], bake.texture_size);
        });
}

}  // namespace faqem::detail

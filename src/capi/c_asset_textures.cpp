#include <string>

#include "asset/scene/material_textures.hpp"
#include "capi/c_asset.hpp"
#include "faqem/asset.hpp"

struct faqem_pixels {
    faqem::Pixels pixels;
};

namespace {

using namespace faqem;

static_assert(no_index == UINT32_MAX);

// The values of faqem_texture are those of CoreTexture.
const TextureRef* find_texture(const Material& material, faqem_texture texture) {
    const auto number = static_cast<std::size_t>(texture);
    return number < detail::core_slots.size() ? &(material.*detail::core_slots[number].texture) : nullptr;
}
static_assert(detail::core_slots[FAQEM_TEXTURE_BASE_COLOR].texture == &Material::base_color_texture &&
              detail::core_slots[FAQEM_TEXTURE_METALLIC_ROUGHNESS].texture ==
                  &Material::metallic_roughness_texture &&
              detail::core_slots[FAQEM_TEXTURE_NORMAL].texture == &Material::normal_texture &&
              detail::core_slots[FAQEM_TEXTURE_OCCLUSION].texture == &Material::occlusion_texture &&
              detail::core_slots[FAQEM_TEXTURE_EMISSIVE].texture == &Material::emissive_texture);

}  // namespace

size_t faqem_asset_uv_set_count(const faqem_asset* asset, size_t part) {
    const Part* p = capi::find(asset, &Asset::parts, part);
    return p ? p->uvs.size() : 0;
}

const float* faqem_asset_uvs(const faqem_asset* asset, size_t part, size_t set) {
    const Part* p = capi::find(asset, &Asset::parts, part);
    return p && set < p->uvs.size() && !p->uvs[set].empty() ? p->uvs[set].front().data() : nullptr;
}

const uint32_t* faqem_asset_face_materials(const faqem_asset* asset, size_t part) {
    const Part* p = capi::find(asset, &Asset::parts, part);
    return p && !p->face_material.empty() ? p->face_material.data() : nullptr;
}

size_t faqem_asset_material_count(const faqem_asset* asset) {
    return asset ? asset->asset.materials.size() : 0;
}

const char* faqem_asset_material_name(const faqem_asset* asset, size_t material) {
    const Material* found = capi::find(asset, &Asset::materials, material);
    return found ? found->name.c_str() : nullptr;
}

uint32_t faqem_asset_material_image(const faqem_asset* asset, size_t material, faqem_texture texture,
                                    uint32_t* uv_set) {
    const Material* found = capi::find(asset, &Asset::materials, material);
    const TextureRef* used = found ? find_texture(*found, texture) : nullptr;
    if (!used || !capi::find(asset, &Asset::images, used->image)) return no_index;
    if (uv_set) *uv_set = used->uv_set;
    return used->image;
}

size_t faqem_asset_image_count(const faqem_asset* asset) { return asset ? asset->asset.images.size() : 0; }

const char* faqem_asset_image_name(const faqem_asset* asset, size_t image) {
    const Image* found = capi::find(asset, &Asset::images, image);
    return found ? found->name.c_str() : nullptr;
}

const char* faqem_asset_image_mime_type(const faqem_asset* asset, size_t image) {
    const Image* found = capi::find(asset, &Asset::images, image);
    return found ? found->mime_type.c_str() : nullptr;
}

const uint8_t* faqem_asset_image_bytes(const faqem_asset* asset, size_t image, size_t* size) {
    const Image* found = capi::find(asset, &Asset::images, image);
    if (size) *size = found ? found->encoded.size() : 0;
    return found && !found->encoded.empty() ? found->encoded.data() : nullptr;
}

faqem_status faqem_asset_decode_image(const faqem_asset* asset, size_t image, faqem_pixels** pixels,
                                      faqem_error* error) {
    return capi::catch_exceptions(error, {{asset, "asset"}, {pixels, "pixels"}}, [&] {
        const Image* found = capi::find(asset, &Asset::images, image);
        if (!found)
            throw OptionError("image: " + std::to_string(image) + " is not one of the " +
                              std::to_string(asset->asset.images.size()) + " images");
        *pixels = new faqem_pixels{decode(*found)};
    });
}

void faqem_pixels_destroy(faqem_pixels* pixels) { delete pixels; }

uint32_t faqem_pixels_width(const faqem_pixels* pixels) { return pixels ? pixels->pixels.width : 0; }

uint32_t faqem_pixels_height(const faqem_pixels* pixels) { return pixels ? pixels->pixels.height : 0; }

int32_t faqem_pixels_has_alpha(const faqem_pixels* pixels) {
    return pixels && pixels->pixels.has_alpha ? 1 : 0;
}

uint8_t* faqem_pixels_rgba(faqem_pixels* pixels) {
    return pixels && !pixels->pixels.rgba.empty() ? pixels->pixels.rgba.data() : nullptr;
}

#include "asset/formats/mtl.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "asset/formats/referenced_images.hpp"
#include "asset/image/combine.hpp"
#include "faqem/error.hpp"

namespace faqem::detail {
namespace {

/// Height of white in a height map, as a part of the texture's side, for -bm 1: there is no standard. Reliefs of walls,
/// tiles and bark are one or two hundredths of their width.
constexpr double bump_depth = 1.0 / 64;

TextureRef placed(const MtlTexture& texture, Index image) {
    // MTL defines v' = o + s * v with v pointing up. With v = 1 - w this becomes w' = (1 - s - o) + s * w.
    return {.image = image,
            .wrap_u = texture.wrap,
            .wrap_v = texture.wrap,
            .offset = {texture.offset[0], 1 - texture.scale[1] - texture.offset[1]},
            .scale = texture.scale};
}

bool has_same_placement(const MtlTexture& a, const MtlTexture& b) {
    return placed(a, no_index) == placed(b, no_index);
}

/// Key of a derived image for the value of a texture.
std::string value_key(const ReferencedImage* image, const MtlTexture& texture) {
    return image ? image->image.uri + "|" + std::to_string(static_cast<int>(texture.channel)) : "|";
}

ScalarChannel data_channel(const MtlTexture& texture) {
    return texture.channel == ScalarChannel::automatic ? ScalarChannel::luminance : texture.channel;
}

bool is_constant(const ScalarImage& image, std::uint8_t value) {
    return std::ranges::all_of(image.values, [&](std::uint8_t v) { return v == value; });
}

const char* const hides_everything = "map_d would hide everything, and is left out";

/// Adds materials and their images to an asset.
struct MtlMaterials {
    Asset& asset;
    ReferencedImages& images;

    /// Returns the index of the material in Asset::materials.
    Index add(const MtlMaterial& source) {
        Material material = source.values;
        set_base_color(material, source);
        if (ReferencedImage* image = read(source, source.emissive))
            material.emissive_texture = placed(source.emissive, images.use(*image));
        set_normals(material, source);
        set_roughness_metallic(material, source);
        asset.materials.push_back(std::move(material));
        return static_cast<Index>(asset.materials.size() - 1);
    }

    void set_base_color(Material& to, const MtlMaterial& from) {
        ReferencedImage* color = read(from, from.color);
        ReferencedImage* alpha = read(from, from.alpha);
        if (alpha) attempt(from, "map_d", [&] { set_alpha(to, from, color, *alpha); });
        if (color && !to.base_color_texture) to.base_color_texture = placed(from.color, images.use(*color));
    }

    void set_alpha(Material& to, const MtlMaterial& from, ReferencedImage* color, ReferencedImage& alpha) {
        const bool is_own_alpha = color == &alpha && (from.alpha.channel == ScalarChannel::automatic ||
                                                      from.alpha.channel == ScalarChannel::alpha);
        if (is_own_alpha) {
            try {
                if (is_constant(scalar_image(images.decode(alpha), ScalarChannel::alpha), 0))
                    return warn(from, hides_everything);
            } catch (const InputError&) {  // reported when its pixels are needed
            }
            to.alpha_mode = AlphaMode::blend;
            return;
        }
        if (color && !has_same_placement(from.color, from.alpha))
            return warn(from, "map_d left out: its options differ from those of map_Kd");
        const ScalarImage values = scalar_image(images.decode(alpha), from.alpha.channel);
        if (is_constant(values, 0)) return warn(from, hides_everything);
        if (is_constant(values, 255)) return;
        const std::string key =
            "alpha|" + (color ? color->image.uri : std::string()) + "|" + value_key(&alpha, from.alpha);
        const Index image = images.derive(key, color ? color->image.name : alpha.image.name, [&] {
            return with_alpha(color ? images.decode(*color) : Pixels{1, 1, {255, 255, 255, 255}, false},
                              values);
        });
        to.base_color_texture = placed(from.alpha, image);
        to.alpha_mode = AlphaMode::blend;
    }

    void set_normals(Material& to, const MtlMaterial& from) {
        if (ReferencedImage* image = read(from, from.normal)) {
            to.normal_texture = placed(from.normal, images.use(*image));
            to.normal_scale = from.normal.multiplier;
            if (!from.bump.file.empty() && from.bump.file != from.normal.file)
                warn(from, "bump left out beside norm");
            return;
        }
        if (ReferencedImage* image = read(from, from.bump))
            attempt(from, "bump", [&] { set_bump(to, from, *image); });
    }

    void set_bump(Material& to, const MtlMaterial& from, ReferencedImage& image) {
        const MtlTexture& bump = from.bump;
        if (bump.channel == ScalarChannel::automatic) {
            if (!image.is_normal_map) image.is_normal_map = is_normal_map(images.decode(image));
            if (*image.is_normal_map) {
                to.normal_texture = placed(bump, images.use(image));
                to.normal_scale = bump.multiplier;
                return;
            }
        }
        const std::string key = "bump|" + value_key(&image, bump) + "|" + std::to_string(bump.multiplier);
        const Index normals = images.derive(key, image.image.name, [&] {
            const ScalarImage heights = scalar_image(images.decode(image), data_channel(bump));
            if (is_constant(heights, heights.values.front())) return Pixels{};
            return normals_of_heights(heights, bump.multiplier * bump_depth);
        });
        if (normals != no_index) to.normal_texture = placed(bump, normals);
    }

    void set_roughness_metallic(Material& to, const MtlMaterial& from) {
        ReferencedImage* roughness = read(from, from.roughness);
        ReferencedImage* metallic = read(from, from.metallic);
        if (roughness && metallic && !has_same_placement(from.roughness, from.metallic)) {
            warn(from, "map_Pm left out: its options differ from those of map_Pr");
            metallic = nullptr;
        }
        if (!roughness && !metallic) return;
        const MtlTexture& texture = roughness ? from.roughness : from.metallic;
        const auto has_channels = [&](ScalarChannel r, ScalarChannel m) {
            return roughness == metallic && from.roughness.channel == r && from.metallic.channel == m;
        };
        const bool is_packed = has_channels(ScalarChannel::green, ScalarChannel::blue);  // as in glTF
        const bool may_be_packed = has_channels(ScalarChannel::automatic, ScalarChannel::automatic);
        attempt(from, "map_Pr and map_Pm", [&] {
            const std::string key =
                "metal|" + value_key(roughness, from.roughness) + "|" + value_key(metallic, from.metallic);
            Index image = images.derive(key, (roughness ? roughness : metallic)->image.name, [&] {
                const auto values = [&](const ReferencedImage* source, const MtlTexture& of) {
                    return source ? scalar_image(images.decode(*source), data_channel(of)) : ScalarImage{};
                };
                if (is_packed || (may_be_packed && !is_grey(images.decode(*roughness)))) return Pixels{};
                const ScalarImage r = values(roughness, from.roughness), m = values(metallic, from.metallic);
                return roughness_metallic(r, m);
            });
            if (image == no_index) image = images.use(*roughness);
            to.metallic_roughness_texture = placed(texture, image);
            if (roughness) to.roughness = 1;
            if (metallic) to.metallic = 1;
        });
    }

    ReferencedImage* read(const MtlMaterial& material, const MtlTexture& texture) {
        if (texture.file.empty()) return nullptr;
        return images.read("material '" + material.values.name + "'", texture.file, material.folder);
    }

    /// Sets textures, or warns that images of them are damaged.
    template <class Set>
    void attempt(const MtlMaterial& material, const std::string& textures, const Set& set) {
        try {
            set();
        } catch (const InputError& error) {
            warn(material, textures + " left out: " + error.what());
        }
    }

    void warn(const MtlMaterial& material, const std::string& what) {
        asset.warnings.push_back("material '" + material.values.name + "': " + what);
    }
};

}  // namespace

Index add_mtl_material(Asset& asset, ReferencedImages& images, const MtlMaterial& material) {
    return MtlMaterials{asset, images}.add(material);
}

}  // namespace faqem::detail

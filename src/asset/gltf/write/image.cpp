#include <algorithm>
#include <iterator>
#include <utility>

#include "asset/gltf/write/writer.hpp"
#include "asset/image/image.hpp"

namespace faqem::detail {
namespace {

// glTF constants of filters.
constexpr int gl_nearest_mipmap_nearest = 9984, gl_linear_mipmap_linear = 9987;

std::uint32_t wrap_mode(Wrap wrap) { return wrap_modes[static_cast<std::size_t>(wrap)]; }

Index make_sampler(GltfWriter& writer, const TextureRef& ref) {
    return once(writer.samplers, {ref.wrap_u, ref.wrap_v, ref.filter}, [&] {
        const bool smooth = ref.filter == Filter::linear;
        return append(writer, "samplers",
                      {{"magFilter", smooth ? gl_linear : gl_nearest},
                       {"minFilter", smooth ? gl_linear_mipmap_linear : gl_nearest_mipmap_nearest},
                       {"wrapS", wrap_mode(ref.wrap_u)},
                       {"wrapT", wrap_mode(ref.wrap_v)}});
    });
}

Index add_image(GltfWriter& writer, const Image& image, Json json) {
    if (!image.name.empty()) json["name"] = image.name;
    writer.images.push_back(&image);
    return append(writer, "images", std::move(json));
}

/// \param json  other members of the image
Index write_asset_image(GltfWriter& writer, Index image, Json json = Json::object()) {
    if (writer.source_image_of[image] != no_index) return copy_image(writer, writer.source_image_of[image]);
    return once(writer.asset_images, image, [&] {
        const Image* written = &writer.asset.images[image];
        if (needs_plugin(*written)) {
            writer.converted_images.push_back(encode_png(decode(*written), written->name));
            written = &writer.converted_images.back();
        }
        return add_image(writer, *written, std::move(json));
    });
}

/// Makes an image of the asset the only one of a texture.
void set_image(GltfWriter& writer, Json& texture, Index image) {
    texture.erase("source");
    if (texture.contains("extensions")) {
        auto& extensions = texture["extensions"].get_ref<Json::object_t&>();
        std::erase_if(extensions, [](const auto& own) { return own.second.contains("source"); });
        if (extensions.empty()) texture.erase("extensions");
    }
    const std::string& type = writer.asset.images[image].mime_type;
    const auto extension = std::ranges::find(image_extensions, type, &ImageExtension::media_type);
    (extension == std::end(image_extensions) ? texture : texture["extensions"][extension->name])["source"] =
        write_asset_image(writer, image);
}

}  // namespace

void find_source_images(GltfWriter& writer) {
    for (const Image& image : writer.asset.images) {
        const auto same = std::ranges::find_if(writer.source.images, [&](const Image& own) {
            return !image.encoded.empty() && own.encoded == image.encoded && own.mime_type == image.mime_type;
        });
        const auto index = static_cast<Index>(same - writer.source.images.begin());
        writer.source_image_of.push_back(same == writer.source.images.end() ? no_index : index);
    }
}

Index copy_image(GltfWriter& writer, Index image) {
    return once(writer.source_images, image, [&] {
        Json json = source_array(writer, "images")[image];
        for (const char* key : {"uri", "bufferView", "mimeType"}) json.erase(key);
        const Index other = writer.replaced_images.empty() ? no_index : writer.replaced_images[image];
        return other != no_index ? write_asset_image(writer, other, std::move(json))
                                 : add_image(writer, writer.source.images[image], std::move(json));
    });
}

Index copy_texture(GltfWriter& writer, Index texture, Index image) {
    if (!writer.replaced_images.empty()) {
        const Index own = texture_image(source_array(writer, "textures")[texture]);
        image = own == no_index ? no_index : writer.replaced_images[own];
    }
    return once(writer.source_textures, {texture, image}, [&] {
        Json json = source_array(writer, "textures")[texture];
        const auto remap_image = [&](Json& holder) {
            const Index own = index_member(holder, "source");
            if (own == no_index) return;
            if (writer.source.images[own].encoded.empty())
                holder.erase("source");
            else
                holder["source"] = copy_image(writer, own);
        };
        if (image != no_index) {
            set_image(writer, json, image);
        } else {
            remap_image(json);
            if (json.contains("extensions"))
                for (Json& extension : json["extensions"]) remap_image(extension);
        }
        if (const Index sampler = index_member(json, "sampler"); sampler != no_index)
            json["sampler"] = once(writer.source_samplers, sampler, [&] {
                return append(writer, "samplers", source_array(writer, "samplers")[sampler]);
            });
        return append(writer, "textures", std::move(json));
    });
}

Index make_texture(GltfWriter& writer, const TextureRef& ref) {
    const Index image = write_asset_image(writer, ref.image);
    return once(writer.textures, {image, ref.wrap_u, ref.wrap_v, ref.filter}, [&] {
        Json json = {{"sampler", make_sampler(writer, ref)}};
        set_image(writer, json, ref.image);
        return append(writer, "textures", std::move(json));
    });
}

}  // namespace faqem::detail

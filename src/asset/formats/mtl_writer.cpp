#include "asset/formats/mtl_writer.hpp"

#include "asset/scene/messages.hpp"

#include <algorithm>
#include <array>
#include <functional>

#include "asset/image/image.hpp"
#include "asset/image/srgb.hpp"
#include "asset/io/file.hpp"
#include "asset/scene/material_textures.hpp"
#include "asset/text/number_text.hpp"

namespace faqem::detail {
namespace {

/// Writes materials to the text of a library and collects their images.
class MtlWriter {
public:
    MtlWriter(const Asset& asset, const std::string& stem) : asset_(asset), stem_(stem) {}

    void add(const Material& material) {
        std::string& text = library_.text;
        library_.names.push_back(unique_name(sanitized_name(material.name, "material")));
        text += "newmtl " + library_.names.back() + "\n";
        color("Kd", {material.base_color[0], material.base_color[1], material.base_color[2]});
        const bool transparent = material.alpha_mode != AlphaMode::opaque;
        if (transparent && material.base_color[3] < 1) number("d", material.base_color[3]);
        number("Pr", material.roughness);
        number("Pm", material.metallic);
        const bool is_emissive = material.emissive != Vec3f{0, 0, 0};
        if (is_emissive) color("Ke", material.emissive);
        texture("map_Kd", material.base_color_texture);
        if (transparent) texture("map_d", material.base_color_texture);
        if (is_emissive) texture("map_Ke", material.emissive_texture);
        // glTF keeps roughness and metal in two channels of one image.
        texture("map_Pr -imfchan g", material.metallic_roughness_texture);
        texture("map_Pm -imfchan b", material.metallic_roughness_texture);
        std::string norm = "norm";
        if (material.normal_scale != 1) {
            norm += " -bm ";
            append_number(norm, material.normal_scale);
        }
        texture(norm, material.normal_texture);
    }

    MtlLibrary finish() { return std::move(library_); }

private:
    std::string unique_name(const std::string& name) const {
        const auto taken = [&](const std::string& candidate) {
            return std::ranges::find(library_.names, candidate) != library_.names.end();
        };
        std::string candidate = name;
        for (int i = 2; taken(candidate); ++i) candidate = name + "_" + std::to_string(i);
        return candidate;
    }

    void number(const char* key, float value) { append_line(library_.text, key, std::array{value}); }

    void color(const char* key, const Vec3f& linear) {
        Vec3 srgb;
        for (std::size_t k = 0; k < 3; ++k) srgb[k] = round_to_six_decimals(srgb_from_linear(linear[k]));
        append_line(library_.text, key, srgb);
    }

    /// \param key  with options
    void texture(const std::string& key, const TextureRef& ref) {
        if (!ref) return;
        const bool clamps = ref.wrap_u == Wrap::clamp && ref.wrap_v == Wrap::clamp;
        library_.text += key + (clamps ? " -clamp on " : " ") + image_name(ref.image) + "\n";
    }

    std::string image_name(Index image) {
        for (const MtlImage& known : library_.images)
            if (known.image == image) return known.name;
        const std::string extension = file_extension(asset_.images[image].mime_type);
        library_.images.push_back({image_file_name(stem_, library_.images.size(), extension), image});
        return library_.images.back().name;
    }

    const Asset& asset_;
    const std::string& stem_;
    MtlLibrary library_;
};

bool has_same_uvs(const TextureRef& a, const TextureRef& b) {
    return a.uv_set == b.uv_set && a.offset == b.offset && a.scale == b.scale && a.rotation == b.rotation;
}

/// The textures that MTL has, in the order of leading_texture().
constexpr std::array mtl_textures = {&Material::base_color_texture, &Material::emissive_texture,
                                     &Material::metallic_roughness_texture, &Material::normal_texture};

bool uses_other_uvs(const Material& m) {
    const auto differs = [&](const TextureRef& ref) { return ref && !has_same_uvs(ref, leading_texture(m)); };
    return differs(m.emissive_texture) || differs(m.metallic_roughness_texture) || differs(m.normal_texture);
}

bool has_unsupported_wrap(const Material& m) {
    return std::ranges::any_of(mtl_textures, [&](auto texture) {
        const TextureRef& ref = m.*texture;
        return ref && (ref.wrap_u != ref.wrap_v || ref.wrap_u == Wrap::mirror);
    });
}

void add_losses(const std::vector<Material>& materials, std::vector<std::string>& losses) {
    struct Loss {
        std::string what;
        std::function<bool(const Material&)> occurs;
    };
    std::vector<Loss> kinds = {
        {"factors of metallic-roughness textures",
         [](const Material& m) {
             return m.metallic_roughness_texture && (m.roughness != 1 || m.metallic != 1);
         }},
        {"alpha cutoffs: alpha masks become alpha blending",
         [](const Material& m) { return m.alpha_mode == AlphaMode::mask; }},
        {"unlit materials", [](const Material& m) { return m.unlit; }},
        {"double-sided materials", [](const Material& m) { return m.double_sided; }},
        {"material extensions", [](const Material& m) { return !m.extensions.empty(); }},
        {"different UVs for the textures of a material", uses_other_uvs},
        {"mirrored wrapping, or wrapping that differs in u and v", has_unsupported_wrap}};
    for (const CoreSlot& slot : core_slots)
        if (std::ranges::find(mtl_textures, slot.texture) == mtl_textures.end())
            kinds.insert(kinds.begin() + 1, {std::string(slot.title) + " textures",
                                             [&](const Material& m) { return bool(m.*slot.texture); }});
    for (const Loss& kind : kinds) {
        const auto count = std::ranges::count_if(materials, kind.occurs);
        if (count)
            losses.push_back("OBJ cannot hold " + kind.what + " (" +
                             pluralized(static_cast<std::uint64_t>(count), "material") + ")");
    }
}

}  // namespace

const TextureRef& leading_texture(const Material& material) {
    for (const auto texture : mtl_textures)
        if (material.*texture) return material.*texture;
    return material.normal_texture;
}

MtlLibrary make_mtl(const Asset& asset, const std::vector<Index>& used, const std::string& stem,
                    std::vector<std::string>& losses) {
    std::vector<Material> materials;
    for (const Index m : used) {
        materials.push_back(m == no_index ? Material{} : asset.materials[m]);
        if (m == no_index) materials.back().name = "default";
    }
    add_losses(materials, losses);
    MtlWriter writer(asset, stem);
    for (const Material& material : materials) writer.add(material);
    return writer.finish();
}

std::string sanitized_name(const std::string& name, const std::string& fallback) {
    std::string text = name;
    for (char& c : text)
        if (static_cast<unsigned char>(c) < 32 || c == 127) c = '_';
    text.erase(0, std::min(text.find_first_not_of(' '), text.size()));
    while (!text.empty() && (text.back() == ' ' || text.back() == '\\')) text.pop_back();
    return text.empty() ? fallback : text;
}

}  // namespace faqem::detail

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "asset/formats/formats.hpp"
#include "asset/image/image.hpp"
#include "asset/image/srgb.hpp"
#include "asset/io/file.hpp"
#include "asset/scene/flatten.hpp"
#include "asset/scene/material_textures.hpp"
#include "asset/scene/messages.hpp"
#include "asset/scene/position_rounding.hpp"
#include "asset/scene/value_numbers.hpp"
#include "asset/text/text_scanner.hpp"
#include "faqem/asset.hpp"

namespace faqem::detail {
namespace {

/// Makes a name valid for a statement: control characters are replaced, blanks at both ends and trailing
/// backslashes are removed. Returns `fallback` if nothing is left.
std::string sanitized_name(const std::string& name, const std::string& fallback) {
    std::string text = name;
    for (char& c : text)
        if (static_cast<unsigned char>(c) < 32 || c == 127) c = '_';
    text.erase(0, std::min(text.find_first_not_of(' '), text.size()));
    while (!text.empty() && (text.back() == ' ' || text.back() == '\\')) text.pop_back();
    return text.empty() ? fallback : text;
}

/// Makes names unique: of equal ones, the second gets `_2`, the third `_3` ...
class UniqueNames {
public:
    std::string operator()(const std::string& name) {
        std::string unique = name;
        std::size_t& number = next_number_[name];
        for (number = std::max<std::size_t>(number, 2); !taken_.insert(unique).second; ++number)
            unique = name + "_" + std::to_string(number);
        return unique;
    }

private:
    std::set<std::string> taken_;
    std::map<std::string, std::size_t> next_number_;
};

/// A material library and its images: writes materials to its text, and collects the images.
struct MtlWriter {
    const Asset& asset;
    const std::string& stem;  ///< image i gets the file name `stem`_i with the extension of its type
    std::string text = {};
    std::vector<std::string> names = {};   ///< unique names of the materials, in the given order
    std::vector<EncodedFile> images = {};  ///< for the folder of the library
    std::map<Index, std::string> image_names = {};
    UniqueNames unique = {};

    void add(const Material& material) {
        names.push_back(unique(sanitized_name(material.name, "material")));
        text += "newmtl " + names.back() + "\n";
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

    void number(const char* key, float value) { append_line(text, key, std::array{value}); }

    void color(const char* key, const Vec3f& linear) {
        Vec3 srgb;
        for (std::size_t k = 0; k < 3; ++k) srgb[k] = round_to_six_decimals(srgb_from_linear(linear[k]));
        append_line(text, key, srgb);
    }

    /// \param key  with options
    void texture(const std::string& key, const TextureRef& ref) {
        if (!ref) return;
        const bool clamps = ref.wrap_u == Wrap::clamp && ref.wrap_v == Wrap::clamp;
        text += key + (clamps ? " -clamp on " : " ") + image_name(ref.image) + "\n";
    }

    const std::string& image_name(Index index) {
        const auto [known, is_new] = image_names.try_emplace(index);
        if (is_new) {
            const Image& image = asset.images[index];
            known->second = image_file_name(stem, images.size(), file_extension(image.mime_type));
            images.push_back(encoded_image(known->second, image));
        }
        return known->second;
    }
};

bool has_same_uvs(const TextureRef& a, const TextureRef& b) {
    return a.uv_set == b.uv_set && a.offset == b.offset && a.scale == b.scale && a.rotation == b.rotation;
}

/// The textures that MTL has, in the order of leading_texture().
constexpr std::array mtl_textures = {&Material::base_color_texture, &Material::emissive_texture,
                                     &Material::metallic_roughness_texture, &Material::normal_texture};

/// The texture whose UV set and UV transform are used for the only UV set of the OBJ file: the base colour
/// texture if it is set, else the emissive texture, else the metallic-roughness texture, else the normal texture, set
/// or not.
const TextureRef& leading_texture(const Material& material) {
    for (const auto texture : mtl_textures)
        if (material.*texture) return material.*texture;
    return material.normal_texture;
}

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
    std::vector<std::pair<std::string, std::function<bool(const Material&)>>> kinds = {
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
    for (const auto& [what, occurs] : kinds) {
        const auto count = std::ranges::count_if(materials, occurs);
        if (count)
            losses.push_back("OBJ cannot hold " + what + " (" +
                             pluralized(static_cast<std::uint64_t>(count), "material") + ")");
    }
}

/// Converts materials to a library: the inverse of read_mtl(), with Pr for roughness and Pm for metallic.
/// \param used    indices into asset.materials; no_index is the default material
/// \param losses  receives what a library cannot hold, one sentence each
MtlWriter make_mtl(const Asset& asset, const std::vector<Index>& used, const std::string& stem,
                   std::vector<std::string>& losses) {
    std::vector<Material> materials;
    for (const Index m : used) {
        materials.push_back(m == no_index ? Material{} : asset.materials[m]);
        if (m == no_index) materials.back().name = "default";
    }
    add_losses(materials, losses);
    MtlWriter library{asset, stem};
    for (const Material& material : materials) library.add(material);
    return library;
}

/// The materials used by the faces, in the order of their first use; empty if no face has a material.
std::vector<Index> used_materials(const Part& part) {
    std::vector<Index> used;
    std::set<Index> known;
    for (const Index material : part.face_material)
        if (known.insert(material).second) used.push_back(material);
    if (used == std::vector<Index>{no_index}) used.clear();
    return used;
}

/// The values of a v line: a position and a colour.
using PositionLine = std::array<double, 6>;

/// Numbers the v, vt and vn lines in the order in which face corners use them, so that writing, reading and
/// writing again reproduces the file.
class VertexLines {
public:
    VertexLines(const Asset& asset, const Part& part)
        : asset_(asset),
          part_(part),
          position_line_(part.positions.size(), no_index),
          normal_line_(position_line_) {
        positions_.reserve(part.positions.size());
        if (!part.uvs.empty()) {
            uvs_.reserve(part.positions.size());
            uv_line_.resize(part.positions.size());
        }
        if (!part.normals.empty()) normals_.reserve(part.positions.size());
    }

    /// 1-based line numbers of v, vt and vn of a corner; 0 if absent.
    std::array<std::uint64_t, 3> corner(Index vertex, Index material) {
        std::array<std::uint64_t, 3> numbers = {std::uint64_t{position(vertex)} + 1, 0, 0};
        if (!part_.uvs.empty()) {
            CachedUv& known = uv_line_[vertex];
            if (known.number == no_index || known.material != material)
                known = {material, uvs_.insert(uv(vertex, material))};
            numbers[1] = std::uint64_t{known.number} + 1;
        }
        if (!part_.normals.empty() && part_.normals[vertex] != Vec3f{0, 0, 0}) {
            if (normal_line_[vertex] == no_index)
                normal_line_[vertex] = normals_.insert(part_.normals[vertex]);
            numbers[2] = std::uint64_t{normal_line_[vertex]} + 1;
        }
        return numbers;
    }

    Index position(Index vertex) {
        if (position_line_[vertex] != no_index) return position_line_[vertex];
        const Vec3& p = part_.positions[vertex];
        PositionLine row = {p[0], p[1], p[2], 0, 0, 0};
        for (std::size_t k = 0; k < 3 && !part_.colors.empty(); ++k)
            row[3 + k] = round_to_six_decimals(srgb_from_linear(part_.colors[vertex][k]));
        return position_line_[vertex] = positions_.insert(row);
    }

    void write(std::string& text) const {
        const bool floats = is_float_representable(part_.positions);
        for (const PositionLine& row : positions_.values()) {
            text += 'v';
            for (std::size_t k = 0; k < (part_.colors.empty() ? 3 : 6); ++k) {
                text += ' ';
                if (floats && k < 3)
                    append_number(text, static_cast<float>(row[k]));
                else
                    append_number(text, row[k]);
            }
            text += '\n';
        }
        for (const Vec2f& uv : uvs_.values()) append_line(text, "vt", uv);
        for (const Vec3f& normal : normals_.values()) append_line(text, "vn", normal);
    }

private:
    /// UV of a vertex, transformed for the leading texture of the material, with v pointing up.
    Vec2f uv(Index vertex, Index material) const {
        static const TextureRef none;
        const TextureRef& ref = material == no_index ? none : leading_texture(asset_.materials[material]);
        const Vec2f& uv = part_.uvs[ref.uv_set < part_.uvs.size() ? ref.uv_set : 0][vertex];
        const Vec2f scaled = {uv[0] * ref.scale[0], uv[1] * ref.scale[1]};
        Vec2f rotated = scaled;
        if (ref.rotation != 0) {
            const float c = std::cos(ref.rotation), s = std::sin(ref.rotation);
            rotated = {c * scaled[0] + s * scaled[1], c * scaled[1] - s * scaled[0]};
        }
        return {ref.offset[0] + rotated[0], 1 - (ref.offset[1] + rotated[1])};
    }

    /// Line number of the UV of a vertex for the material that used it last.
    struct CachedUv {
        Index material = no_index, number = no_index;
    };

    const Asset& asset_;
    const Part& part_;
    std::vector<CachedUv> uv_line_;
    std::vector<Index> position_line_, normal_line_;  // line numbers by vertex; no_index: not assigned yet
    UniqueValues<PositionLine> positions_;
    UniqueValues<Vec2f> uvs_;
    UniqueValues<Vec3f> normals_;
};

void append_corner(std::string& text, const std::array<std::uint64_t, 3>& numbers) {
    text += ' ';
    append_number(text, numbers[0]);
    if (numbers[1] || numbers[2]) text += '/';
    if (numbers[1]) append_number(text, numbers[1]);
    if (!numbers[2]) return;
    text += '/';
    append_number(text, numbers[2]);
}

/// An object of the file: a name and its first face.
struct ObjObject {
    std::string name;
    std::size_t first_face = 0;
};

/// The instances as objects with unique names, which readers join otherwise; those without faces are left out with a
/// warning.
std::vector<ObjObject> objects_of(const Asset& asset, const std::vector<Instance>& all,
                                  const std::string& stem, std::vector<std::string>& losses) {
    std::vector<ObjObject> objects;
    UniqueNames unique;
    std::size_t faces = 0, empty = 0;
    for (const Instance& instance : all) {
        const Part& part = asset.parts[instance.part];
        if (part.triangles.empty() && all.size() > 1) {
            ++empty;
            continue;
        }
        objects.push_back({unique(sanitized_name(part.name, stem)), faces});
        faces += part.triangles.size();
    }
    add_counted(losses, empty, "object", " without faces left out");
    return objects;
}

std::string faces_text(const Part& part, VertexLines& lines, const std::vector<Index>& used,
                       const MtlWriter& library, const std::vector<ObjObject>& objects) {
    std::string text;
    text.reserve(40 * part.triangles.size());  // as long as most files need, since growing copies the text
    std::optional<Index> current;
    Index group = no_index;
    auto next = objects.begin();
    for (std::size_t f = 0; f < part.triangles.size(); ++f) {
        if (objects.size() > 1 && next != objects.end() && next->first_face == f)
            text += "o " + next++->name + "\n";
        if (!part.face_group.empty() && part.face_group[f] != group) {
            group = part.face_group[f];
            text += "g " +
                    (group == no_index ? std::string(default_group_name)
                                       : sanitized_name(part.group_names[group], default_group_name)) +
                    "\n";
        }
        const Index material = part.face_material[f];
        if (!used.empty() && material != current) {
            const auto number = std::ranges::find(used, material) - used.begin();
            text += "usemtl " + library.names[static_cast<std::size_t>(number)] + "\n";
        }
        current = material;
        text += 'f';
        for (const Index v : part.triangles[f]) append_corner(text, lines.corner(v, material));
        text += '\n';
    }
    return text;
}

}  // namespace

EncodedModel encode_obj(const Asset& asset, const std::filesystem::path& file) {
    EncodedModel model;
    std::vector<std::string>& losses = model.losses;
    losses = flattening_losses(asset, "OBJ");
    const std::optional<DividedAsset> divided = divided_into_objects(asset);
    const Asset& parts = divided ? divided->asset : asset;
    const std::vector<Instance> all = instances(parts);
    const Part flat = flatten_for_file(parts);
    const std::string stem = file.stem().string();
    const std::vector<Index> used = used_materials(flat);
    MtlWriter library = make_mtl(asset, used, stem, losses);
    if (std::ranges::any_of(flat.colors, [](const Vec4f& c) { return c[3] != 1; }))
        losses.push_back("OBJ cannot hold the alpha of vertex colours");

    VertexLines lines(asset, flat);
    const std::vector<ObjObject> objects = objects_of(parts, all, stem, losses);
    const std::string faces = faces_text(flat, lines, used, library, objects);
    for (Index v = 0; v < flat.positions.size(); ++v) lines.position(v);
    std::string text;
    text.reserve(2 * faces.size() + faces.size() / 2);  // the vertices take about as much as the faces
    if (!used.empty()) text += "mtllib " + library_file_name(stem) + "\n";
    if (objects.size() < 2) text += "o " + (objects.empty() ? stem : objects[0].name) + "\n";
    lines.write(text);
    if (asset.smoothing != Smoothing::unknown && flat.normals.empty())
        text += asset.smoothing == Smoothing::on ? "s 1\n" : "s off\n";
    text += faces;

    model.files = std::move(library.images);
    if (!used.empty()) model.files.push_back(encoded_file(library_file_name(stem), std::move(library.text)));
    model.files.push_back(encoded_file(file.filename().string(), std::move(text)));
    return model;
}

}  // namespace faqem::detail

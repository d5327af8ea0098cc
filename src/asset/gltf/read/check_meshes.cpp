#include <string_view>

#include "asset/gltf/accessor.hpp"
#include "asset/gltf/read/checker.hpp"
#include "asset/gltf/read/compressed.hpp"
#include "asset/scene/material_textures.hpp"

namespace faqem::detail {
namespace {

constexpr std::uint64_t max_uv_set = 255;

/// The accessor type that an attribute must have; empty for COLOR_n and application-specific attributes.
std::string_view required_type(std::string_view attribute) {
    if (attribute == "POSITION" || attribute == "NORMAL") return "VEC3";
    if (attribute == "TANGENT" || attribute.starts_with("JOINTS_") || attribute.starts_with("WEIGHTS_"))
        return "VEC4";
    if (attribute.starts_with("TEXCOORD_")) return "VEC2";
    return "";
}

void check_attribute_format(const GltfChecker& checker, const std::string& where, const std::string& name,
                            const Json& accessor, bool in_target) {
    const std::string type = string_member(accessor, "type");
    const std::string_view wanted = in_target && name == "TANGENT" ? "VEC3" : required_type(name);
    if (!wanted.empty() && type != wanted)
        checker.fail(where, "is a " + type + ", " + name + " must be a " + std::string(wanted));
    if (name.starts_with("COLOR_") && type != "VEC3" && type != "VEC4")
        checker.fail(where, "is a " + type + ", " + name + " must be a VEC3 or VEC4");
    const NumberType component = component_type(accessor);
    const bool is_joints = name.starts_with("JOINTS_");
    if (is_joints && component != NumberType::u8 && component != NumberType::u16)
        checker.fail(where, "joints must be unsigned bytes or shorts");
    if (!is_joints && name[0] != '_' && component == NumberType::u32)
        checker.fail(where, name + " cannot be 32-bit integers");
}

/// Checks the accessors of a primitive or morph target.
/// \param count  number of elements that the accessors must have; 0: not known yet
/// \return their common number of elements; `count` if there are no attributes
std::uint64_t check_attributes(const GltfChecker& checker, const Json& attributes, const std::string& where,
                               std::uint64_t count, bool in_target) {
    for (const auto& [name, value] : attributes.items()) {
        const std::string at = child_path(where, name);
        const std::uint64_t accessor = checker.checked_index(value, at, "accessors");
        const Json& accessor_json = member(checker.document, "accessors")[accessor];
        const std::uint64_t elements = unsigned_member(accessor_json, "count", 0);
        if (name.empty()) checker.fail(at, "has no name");
        if (count != 0 && elements != count)
            checker.fail(at, "has " + std::to_string(elements) +
                                 " elements, other attributes of the primitive " + std::to_string(count));
        count = elements;
        check_attribute_format(checker, at, name, accessor_json, in_target);
    }
    return count;
}

void check_indices(const GltfChecker& checker, const Json& primitive, const std::string& where) {
    const auto indices = checker.reference(primitive, where, "indices", "accessors");
    if (!indices) return;
    const Json& accessor = member(checker.document, "accessors")[*indices];
    if (string_member(accessor, "type") != "SCALAR" || !is_index_type(component_type(accessor)) ||
        member(accessor, "normalized") == true)
        checker.fail(child_path(where, "indices"), "must be unsigned integers");
}

void check_variants(const GltfChecker& checker, const Json& primitive, const std::string& where) {
    const Json& variants = member(primitive, "extensions", "KHR_materials_variants");
    const std::string at = where + "/extensions/KHR_materials_variants";
    checker.for_each(variants, at, "mappings", [&](const Json& mapping, const std::string& path) {
        checker.required_reference(mapping, path, "material", "materials");
    });
}

void check_primitive(const GltfChecker& checker, const Json& primitive, const std::string& where) {
    if (!primitive.is_object()) checker.fail(where, "is not an object");
    if (checker.number(primitive, where, "mode").value_or(triangle_list) > triangle_fan)
        checker.fail(child_path(where, "mode"), "is not a primitive mode of glTF 2.0");
    checker.reference(primitive, where, "material", "materials");
    checker.object(primitive, where, "extensions");
    const Json& attributes = checker.object(primitive, where, "attributes");
    if (attributes.is_null()) checker.fail(where, "has no attributes");
    const std::uint64_t count =
        check_attributes(checker, attributes, child_path(where, "attributes"), 0, false);
    check_indices(checker, primitive, where);
    checker.for_each(primitive, where, "targets", [&](const Json& target, const std::string& at) {
        if (!target.is_object()) checker.fail(at, "is not an object");
        check_attributes(checker, target, at, count, true);
    });
    check_variants(checker, primitive, where);

    // If Draco is optional, the accessors may have uncompressed data too.
    if (needs_draco(checker.document, primitive)) check_draco(checker, primitive, where);
}

void check_texture_info(const GltfChecker& checker, const Json& info, const std::string& where) {
    if (!info.is_object()) checker.fail(where, "is not an object");
    checker.required_reference(info, where, "index", "textures");
    const Json& transform = member(checker.object(info, where, "extensions"), "KHR_texture_transform");
    const std::string at = where + "/extensions/KHR_texture_transform";
    checker.check_number_array(transform, at, "offset", 2);
    checker.check_number_array(transform, at, "scale", 2);
    for (const Json* holder : {&info, &transform})
        if (checker.number(*holder, where, "texCoord").value_or(0) > max_uv_set)
            checker.fail(child_path(where, "texCoord"), "is larger than " + std::to_string(max_uv_set));
}

void check_material(const GltfChecker& checker, const Json& material, const std::string& where) {
    checker.check_levels(material, where, "materials");
    const Json& pbr = checker.object(material, where, "pbrMetallicRoughness");
    checker.check_number_array(pbr, where + "/pbrMetallicRoughness", "baseColorFactor", 4);
    checker.check_number_array(material, where, "emissiveFactor", 3);
    for (const Json* holder : {&material, &pbr}) {
        const std::string at = holder == &pbr ? where + "/pbrMetallicRoughness" : where;
        for (const auto& [key, value] : holder->items())
            if (find_core_slot(key) || is_texture_info(key, value))
                check_texture_info(checker, value, child_path(at, key));
    }
    for (const auto& [name, extension] : checker.object(material, where, "extensions").items())
        for (const auto& [key, value] : extension.items())
            if (is_texture_info(key, value))
                check_texture_info(checker, value, where + "/extensions/" + name + "/" + key);
}

void check_texture(const GltfChecker& checker, const Json& texture, const std::string& where) {
    checker.reference(texture, where, "sampler", "samplers");
    checker.reference(texture, where, "source", "images");
    for (const auto& [name, extension] : checker.object(texture, where, "extensions").items())
        checker.reference(extension, where + "/extensions/" + name, "source", "images");
}

void check_image(const GltfChecker& checker, const Json& image, const std::string& where) {
    const Json& uri = member(image, "uri");
    if (!uri.is_null() && !uri.is_string()) checker.fail(child_path(where, "uri"), "is not a string");
    const auto view = checker.reference(image, where, "bufferView", "bufferViews");
    if (view.has_value() == uri.is_string()) checker.fail(where, "must have either a uri or a bufferView");
    if (!view) return;
    const Json& range = member(checker.document, "bufferViews")[*view];
    if (has_fallback_buffer(checker.document, range)) checker.fail(where, "refers to a buffer without data");
    if (unsigned_member(range, "byteLength", 0) > max_image_bytes)
        checker.fail_unsupported(where, "images of 2 GiB or more are not supported");
}

}  // namespace

void check_meshes_and_materials(const GltfChecker& checker) {
    checker.for_each_object("images", check_image);
    checker.for_each_object("textures", check_texture);
    checker.for_each_object("materials", check_material);
    checker.for_each(checker.document, "", "meshes", [&](const Json& mesh, const std::string& where) {
        checker.for_each(mesh, where, "primitives", [&](const Json& primitive, const std::string& at) {
            check_primitive(checker, primitive, at);
        });
    });
}

}  // namespace faqem::detail

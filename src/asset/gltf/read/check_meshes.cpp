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

/// \param attribute  index of the accessor
void check_attribute_format(const CheckedJson& attribute, const std::string& name, const Json& accessor,
                            bool in_target) {
    const std::string type = string_member(accessor, "type");
    const std::string_view wanted = in_target && name == "TANGENT" ? "VEC3" : required_type(name);
    if (!wanted.empty() && type != wanted)
        attribute.fail("is a " + type + ", " + name + " must be a " + std::string(wanted));
    if (name.starts_with("COLOR_") && type != "VEC3" && type != "VEC4")
        attribute.fail("is a " + type + ", " + name + " must be a VEC3 or VEC4");
    const NumberType component = component_type(accessor);
    const bool is_joints = name.starts_with("JOINTS_");
    if (is_joints && component != NumberType::u8 && component != NumberType::u16)
        attribute.fail("joints must be unsigned bytes or shorts");
    if (!is_joints && name[0] != '_' && component == NumberType::u32)
        attribute.fail(name + " cannot be 32-bit integers");
}

/// Checks the accessors of a primitive or morph target.
/// \param count  number of elements that the accessors must have; 0: not known yet
/// \return their common number of elements; `count` if there are no attributes
std::uint64_t check_attributes(const CheckedJson& attributes, std::uint64_t count, bool in_target) {
    attributes.members([&](const std::string& name, const CheckedJson& attribute) {
        const Json& accessor = attribute.element("accessors", attribute.index("accessors"));
        const std::uint64_t elements = unsigned_member(accessor, "count", 0);
        if (name.empty()) attribute.fail("has no name");
        if (count != 0 && elements != count)
            attribute.fail("has " + std::to_string(elements) +
                           " elements, other attributes of the primitive " + std::to_string(count));
        count = elements;
        check_attribute_format(attribute, name, accessor, in_target);
    });
    return count;
}

void check_indices(const CheckedJson& primitive) {
    const auto indices = primitive.reference("indices", "accessors");
    if (!indices) return;
    const Json& accessor = primitive.element("accessors", *indices);
    if (string_member(accessor, "type") != "SCALAR" || !is_index_type(component_type(accessor)) ||
        member(accessor, "normalized") == true)
        primitive.fail_at("indices", "must be unsigned integers");
}

void check_primitive(const CheckedJson& primitive) {
    if (!primitive.json.is_object()) primitive.fail("is not an object");
    if (primitive.number("mode").value_or(triangle_list) > triangle_fan)
        primitive.fail_at("mode", "is not a primitive mode of glTF 2.0");
    primitive.reference("material", "materials");
    const CheckedJson extensions = primitive.object("extensions");
    const std::uint64_t count = check_attributes(primitive.required_object("attributes"), 0, false);
    check_indices(primitive);
    primitive.for_each("targets", [&](const CheckedJson& target) {
        if (!target.json.is_object()) target.fail("is not an object");
        check_attributes(target, count, true);
    });
    extensions.member("KHR_materials_variants").for_each("mappings", [](const CheckedJson& mapping) {
        mapping.required_reference("material", "materials");
    });
    // If Draco is optional, the accessors may have uncompressed data too.
    if (needs_draco(primitive.document, primitive.json)) check_draco(primitive);
}

void check_texture_info(const CheckedJson& info) {
    if (!info.json.is_object()) info.fail("is not an object");
    info.required_reference("index", "textures");
    const CheckedJson transform = info.object("extensions").member("KHR_texture_transform");
    transform.check_number_array("offset", 2);
    transform.check_number_array("scale", 2);
    for (const CheckedJson* holder : {&info, &transform})
        if (holder->number("texCoord").value_or(0) > max_uv_set)
            holder->fail_at("texCoord", "is larger than " + std::to_string(max_uv_set));
}

void check_material(const CheckedJson& material) {
    material.check_levels("materials");
    const CheckedJson pbr = material.object("pbrMetallicRoughness");
    pbr.check_number_array("baseColorFactor", 4);
    material.check_number_array("emissiveFactor", 3);
    for (const CheckedJson* holder : {&material, &pbr})
        holder->members([](const std::string& key, const CheckedJson& value) {
            if (find_core_slot(key) || is_texture_info(key, value.json)) check_texture_info(value);
        });
    material.object("extensions").members([](const std::string&, const CheckedJson& extension) {
        extension.members([](const std::string& key, const CheckedJson& value) {
            if (is_texture_info(key, value.json)) check_texture_info(value);
        });
    });
}

void check_texture(const CheckedJson& texture) {
    texture.reference("sampler", "samplers");
    texture.reference("source", "images");
    texture.object("extensions").members([](const std::string&, const CheckedJson& extension) {
        extension.reference("source", "images");
    });
}

void check_image(const CheckedJson& image) {
    const Json& uri = image.string("uri");
    const auto view = image.reference("bufferView", "bufferViews");
    if (view.has_value() == uri.is_string()) image.fail("must have either a uri or a bufferView");
    if (!view) return;
    const Json& range = image.element("bufferViews", *view);
    if (has_fallback_buffer(image.document, range)) image.fail("refers to a buffer without data");
    if (unsigned_member(range, "byteLength", 0) > max_image_bytes)
        image.fail_unsupported("images of 2 GiB or more are not supported");
}

}  // namespace

void check_meshes_and_materials(const CheckedJson& document) {
    document.for_each("images", check_image);
    document.for_each("textures", check_texture);
    document.for_each("materials", check_material);
    document.for_each("meshes",
                      [](const CheckedJson& mesh) { mesh.for_each("primitives", check_primitive); });
}

}  // namespace faqem::detail

#include "asset/gltf/unused_objects.hpp"

#include <algorithm>
#include <cstdint>
#include <vector>

#include "asset/gltf/source_document.hpp"
#include "asset/scene/material_textures.hpp"
#include "asset/scene/messages.hpp"

namespace faqem::detail {
namespace {

/// Marks what the meshes of a document use.
class UseMarker {
public:
    explicit UseMarker(const Json& document)
        : document_(document),
          materials_(array_size(document, "materials"), 0),
          images_(array_size(document, "images"), 0) {
        for (const Json& mesh : member(document, "meshes"))
            for (const Json& primitive : member(mesh, "primitives")) mark_primitive(primitive);
        const Json& extensions = member(document, "extensions");
        mark_textures_in(member(extensions, "EXT_structural_metadata"));
        for (const Json& light : member(extensions, "EXT_lights_image_based", "lights"))
            for (const Json& mip : member(light, "specularImages"))
                for (const Json& image : mip) images_[image.get<Index>()] = 1;
    }

    std::uint64_t unused_materials() const { return count_unused(materials_); }
    std::uint64_t unused_images() const { return count_unused(images_); }

private:
    static std::uint64_t count_unused(const std::vector<std::uint8_t>& marks) {
        return static_cast<std::uint64_t>(std::ranges::count(marks, 0));
    }

    void mark_primitive(const Json& primitive) {
        mark_material(index_member(primitive, "material"));
        const Json& extensions = member(primitive, "extensions");
        for (const Json& mapping : member(extensions, "KHR_materials_variants", "mappings"))
            mark_material(index_member(mapping, "material"));
        mark_textures_in(extensions);
    }

    void mark_material(Index first) {
        std::vector<Index> open = {first};
        while (!open.empty()) {
            const Index material = open.back();
            open.pop_back();
            if (material == no_index || materials_[material]) continue;
            materials_[material] = 1;
            const Json& json = member(document_, "materials")[material];
            mark_textures_in(json);
            for (const Json& level : level_ids(json)) open.push_back(level.get<Index>());
        }
    }

    /// Marks the images of all texture infos in a value: objects with an index, whatever extension they belong to. The
    /// recursion is limited by max_json_depth.
    void mark_textures_in(const Json& value) {
        if (!value.is_structured()) return;
        const Json& index = member(value, "index");
        if (index.is_number_integer()) mark_texture(index.get<std::uint64_t>());
        for (auto child = value.begin(); child != value.end(); ++child)
            if (!value.is_object() || child.key() != "extras") mark_textures_in(*child);
    }

    void mark_texture(std::uint64_t index) {
        if (index >= array_size(document_, "textures")) return;
        const Json& texture = member(document_, "textures")[index];
        mark_image(index_member(texture, "source"));
        const Json& extensions = member(texture, "extensions");
        for (const Json& extension : extensions) mark_image(index_member(extension, "source"));
    }

    void mark_image(Index image) {
        if (image != no_index) images_[image] = 1;
    }

    const Json& document_;
    std::vector<std::uint8_t> materials_, images_;
};

}  // namespace

bool names_by_number(std::string_view extension) {
    return extension == "VRM" || extension.starts_with("VRMC_");
}

bool names_objects_by_number(const Json& document) {
    for (const Json& name : member(document, "extensionsUsed"))
        if (names_by_number(name.get<std::string>())) return true;
    for (const auto& [name, extension] : member(document, "extensions").items())
        if (names_by_number(name)) return true;
    return false;
}

bool names_objects_by_number(const Asset& asset) {
    return asset.source && names_objects_by_number(asset.source->document);
}

std::string unused_objects(const Json& document) {
    if (names_objects_by_number(document)) return {};
    const UseMarker marker(document);
    const std::uint64_t materials = marker.unused_materials(), images = marker.unused_images();
    if (materials == 0 && images == 0) return {};
    std::string text;
    if (materials > 0) text = pluralized(materials, "material");
    if (materials > 0 && images > 0) text += " and ";
    if (images > 0) text += pluralized(images, "image");
    return text + " that no mesh uses";
}

}  // namespace faqem::detail

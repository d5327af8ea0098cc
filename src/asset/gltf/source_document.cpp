#include "asset/gltf/source_document.hpp"

#include <algorithm>
#include <set>

#include "asset/gltf/accessor.hpp"
#include "asset/gltf/scene.hpp"
#include "asset/scene/material_textures.hpp"
#include "asset/scene/messages.hpp"
#include "asset/scene/part_arrays.hpp"
#include "asset/scene/source_traits.hpp"

namespace faqem::detail {
namespace {

/// The primitives of the mesh of a part, or null.
const Json& primitives_of(const Asset& asset, const Part& part) {
    static const Json none;
    const Json& meshes = member(source_document(asset).document, "meshes");
    return part.source < meshes.size() ? member(meshes[part.source], "primitives") : none;
}

/// Marks what the meshes of a document use.
class UseMarker {
public:
    explicit UseMarker(const Json& document)
        : document_(document),
          materials_(array_size(document, "materials"), 0),
          images_(array_size(document, "images"), 0) {
        for_each_material(document, [&](Index material) { mark_material(material); });
        for (const Json& mesh : member(document, "meshes"))
            for (const Json& primitive : member(mesh, "primitives"))
                mark_textures_in(member(primitive, "extensions"));
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

    void mark_material(Index first) {
        mark_reachable(first, materials_, [&](Index material) -> const Json& {
            const Json& json = member(document_, "materials")[material];
            mark_textures_in(json);
            return level_ids(json);
        });
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
        for (const Json& extension : member(texture, "extensions"))
            mark_image(index_member(extension, "source"));
    }

    void mark_image(Index image) {
        if (image != no_index) images_[image] = 1;
    }

    const Json& document_;
    std::vector<std::uint8_t> materials_, images_;
};

// What the views of a document store, by index. A view of several accessors has several contents.
class ViewContents {
public:
    explicit ViewContents(const Json& document)
        : document_(document), contents_(array_size(document, "bufferViews")) {
        for (const Json& mesh : member(document, "meshes"))
            for (const Json& primitive : member(mesh, "primitives")) add_primitive(primitive);
        for (const Json& skin : member(document, "skins"))
            add(skin, "inverseBindMatrices", "inverse bind matrices");
        for (const Json& animation : member(document, "animations"))
            for (const Json& sampler : member(animation, "samplers"))
                for (const char* key : {"input", "output"}) add(sampler, key, "animation");
        for (const Json& node : member(document, "nodes"))
            add_all(member(node, "extensions", instancing_name, "attributes"), "instance ");
        for (const Json& image : member(document, "images"))
            is_image_.insert(index_member(image, "bufferView"));
    }

    bool is_image(Index view) const { return is_image_.contains(view); }

    std::string operator()(Index view) const {
        std::string result;
        for (const std::string& content : contents_[view]) result += (result.empty() ? "" : ", ") + content;
        return result.empty() ? "other" : result;
    }

private:
    void add_primitive(const Json& primitive) {
        add(primitive, "indices", "indices");
        add_all(member(primitive, "attributes"), "");
        for (const Json& target : member(primitive, "targets")) add_all(target, "target ");
    }

    void add_all(const Json& attributes, const std::string& prefix) {
        for (auto it = attributes.begin(); it != attributes.end(); ++it)
            add(attributes, it.key().c_str(), prefix + it.key());
    }

    void add(const Json& owner, const char* key, const std::string& content) {
        const Index accessor = index_member(owner, key);
        if (accessor == no_index) return;
        const Index view = index_member(member(document_, "accessors")[accessor], "bufferView");
        if (view != no_index) contents_[view].insert(content);
    }

    const Json& document_;
    std::vector<std::set<std::string>> contents_;
    std::set<Index> is_image_;
};

std::uint64_t stored_bytes(const Json& view) {
    const Json& compressed = member(view, "extensions", meshopt_name);
    return unsigned_member(compressed.is_object() ? compressed : view, "byteLength", 0);
}

}  // namespace

bool is_dynamic(const Asset& asset) {
    return !member(source_document(asset).document, "animations").empty() ||
           some_part_has(asset, &Part::joints) || some_part_has(asset, &Part::morph_targets);
}

std::vector<Index> variant_materials(const Asset& asset, const Part& part) {
    std::set<Index> result;
    for (const Json& primitive : primitives_of(asset, part)) {
        for (const Json& mapping : member(primitive, "extensions", variants_name, "mappings")) {
            const Index wanted = index_member(mapping, "material");
            for (Index m = 0; m < asset.materials.size(); ++m)
                if (wanted != no_index && asset.materials[m].source == wanted && !asset.materials[m].rebaked)
                    result.insert(m);
        }
    }
    return {result.begin(), result.end()};
}

std::vector<std::uint8_t> materials_with_moving_textures(const Asset& asset) {
    std::vector<std::uint8_t> result(asset.materials.size(), 0);
    for (const Json& animation : member(source_document(asset).document, "animations")) {
        for (const Json& channel : member(animation, "channels")) {
            const std::string pointer = animated_pointer(channel);
            if (pointer.find("/KHR_texture_transform/") == std::string::npos) continue;
            for (std::size_t m = 0; m < result.size(); ++m) {
                const Index source = asset.materials[m].source;
                if (source != no_index && pointer.starts_with(child_path("/materials", source) + "/"))
                    result[m] = 1;
            }
        }
    }
    return result;
}

std::vector<std::uint8_t> parts_that_need_uvs(const Asset& asset) {
    const std::vector<std::uint8_t> moving = materials_with_moving_textures(asset);
    std::vector<std::uint8_t> result;
    for (const Part& part : asset.parts) {
        const bool moves =
            std::ranges::any_of(part.face_material, [&](Index m) { return m != no_index && moving[m]; });
        result.push_back(moves || !variant_materials(asset, part).empty());
    }
    return result;
}

MotionSteps motion_steps(const Asset& asset, const Part& part) {
    MotionSteps steps{0, std::vector<double>(part.morph_targets.size(), 0)};
    const auto step = [&](const Json& attributes, const char* name) {
        const Index accessor = index_member(attributes, name);
        return accessor == no_index ? 0 : integer_step(asset.source->document["accessors"][accessor]);
    };
    for (const Json& primitive : primitives_of(asset, part)) {
        steps.weight = std::max(steps.weight, step(member(primitive, "attributes"), "WEIGHTS_0"));
        const Json& targets = member(primitive, "targets");
        for (std::size_t t = 0; t < targets.size() && t < steps.shift.size(); ++t)
            steps.shift[t] = std::max(steps.shift[t], step(targets[t], "POSITION"));
    }
    return steps;
}

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
    return names_objects_by_number(source_document(asset).document);
}

void carry_materials(const Asset& from, Asset& to) {
    if (!from.source) return;
    const auto joined = std::make_shared<SourceDocument>(source_document(to));
    const auto first = static_cast<Index>(joined->materials.size());
    for (const Json& material : member(from.source->document, "materials"))
        joined->document["materials"].push_back(material);
    for (const Material& material : from.source->materials) {
        joined->materials.push_back(material);
        remove_textures(joined->materials.back());  // their images are not in the document
    }
    for (Material& material : to.materials)
        if (material.source != no_index) material.source += first;
    to.source = joined;
}

std::string unused_objects(const Json& document) {
    if (names_objects_by_number(document)) return {};
    const UseMarker marker(document);
    std::vector<std::string> counts;
    add_counted(counts, marker.unused_materials(), "material", "");
    add_counted(counts, marker.unused_images(), "image", "");
    if (counts.empty()) return {};
    return counts.front() + (counts.size() > 1 ? " and " + counts.back() : "") + " that no mesh uses";
}

std::vector<ResultView> buffer_views(const Json& document) {
    const ViewContents contents(document);
    std::vector<ResultView> result;
    const Json& views = member(document, "bufferViews");
    for (Index i = 0; i < views.size(); ++i)
        if (!contents.is_image(i)) result.push_back({contents(i), stored_bytes(views[i])});
    return result;
}

}  // namespace faqem::detail

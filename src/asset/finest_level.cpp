#include "asset/finest_level.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "asset/gltf/read/checker.hpp"
#include "asset/gltf/scene.hpp"
#include "asset/gltf/source_document.hpp"
#include "asset/scene/material_textures.hpp"
#include "asset/scene/messages.hpp"

namespace faqem::detail {
namespace {

using Marks = std::vector<std::uint8_t>;  // one for each element of an array of the document

/// Members of a node that place its children.
constexpr std::array<const char*, 7> placing_members = {"name",        "extras",   "children", "matrix",
                                                        "translation", "rotation", "scale"};

bool has_levels(const Json& object) { return member(object, "extensions").contains(lod_name); }

void erase_levels(Json& object) {
    if (erase_extension(object, lod_name)) erase_from(object, "extras", coverage_name);
}

/// The coarser levels of nodes or materials.
struct CoarserLevels {
    Marks marks;                // by object: it is a coarser level of another one
    std::uint64_t objects = 0;  // number of objects that have coarser levels
    std::uint64_t levels = 0;   // number of coarser levels

    std::string message(const std::string& noun) const {
        return pluralized(levels, "coarser level") + " of " + pluralized(objects, noun);
    }
};

/// Levels may have levels of their own. No object is a level of itself or of one that it contains.
/// \param parents  by object: the one that contains it, or no_index
CoarserLevels coarser_levels(const Json& objects, const std::vector<Index>& parents) {
    CoarserLevels result;
    result.marks.assign(objects.size(), 0);
    for (Index finest = 0; finest < objects.size(); ++finest) {
        if (result.marks[finest] || !has_levels(objects[finest])) continue;
        const auto contains_finest = [&](Index level) {
            Index at = finest;
            while (at != no_index && at != level) at = parents[at];
            return at == level;
        };
        std::vector<Index> found = {finest};
        for (std::size_t k = 0; k < found.size(); ++k) {
            for (const Json& id : level_ids(objects[found[k]])) {
                const Index level = id.get<Index>();
                if (result.marks[level] || contains_finest(level)) continue;
                result.marks[level] = 1;
                found.push_back(level);
            }
        }
        result.objects += found.size() > 1 ? 1 : 0;
        result.levels += found.size() - 1;
    }
    return result;
}

/// Removes nodes, and what refers to them, from a document.
class NodeRemover {
public:
    /// \param levels  the nodes that are removed, with their descendants
    /// \param keeps_numbers  whether nodes and skins keep their indices, so that empty nodes stay
    NodeRemover(Json& document, const Marks& levels, bool keeps_numbers)
        : document_(document), keeps_numbers_(keeps_numbers), removed_(levels.size(), 0) {
        const auto children = [&](Index n) -> const Json& { return member(node(n), "children"); };
        for (Index n = 0; n < levels.size(); ++n)
            if (levels[n]) mark_reachable(n, removed_, children);
    }

    /// \return by mesh: whether only removed nodes had it
    Marks operator()() {
        const Marks skins = used_by_removed_only("skins", "skin");
        const Marks meshes = used_by_removed_only("meshes", "mesh");
        const Marks needed = needed_nodes(skins);
        for (Index n = 0; n < removed_.size(); ++n) {
            if (!removed_[n] || !needed[n]) continue;
            removed_[n] = 0;
            strip(document_["nodes"][n]);
        }
        number_nodes();
        if (!keeps_numbers_) remove_skins(skins);
        filter_channels(document_, [&](const Json&, Json& channel) { return update_channel(channel); });
        for (Json& scene : elements(document_, "scenes")) update_list(scene, "nodes");
        update_nodes();
        return meshes;
    }

private:
    const Json& node(Index n) const { return member(document_, "nodes")[n]; }

    /// By element of a top-level array: whether nodes refer to it under `key`, but only removed ones.
    Marks used_by_removed_only(const char* array, const char* key) const {
        Marks by_removed(array_size(document_, array), 0), by_remaining = by_removed;
        for (Index n = 0; n < removed_.size(); ++n) {
            const Index used = index_member(node(n), key);
            if (used != no_index) (removed_[n] ? by_removed : by_remaining)[used] = 1;
        }
        for (std::size_t i = 0; i < by_removed.size(); ++i)
            if (by_remaining[i]) by_removed[i] = 0;
        return by_removed;
    }

    /// The joints of the skins that stay, with their ancestors.
    Marks needed_nodes(const Marks& removed_skins) const {
        const std::vector<Index> parent = parents_of(member(document_, "nodes"));
        Marks needed(removed_.size(), 0);
        for (std::size_t s = 0; s < removed_skins.size(); ++s)
            if (!removed_skins[s])
                for (const Json& joint : member(document_["skins"][s], "joints"))
                    for (Index n = joint.get<Index>(); n != no_index && !needed[n]; n = parent[n])
                        needed[n] = 1;
        return needed;
    }

    static void strip(Json& stripped) {
        Json placing = Json::object();
        for (const char* key : placing_members)
            if (stripped.contains(key)) placing[key] = stripped[key];
        stripped = std::move(placing);
    }

    void number_nodes() {
        Index next = 0;
        for (Index n = 0; n < removed_.size(); ++n)
            number_.push_back(removed_[n] ? no_index : keeps_numbers_ ? n : next++);
    }

    /// Renumbers the nodes in a list, which is erased if none is left.
    void update_list(Json& holder, const char* key) const {
        if (!holder.contains(key)) return;
        Json remaining = Json::array();
        for (const Json& n : holder[key])
            if (number_[n.get<Index>()] != no_index) remaining.push_back(number_[n.get<Index>()]);
        if (remaining.empty() && !holder[key].empty())
            holder.erase(key);
        else
            holder[key] = std::move(remaining);
    }

    void remove_skins(const Marks& removed) {
        if (!document_.contains("skins")) return;
        Json remaining = Json::array();
        std::vector<Index> number(removed.size(), no_index);
        for (std::size_t s = 0; s < removed.size(); ++s) {
            if (removed[s]) continue;
            Json& skin = document_["skins"][s];
            update_list(skin, "joints");
            const Index skeleton = index_member(skin, "skeleton");
            if (skeleton != no_index && number_[skeleton] == no_index) skin.erase("skeleton");
            if (skin.contains("skeleton")) skin["skeleton"] = number_[skeleton];
            number[s] = static_cast<Index>(remaining.size());
            remaining.push_back(std::move(skin));
        }
        for (Index n = 0; n < removed_.size(); ++n)
            if (!removed_[n] && node(n).contains("skin"))
                document_["nodes"][n]["skin"] = number[index_member(node(n), "skin")];
        set_or_erase(document_, "skins", std::move(remaining));
    }

    /// Returns whether the target of a channel stays.
    bool update_channel(Json& channel) const {
        Json& target = channel["target"];
        const Index node = index_member(target, "node");
        if (node != no_index && number_[node] == no_index) return false;
        if (node != no_index) target["node"] = number_[node];
        std::string pointer = animated_pointer(channel);
        const Index pointed = pointed_node(pointer);
        if (pointed >= number_.size()) return true;
        if (number_[pointed] == no_index) return false;
        pointer = "/nodes/" + std::to_string(number_[pointed]) + pointer.substr(pointer.find('/', 7));
        target["extensions"]["KHR_animation_pointer"]["pointer"] = std::move(pointer);
        return true;
    }

    void update_nodes() {
        Json nodes = Json::array();
        for (Index n = 0; n < removed_.size(); ++n) {
            if (removed_[n] && keeps_numbers_) nodes.push_back(Json::object());
            if (removed_[n]) continue;
            Json& remaining = document_["nodes"][n];
            update_list(remaining, "children");
            erase_levels(remaining);
            nodes.push_back(std::move(remaining));
        }
        document_["nodes"] = std::move(nodes);
    }

    Json& document_;
    const bool keeps_numbers_;
    Marks removed_;              // by node
    std::vector<Index> number_;  // new index by node; no_index if it is removed
};

/// Leaves out the nodes of coarser levels and the meshes that only these show.
void remove_level_nodes(Json& document, const Marks& levels, std::vector<Part>& parts) {
    const bool keeps_numbers = !unknown_extensions(document).empty();
    const Marks meshes = NodeRemover(document, levels, keeps_numbers)();
    for (std::size_t m = 0; m < meshes.size(); ++m)
        if (meshes[m]) document["meshes"][m] = nullptr;
    for (Part& part : parts) {
        if (part.source >= meshes.size() || !meshes[part.source]) continue;
        Part empty;
        empty.name = part.name;
        empty.source = part.source;
        part = std::move(empty);
    }
}

/// By material of a document: whether a primitive of a mesh, or a variant of one, has it.
Marks used_materials(const Json& document) {
    Marks used(array_size(document, "materials"), 0);
    for_each_material(document, [&](Index material) { used[material] = 1; });
    return used;
}

/// Leaves out materials, and the images that no other one has. The faces get the new indices.
void remove_materials(const Marks& removed_sources, Asset& asset) {
    std::vector<Material> materials;
    std::vector<Index> number;
    for (Material& material : asset.materials) {
        const bool is_removed = material.source < removed_sources.size() && removed_sources[material.source];
        number.push_back(is_removed ? no_index : static_cast<Index>(materials.size()));
        if (!is_removed) materials.push_back(std::move(material));
    }
    for (Part& part : asset.parts)
        for (Index& material : part.face_material)
            if (material != no_index) material = number[material];
    asset.materials = std::move(materials);
    asset.images = used_images(asset.materials, asset.images);
}

}  // namespace

std::optional<FinestLevel> finest_level(const Asset& asset) {
    const Json& document = source_document(asset).document;
    const Json &nodes = member(document, "nodes"), &materials = member(document, "materials");
    if (std::ranges::none_of(nodes, has_levels) && std::ranges::none_of(materials, has_levels))
        return std::nullopt;
    const CoarserLevels of_nodes = coarser_levels(nodes, parents_of(nodes));
    const CoarserLevels of_materials =
        coarser_levels(materials, std::vector<Index>(materials.size(), no_index));

    FinestLevel result{asset, {}};
    const auto source = std::make_shared<SourceDocument>(*asset.source);
    Marks left_out = used_materials(source->document);
    remove_level_nodes(source->document, of_nodes.marks, result.asset.parts);
    const Marks still_used = used_materials(source->document);
    for (std::size_t m = 0; m < left_out.size(); ++m)
        left_out[m] = (left_out[m] || of_materials.marks[m]) && !still_used[m];
    remove_materials(left_out, result.asset);
    for (Json& material : elements(source->document, "materials")) erase_levels(material);
    for (std::vector<Material>* all : {&source->materials, &result.asset.materials})
        for (Material& material : *all) std::erase(material.extensions, lod_name);
    result.asset.source = source;
    if (of_nodes.levels > 0) result.warning = of_nodes.message("node");
    if (of_materials.levels > 0)
        result.warning += (of_nodes.levels > 0 ? " and " : "") + of_materials.message("material");
    if (!result.warning.empty())
        result.warning += std::string(" (") + lod_name + ") left out: the finest one is simplified";
    return result;
}

}  // namespace faqem::detail

#include <algorithm>
#include <vector>

#include "asset/gltf/accessor.hpp"
#include "asset/gltf/read/checker.hpp"
#include "asset/gltf/scene.hpp"
#include "asset/scene/messages.hpp"

namespace faqem::detail {
namespace {

/// Checks the type of an attribute that places instances: three floats, or for rotations also four normalised integers.
void check_instance_attribute(const CheckedJson& attribute, const std::string& name, const Json& accessor) {
    const bool is_rotation = name == "ROTATION";
    if (!is_rotation && name != "TRANSLATION" && name != "SCALE") return;
    const NumberType type = component_type(accessor);
    const bool is_normalized = is_rotation && member(accessor, "normalized") == true &&
                               (type == NumberType::i8 || type == NumberType::i16);
    if (string_member(accessor, "type") != (is_rotation ? "VEC4" : "VEC3") ||
        !(type == NumberType::f32 || is_normalized))
        attribute.fail(is_rotation ? "is not a VEC4 of floats or of normalised signed bytes or shorts"
                                   : "is not a VEC3 of floats");
}

/// Returns the number of instances of the node's mesh, 1 without the extension.
std::uint64_t checked_instance_count(const CheckedJson& node) {
    std::uint64_t count = 0;
    const CheckedJson attributes = node.member("extensions").member(instancing_name).object("attributes");
    attributes.members([&](const std::string& name, const CheckedJson& attribute) {
        const Json& accessor = attribute.element("accessors", attribute.index("accessors"));
        const std::uint64_t own = unsigned_member(accessor, "count", 0);
        if (count != 0 && own != count)
            attribute.fail("has " + pluralized(own, "element") + ", another attribute has " +
                           std::to_string(count));
        count = own;
        check_instance_attribute(attribute, name, accessor);
    });
    return std::max<std::uint64_t>(count, 1);
}

void check_node(const CheckedJson& node) {
    node.reference("mesh", "meshes");
    node.reference("skin", "skins");
    node.reference("camera", "cameras");
    node.check_number_array("matrix", 16);
    node.check_number_array("translation", 3);
    node.check_number_array("rotation", 4);
    node.check_number_array("scale", 3);
    node.array("weights");
    node.check_levels("nodes");
}

void check_instance_counts(const CheckedJson& document) {
    std::uint64_t instances = 0;
    document.for_each("nodes", [&](const CheckedJson& node) {
        const std::uint64_t own = checked_instance_count(node);
        if (own > 1 && own > max_instances - std::min(instances, max_instances))
            node.fail_unsupported("the file has more than " + std::to_string(max_instances) + " instances");
        instances += own;
    });
}

/// Parent of each node; the number of nodes if it has none.
std::vector<std::uint64_t> checked_parents(const CheckedJson& nodes) {
    const std::uint64_t count = nodes.json.size();
    std::vector<std::uint64_t> parents(count, count);
    for (std::uint64_t i = 0; i < count; ++i) {
        const CheckedJson node = nodes.at(i);
        node.for_each("children", [&](const CheckedJson& value) {
            const std::uint64_t child = value.index("nodes");
            if (parents[child] != count)
                nodes.at(child).fail("has two parents: " + nodes.at(parents[child]).where + " and " +
                                     node.where);
            parents[child] = i;
        });
    }
    return parents;
}

/// Checks that there are no cycles. Since each node has at most one parent, the path from a node to its
/// ancestors ends at a root or returns to a visited node. O(nodes)
void check_no_cycle(const CheckedJson& nodes, const std::vector<std::uint64_t>& parents) {
    const std::uint64_t count = parents.size();
    constexpr std::uint64_t unvisited = 0;
    std::vector<std::uint64_t> visited_by(count, unvisited);
    for (std::uint64_t start = 0; start < count; ++start) {
        const std::uint64_t visit_mark = start + 1;
        for (std::uint64_t node = start; node != count && visited_by[node] == unvisited;
             node = parents[node]) {
            visited_by[node] = visit_mark;
            if (parents[node] != count && visited_by[parents[node]] == visit_mark)
                nodes.at(parents[node]).fail("is its own ancestor");
        }
    }
}

void check_scenes(const CheckedJson& document, const std::vector<std::uint64_t>& parents) {
    const CheckedJson scenes = document.member("scenes");
    std::vector<std::uint64_t> listed_in(parents.size(), scenes.json.size());
    document.reference("scene", "scenes");
    for (std::uint64_t i = 0; i < scenes.json.size(); ++i) {
        scenes.at(i).for_each("nodes", [&](const CheckedJson& value) {
            const std::uint64_t node = value.index("nodes");
            if (parents[node] != parents.size())
                value.fail("refers to /nodes/" + std::to_string(node) + ", which has a parent");
            if (listed_in[node] == i)
                value.fail("refers to /nodes/" + std::to_string(node) + " a second time");
            listed_in[node] = i;
        });
    }
}

void check_skin(const CheckedJson& skin) {
    skin.reference("skeleton", "nodes");
    skin.reference("inverseBindMatrices", "accessors");
    skin.for_each("joints", [](const CheckedJson& joint) { joint.index("nodes"); });
}

void check_animation(const CheckedJson& animation) {
    animation.for_each("samplers", [](const CheckedJson& sampler) {
        sampler.required_reference("input", "accessors");
        sampler.required_reference("output", "accessors");
    });
    const std::uint64_t samplers = array_size(animation.json, "samplers");
    animation.for_each("channels", [&](const CheckedJson& channel) {
        if (channel.required_number("sampler") >= samplers)
            channel.fail_at("sampler",
                            "is out of range: the animation has " + std::to_string(samplers) + " samplers");
        channel.required_object("target").reference("node", "nodes");
    });
}

}  // namespace

void check_scene(const CheckedJson& document) {
    const CheckedJson nodes = document.member("nodes");
    document.for_each("nodes", check_node);
    check_instance_counts(document);
    const std::vector<std::uint64_t> parents = checked_parents(nodes);
    check_no_cycle(nodes, parents);
    check_scenes(document, parents);
    document.for_each("skins", check_skin);
    document.for_each("animations", check_animation);
}

}  // namespace faqem::detail

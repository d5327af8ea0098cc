#include <algorithm>
#include <vector>

#include "asset/gltf/accessor.hpp"
#include "asset/gltf/read/checker.hpp"
#include "asset/gltf/scene.hpp"
#include "asset/scene/messages.hpp"

namespace faqem::detail {
namespace {

/// Checks the type of an attribute that places instances: three floats, or for rotations also four normalised integers.
void check_instance_attribute(const GltfChecker& checker, const std::string& name, const Json& accessor,
                              const std::string& where) {
    const bool is_rotation = name == "ROTATION";
    if (!is_rotation && name != "TRANSLATION" && name != "SCALE") return;
    const NumberType type = component_type(accessor);
    const bool is_normalized = is_rotation && member(accessor, "normalized") == true &&
                               (type == NumberType::i8 || type == NumberType::i16);
    if (string_member(accessor, "type") != (is_rotation ? "VEC4" : "VEC3") ||
        !(type == NumberType::f32 || is_normalized))
        checker.fail(where, is_rotation ? "is not a VEC4 of floats or of normalised signed bytes or shorts"
                                        : "is not a VEC3 of floats");
}

/// Returns the number of instances of the node's mesh, 1 without the extension.
std::uint64_t checked_instance_count(const GltfChecker& checker, const Json& node, const std::string& where) {
    const std::string at = where + "/extensions/" + instancing_name;
    const Json& instancing = member(node, "extensions", instancing_name);
    std::uint64_t count = 0;
    for (const auto& [name, reference] : checker.object(instancing, at, "attributes").items()) {
        const std::string path = at + "/attributes/" + name;
        const std::uint64_t index = checker.checked_index(reference, path, "accessors");
        const Json& accessor = member(checker.document, "accessors")[index];
        const std::uint64_t own = unsigned_member(accessor, "count", 0);
        if (count != 0 && own != count)
            checker.fail(path, "has " + pluralized(own, "element") + ", another attribute has " +
                                   std::to_string(count));
        count = own;
        check_instance_attribute(checker, name, accessor, path);
    }
    return std::max<std::uint64_t>(count, 1);
}

void check_node(const GltfChecker& checker, const Json& node, const std::string& where) {
    checker.reference(node, where, "mesh", "meshes");
    checker.reference(node, where, "skin", "skins");
    checker.reference(node, where, "camera", "cameras");
    checker.check_number_array(node, where, "matrix", 16);
    checker.check_number_array(node, where, "translation", 3);
    checker.check_number_array(node, where, "rotation", 4);
    checker.check_number_array(node, where, "scale", 3);
    checker.array(node, where, "weights");
    checker.object(node, where, "extensions");
    checker.check_levels(node, where, "nodes");
}

void check_instance_counts(const GltfChecker& checker) {
    std::uint64_t instances = 0;
    checker.for_each(checker.document, "", "nodes", [&](const Json& node, const std::string& where) {
        const std::uint64_t own = checked_instance_count(checker, node, where);
        if (own > 1 && own > max_instances - std::min(instances, max_instances))
            checker.fail_unsupported(
                where, "the file has more than " + std::to_string(max_instances) + " instances");
        instances += own;
    });
}

/// Parent of each node; the number of nodes if it has none.
std::vector<std::uint64_t> checked_parents(const GltfChecker& checker, const Json& nodes) {
    const std::uint64_t count = nodes.size();
    std::vector<std::uint64_t> parents(count, count);
    for (std::uint64_t i = 0; i < count; ++i) {
        const std::string where = child_path("/nodes", i);
        checker.for_each(nodes[i], where, "children", [&](const Json& value, const std::string& at) {
            const std::uint64_t child = checker.checked_index(value, at, "nodes");
            if (parents[child] != count)
                checker.fail(child_path("/nodes", child),
                             "has two parents: /nodes/" + std::to_string(parents[child]) + " and " + where);
            parents[child] = i;
        });
    }
    return parents;
}

/// Checks that there are no cycles. Since each node has at most one parent, the path from a node to its
/// ancestors ends at a root or returns to a visited node. O(nodes)
void check_no_cycle(const GltfChecker& checker, const std::vector<std::uint64_t>& parents) {
    const std::uint64_t count = parents.size();
    constexpr std::uint64_t unvisited = 0;
    std::vector<std::uint64_t> visited_by(count, unvisited);
    for (std::uint64_t start = 0; start < count; ++start) {
        const std::uint64_t visit_mark = start + 1;
        for (std::uint64_t node = start; node != count && visited_by[node] == unvisited;
             node = parents[node]) {
            visited_by[node] = visit_mark;
            if (parents[node] != count && visited_by[parents[node]] == visit_mark)
                checker.fail(child_path("/nodes", parents[node]), "is its own ancestor");
        }
    }
}

void check_scenes(const GltfChecker& checker, const std::vector<std::uint64_t>& parents) {
    const Json& scenes = member(checker.document, "scenes");
    std::vector<std::uint64_t> listed_in(parents.size(), scenes.size());
    checker.reference(checker.document, "", "scene", "scenes");
    for (std::uint64_t i = 0; i < scenes.size(); ++i) {
        const std::string where = child_path("/scenes", i);
        checker.for_each(scenes[i], where, "nodes", [&](const Json& value, const std::string& at) {
            const std::uint64_t node = checker.checked_index(value, at, "nodes");
            if (parents[node] != parents.size())
                checker.fail(at, "refers to /nodes/" + std::to_string(node) + ", which has a parent");
            if (listed_in[node] == i)
                checker.fail(at, "refers to /nodes/" + std::to_string(node) + " a second time");
            listed_in[node] = i;
        });
    }
}

void check_skin(const GltfChecker& checker, const Json& skin, const std::string& where) {
    checker.reference(skin, where, "skeleton", "nodes");
    checker.reference(skin, where, "inverseBindMatrices", "accessors");
    checker.for_each(skin, where, "joints", [&](const Json& joint, const std::string& at) {
        checker.checked_index(joint, at, "nodes");
    });
}

void check_animation(const GltfChecker& checker, const Json& animation, const std::string& where) {
    const Json& samplers = member(animation, "samplers");
    checker.for_each(animation, where, "samplers", [&](const Json& sampler, const std::string& at) {
        checker.required_reference(sampler, at, "input", "accessors");
        checker.required_reference(sampler, at, "output", "accessors");
    });
    checker.for_each(animation, where, "channels", [&](const Json& channel, const std::string& at) {
        if (checker.required_number(channel, at, "sampler") >= samplers.size())
            checker.fail(child_path(at, "sampler"), "is out of range: the animation has " +
                                                        std::to_string(samplers.size()) + " samplers");
        const Json& target = checker.object(channel, at, "target");
        if (target.is_null()) checker.fail(at, "has no target");
        checker.reference(target, child_path(at, "target"), "node", "nodes");
    });
}

}  // namespace

void check_scene(const GltfChecker& checker) {
    const Json& nodes = member(checker.document, "nodes");
    checker.for_each_object("nodes", check_node);
    check_instance_counts(checker);
    const std::vector<std::uint64_t> parents = checked_parents(checker, nodes);
    check_no_cycle(checker, parents);
    check_scenes(checker, parents);
    checker.for_each_object("skins", check_skin);
    checker.for_each_object("animations", check_animation);
}

}  // namespace faqem::detail

#include <vector>

#include "asset/gltf/check/checker.hpp"

namespace faqem::detail {
namespace {

void check_node(const GltfChecker& checker, const Json& node, const std::string& where) {
    checker.reference(node, where, "mesh", "meshes");
    checker.reference(node, where, "skin", "skins");
    checker.reference(node, where, "camera", "cameras");
    checker.numbers(node, where, "matrix", 16);
    checker.numbers(node, where, "translation", 3);
    checker.numbers(node, where, "rotation", 4);
    checker.numbers(node, where, "scale", 3);
    checker.array(node, where, "weights");
    checker.object(node, where, "extensions");
    const std::string at = where + "/extensions/EXT_mesh_gpu_instancing";
    const Json& instancing = member(member(node, "extensions"), "EXT_mesh_gpu_instancing");
    for (const auto& [name, accessor] : checker.object(instancing, at, "attributes").items())
        checker.reference_value(accessor, at + "/attributes/" + name, "accessors");
}

/// Parent of every node; `count` where it has none.
std::vector<std::uint64_t> checked_parents(const GltfChecker& checker, const Json& nodes) {
    const std::uint64_t count = nodes.size();
    std::vector<std::uint64_t> parents(count, count);
    for (std::uint64_t i = 0; i < count; ++i) {
        const std::string where = step("/nodes", i);
        const Json& children = checker.array(nodes[i], where, "children");
        for (std::uint64_t k = 0; k < children.size(); ++k) {
            const std::uint64_t child =
                checker.reference_value(children[k], step(step(where, "children"), k), "nodes");
            if (parents[child] != count)
                checker.fail(step("/nodes", child),
                             "has two parents: /nodes/" + std::to_string(parents[child]) + " and " + where);
            parents[child] = i;
        }
    }
    return parents;
}

/// With one parent at most, walking up from a node ends at a root or comes back.
void check_no_cycle(const GltfChecker& checker, const std::vector<std::uint64_t>& parents) {
    const std::uint64_t count = parents.size();
    constexpr std::uint64_t unseen = 0;
    std::vector<std::uint64_t> seen(count, unseen);
    for (std::uint64_t start = 0; start < count; ++start) {
        const std::uint64_t mark = start + 1;
        for (std::uint64_t node = start; node != count && seen[node] == unseen; node = parents[node]) {
            seen[node] = mark;
            if (parents[node] != count && seen[parents[node]] == mark)
                checker.fail(step("/nodes", parents[node]), "is its own ancestor");
        }
    }
}

void check_scenes(const GltfChecker& checker, const std::vector<std::uint64_t>& parents) {
    const Json& scenes = member(checker.document, "scenes");
    std::vector<std::uint64_t> listed_in(parents.size(), scenes.size());
    checker.reference(checker.document, "", "scene", "scenes");
    for (std::uint64_t i = 0; i < scenes.size(); ++i) {
        const std::string where = step("/scenes", i);
        const Json& nodes = checker.array(scenes[i], where, "nodes");
        for (std::uint64_t k = 0; k < nodes.size(); ++k) {
            const std::string at = step(step(where, "nodes"), k);
            const std::uint64_t node = checker.reference_value(nodes[k], at, "nodes");
            if (parents[node] != parents.size())
                checker.fail(at, "refers to /nodes/" + std::to_string(node) + ", which has a parent");
            if (listed_in[node] == i)
                checker.fail(at, "refers to /nodes/" + std::to_string(node) + " a second time");
            listed_in[node] = i;
        }
    }
}

void check_skins(const GltfChecker& checker) {
    const Json& skins = member(checker.document, "skins");
    for (std::uint64_t i = 0; i < skins.size(); ++i) {
        const std::string where = step("/skins", i);
        checker.reference(skins[i], where, "skeleton", "nodes");
        checker.reference(skins[i], where, "inverseBindMatrices", "accessors");
        const Json& joints = checker.array(skins[i], where, "joints");
        for (std::uint64_t k = 0; k < joints.size(); ++k)
            checker.reference_value(joints[k], step(step(where, "joints"), k), "nodes");
    }
}

void check_animation(const GltfChecker& checker, const Json& animation, const std::string& where) {
    const Json& samplers = checker.array(animation, where, "samplers");
    for (std::uint64_t i = 0; i < samplers.size(); ++i) {
        const std::string at = step(step(where, "samplers"), i);
        checker.needed_reference(samplers[i], at, "input", "accessors");
        checker.needed_reference(samplers[i], at, "output", "accessors");
    }
    const Json& channels = checker.array(animation, where, "channels");
    for (std::uint64_t i = 0; i < channels.size(); ++i) {
        const std::string at = step(step(where, "channels"), i);
        if (checker.needed_number(channels[i], at, "sampler") >= samplers.size())
            checker.fail(step(at, "sampler"), "refers to none of the " + std::to_string(samplers.size()) +
                                                  " samplers of the animation");
        const Json& target = checker.object(channels[i], at, "target");
        if (target.is_null()) checker.fail(at, "has no target");
        checker.reference(target, step(at, "target"), "node", "nodes");
    }
}

}  // namespace

void check_scene(const GltfChecker& checker) {
    const Json& nodes = member(checker.document, "nodes");
    for (std::uint64_t i = 0; i < nodes.size(); ++i) check_node(checker, nodes[i], step("/nodes", i));
    const std::vector<std::uint64_t> parents = checked_parents(checker, nodes);
    check_no_cycle(checker, parents);
    check_scenes(checker, parents);
    check_skins(checker);
    const Json& animations = member(checker.document, "animations");
    for (std::uint64_t i = 0; i < animations.size(); ++i)
        check_animation(checker, animations[i], step("/animations", i));
}

}  // namespace faqem::detail

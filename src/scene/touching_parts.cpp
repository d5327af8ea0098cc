#include "scene/touching_parts.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "asset/finest_level.hpp"
#include "asset/scene/flatten.hpp"
#include "asset/scene/messages.hpp"
#include "asset/scene/part_arrays.hpp"
#include "asset/scene/source_traits.hpp"
#include "faqem/detail/measure/removed_components.hpp"
#include "faqem/detail/simplify/run.hpp"
#include "faqem/engine/mesh/boundary_edges.hpp"
#include "faqem/engine/mesh/union_find.hpp"
#include "faqem/engine/mesh/weld.hpp"
#include "scene/check_asset.hpp"

namespace faqem::detail {
namespace {

// Where components of parts have fewer faces than this in the result, on average, borders between them take too many.
constexpr double least_faces = 32;

// A boundary edge, its lexicographically smaller end first.
struct PlacedEdge {
    std::array<Vec3, 2> ends;
    bool is_reversed;  // whether its face passes it from the second end to the first one
    Index part;

    bool operator<(const PlacedEdge& other) const {
        return std::tie(ends, is_reversed, part) < std::tie(other.ends, other.is_reversed, other.part);
    }
};

// Whether the arrays of two parts can be appended to each other.
bool have_equal_arrays(const Part& a, const Part& b) {
    if (a.uvs.size() != b.uvs.size() || a.custom_attributes.size() != b.custom_attributes.size())
        return false;
    bool result = true;
    for (const FaceArray& array : face_arrays)
        result &= (a.*array.values).empty() == (b.*array.values).empty();
    visit_vertex_arrays(
        [&](const VertexArray& one, const auto& values, const auto& others) {
            if (!one.attribute) result &= values.empty() == others.empty();
        },
        a, b);
    for (std::size_t i = 0; i < a.custom_attributes.size(); ++i) {
        const CustomAttribute &one = a.custom_attributes[i], &other = b.custom_attributes[i];
        result &= one.name == other.name && one.components == other.components &&
                  one.component_type == other.component_type && one.normalized == other.normalized;
    }
    return result;
}

// By part: a number that is equal for parts which can be joined; no_index for the others.
std::vector<Index> joinable_parts(const Asset& source) {
    const std::vector<std::vector<InstanceMotion>> motions = instance_motions(source);
    std::map<std::vector<InstanceMotion>, std::vector<Index>>
        firsts;  // by motion: the first part of each kind
    std::vector<Index> result(source.parts.size(), no_index);
    for (Index p = 0; p < source.parts.size(); ++p) {
        const Part& part = source.parts[p];
        if (part.triangles.empty() || motions[p].empty() || !part.face_object.empty() ||
            !part.face_group.empty() || !part.morph_targets.empty() ||
            !variant_materials(source, part).empty())
            continue;
        std::vector<Index>& kinds = firsts[motions[p]];
        const auto kind = std::ranges::find_if(
            kinds, [&](Index first) { return have_equal_arrays(source.parts[first], part); });
        result[p] = kind == kinds.end() ? kinds.emplace_back(p) : *kind;
    }
    return result;
}

void add_boundary_edges(const Part& part, Index number, std::vector<PlacedEdge>& edges) {
    const std::vector<Index> representative = engine::weld_exact(part.positions);
    std::vector<Triangle> triangles;
    for (const Triangle& t : part.triangles) {
        const Triangle w = {representative[t[0]], representative[t[1]], representative[t[2]]};
        if (w[0] != w[1] && w[1] != w[2] && w[2] != w[0]) triangles.push_back(w);
    }
    engine::for_each_edge(triangles, part.positions.size(), [&](Index a, Index b, Index up, Index down) {
        if (up + down != 1) return;
        const auto [low, high] = std::minmax(part.positions[a], part.positions[b]);
        edges.push_back({{low, high}, (low == part.positions[a]) == (down == 1), number});
    });
}

// By part: the first part of those that it is connected to by equal boundary edges.
std::vector<Index> connected_parts(const Asset& source) {
    std::map<Index, std::vector<Index>> of_kind;
    const std::vector<Index> kinds = joinable_parts(source);
    for (Index p = 0; p < kinds.size(); ++p)
        if (kinds[p] != no_index) of_kind[kinds[p]].push_back(p);
    engine::UnionFind joined(source.parts.size());
    for (const auto& [kind, parts] : of_kind) {
        std::vector<PlacedEdge> edges;
        for (const Index p : parts)
            if (parts.size() > 1) add_boundary_edges(source.parts[p], p, edges);
        std::sort(edges.begin(), edges.end());
        for (std::size_t i = 1; i < edges.size(); ++i) {
            // Faces that pass an edge in the same direction lie on each other.
            if (edges[i].ends == edges[i - 1].ends && edges[i].is_reversed != edges[i - 1].is_reversed)
                joined.unite(edges[i].part, edges[i - 1].part);
        }
    }
    std::vector<Index> first;
    for (Index p = 0; p < kinds.size(); ++p) first.push_back(joined.find(p));
    return first;
}

// Appends a part as a new object of another one.
void append(const Part& part, Index number, Part& to) {
    const auto first = static_cast<Index>(to.positions.size());
    const auto object = static_cast<Index>(to.object_parts.size());
    const auto add = [](auto& all, const auto& more) { all.insert(all.end(), more.begin(), more.end()); };
    visit_vertex_arrays([&](const VertexArray&, auto& all, const auto& more) { add(all, more); }, to, part);
    for (const Triangle& t : part.triangles)
        to.triangles.push_back({first + t[0], first + t[1], first + t[2]});
    add(to.face_material, part.face_material);
    to.face_object.resize(to.triangles.size(), object);
    to.object_names.push_back(part.name);
    to.object_parts.push_back(number);
}

// A part without vertices and faces, in whose place another one is.
Part emptied(const Part& part) {
    Part result;
    result.name = part.name;
    result.source = part.source;
    return result;
}

}  // namespace

std::optional<Asset> join_touching_parts(const Asset& source, std::span<const Level> levels,
                                         Options options) {
    for (const Level& level : levels)
        if (const auto* target = std::get_if<Target>(&level)) options.target = *target;
    return join_touching_parts(source, options);
}

std::optional<Asset> join_touching_parts(const Asset& source, const Options& options) {
    check_asset(source);
    if (source.parts.size() < 2 || options.history == Recording::on || options.budget == Budget::mesh ||
        options.bake.correspondence == Recording::on || finest_level(source))
        return std::nullopt;
    const std::vector<Index> first = connected_parts(source);
    const auto all = static_cast<double>(face_count(source));
    const double share = static_cast<double>(target_face_count(options.target, all)) / all;
    std::vector<Index> members(first.size(), 0);  // by first part
    for (const Index p : first) ++members[p];
    std::vector<double> spare_faces(first.size(), 0);  // by first part: beyond those that joining needs
    for (Index p = 0; p < first.size(); ++p) {
        const Part& part = source.parts[p];
        if (members[first[p]] < 2) continue;
        spare_faces[first[p]] += share * static_cast<double>(part.triangles.size()) -
                                 least_faces * face_components(part.positions, part.triangles).count;
    }
    std::optional<Asset> joined;
    for (Index p = 0; p < first.size(); ++p) {
        if (first[p] == p || !(spare_faces[first[p]] >= 0)) continue;
        if (!joined) joined = source;
        Part& to = joined->parts[first[p]];
        if (to.object_parts.empty()) {
            to.face_object.assign(to.triangles.size(), 0);
            to.object_names = {to.name};
            to.object_parts = {first[p]};
        }
        append(source.parts[p], p, to);
        joined->parts[p] = emptied(source.parts[p]);
    }
    return joined;
}

void divide_joined_parts(const Asset& joined, SimplifiedAsset& result) {
    std::vector<Part>& parts = result.asset.parts;
    for (std::size_t p = 0; p < parts.size(); ++p) {
        const std::vector<Index>& objects = joined.parts[p].object_parts;
        if (objects.empty()) continue;
        const Part whole = std::exchange(parts[p], {});
        std::vector<std::vector<Index>> faces(objects.size());
        for (Index f = 0; f < whole.face_object.size(); ++f) faces[whole.face_object[f]].push_back(f);
        std::vector<Index> number(whole.positions.size(), no_index);
        for (std::size_t object = 0; object < objects.size(); ++object) {
            Part& to = parts[objects[object]];
            to = with_faces(whole, faces[object], number);
            to.name = joined.parts[p].object_names[object];
            to.source = joined.parts[objects[object]].source;
            for (std::vector<std::string>* list : {&result.report.kept_uvs, &result.report.untouched_parts})
                if (object > 0 && std::ranges::count(*list, part_title(joined, p)) > 0)
                    list->push_back(part_title(joined, objects[object]));
            if (faces[object].empty())
                result.report.warnings.push_back(part_title(result.asset, objects[object]) + " has no faces");
        }
    }
}

}  // namespace faqem::detail

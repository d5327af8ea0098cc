#include "asset/scene/part_arrays.hpp"

#include <map>
#include <set>

#include "support/catch.hpp"

using namespace faqem;
using namespace faqem::detail;

namespace {

constexpr std::size_t full_part_vertices = 4;

// Two triangles with all arrays. Each value tells its vertex or face, and each array of vertices has its own values.
Part full_part() {
    Part part;
    part.triangles = {{0, 1, 2}, {2, 1, 3}};
    part.face_material = {5, 6};
    part.face_object = {1, 0};
    part.object_names = {"back", "front"};
    part.face_group = {no_index, 0};
    part.group_names = {"only"};
    part.uvs.resize(2);
    part.morph_targets.resize(2);
    part.custom_attributes = {{"_A", {}, 1, 5123, true}, {"_B", {}, 4}};
    for (std::size_t v = 0; v < full_part_vertices; ++v) {
        const auto x = static_cast<float>(v);
        part.positions.push_back({x, 0, 0});
        part.normals.push_back({x, 1, 0});
        part.tangents.push_back({x, 2, 0, 0});
        part.colors.push_back({x, 3, 0, 0});
        part.weights.push_back({x, 4, 0, 0});
        part.joints.push_back({static_cast<std::uint16_t>(v), 5, 0, 0});
        for (std::size_t i = 0; i < 2; ++i) {
            const auto y = static_cast<float>(10 * i);
            part.uvs[i].push_back({x, y + 6});
            part.morph_targets[i].positions.push_back({x, y + 7, 0});
            part.morph_targets[i].normals.push_back({x, y + 8, 0});
            part.custom_attributes[i].values.push_back({x, y + 9, 0, 0});
        }
    }
    return part;
}

std::set<const void*> filled_vertex_arrays(const Part& part) {
    // A new member of Part does not compile here: full_part(), the sets below and part_arrays.hpp need it, too.
    const auto& [name, positions, triangles, face_material, normals, tangents, uvs, colors, joints, weights,
                 morph_targets, face_object, object_names, object_parts, face_group, group_names, source,
                 custom_attributes, position_spacing, file_order] = part;
    std::set<const void*> result = {&positions, &normals, &tangents, &colors, &joints, &weights};
    for (const auto& set : uvs) result.insert(&set);
    for (const auto& [displacements, turns] : morph_targets) result.insert({&displacements, &turns});
    for (const CustomAttribute& attribute : custom_attributes) result.insert(&attribute.values);
    return result;
}

}  // namespace

TEST_CASE("each array of vertices is visited once") {
    const Part part = full_part();
    std::map<const void*, int> visits;
    std::vector<std::string> titles;
    std::set<std::string> needed;
    visit_vertex_arrays(
        [&](const VertexArray& array, const auto& values) {
            CHECK(values.size() == full_part_vertices);
            ++visits[&values];
            titles.push_back(array.title());
            if (!array.may_be_empty()) needed.insert(array.title());
        },
        part);
    CHECK(visits.size() == 14);
    for (const void* array : filled_vertex_arrays(part)) CHECK(visits[array] == 1);
    CHECK(visits.size() == 14);
    CHECK(titles == std::vector<std::string>{"uvs 0", "uvs 1", "positions", "normals", "tangents", "colors",
                                             "weights", "joints", "positions of a morph target",
                                             "normals of a morph target", "positions of a morph target",
                                             "normals of a morph target", "_A", "_B"});
    CHECK(needed == std::set<std::string>{"uvs 0", "uvs 1", "_A", "_B"});
}

TEST_CASE("the same arrays of two parts are visited together") {
    Part a = full_part();
    const Part b = full_part();
    int visits = 0;
    visit_vertex_arrays(
        [&](const VertexArray&, auto& to, const auto& from) {
            CHECK(to == from);
            to.clear();
            ++visits;
        },
        a, b);
    CHECK(visits == 14);
    visit_vertex_arrays([](const VertexArray&, const auto& values) { CHECK(values.empty()); }, a);
}

TEST_CASE("each array of faces is in the table") {
    const Part part = full_part();
    std::set<const void*> arrays;
    for (const FaceArray& array : face_arrays) {
        CHECK((part.*array.values).size() == part.triangles.size());
        arrays.insert(&(part.*array.values));
    }
    CHECK(arrays == std::set<const void*>{&part.face_material, &part.face_object, &part.face_group});
    CHECK(&(part.*object_array.names) == &part.object_names);
    CHECK(&(part.*group_array.names) == &part.group_names);
}

TEST_CASE("selected faces have their values in all arrays") {
    const Part part = full_part();
    Part to;
    to.group_names = {"kept"};
    select_faces(part, {1, 0, 1}, to);
    CHECK(to.triangles == std::vector<Triangle>{{2, 1, 3}, {0, 1, 2}, {2, 1, 3}});
    CHECK(to.face_material == std::vector<Index>{6, 5, 6});
    CHECK(to.face_object == std::vector<Index>{0, 1, 0});
    CHECK(to.face_group == std::vector<Index>{0, no_index, 0});
    CHECK(to.group_names == std::vector<std::string>{"kept"});
    CHECK(to.positions.empty());

    Part same = part;
    same.face_object.clear();
    select_faces(same, {1}, same);
    CHECK(same.triangles == std::vector<Triangle>{{2, 1, 3}});
    CHECK(same.face_material == std::vector<Index>{6});
    CHECK(same.face_object.empty());
    CHECK(same.positions.size() == full_part_vertices);
}

TEST_CASE("selected vertices have their values in all arrays") {
    Part part = full_part();
    part.tangents.clear();
    Part to;
    to.colors = {{9, 9, 9, 9}};
    select_vertices(part, std::vector<std::uint64_t>{3, 1}, to);
    CHECK(to.positions == std::vector<Vec3>{{3, 0, 0}, {1, 0, 0}});
    CHECK(to.normals == std::vector<Vec3f>{{3, 1, 0}, {1, 1, 0}});
    CHECK(to.tangents.empty());
    CHECK(to.colors == std::vector<Vec4f>{{3, 3, 0, 0}, {1, 3, 0, 0}});
    CHECK(to.weights == std::vector<Vec4f>{{3, 4, 0, 0}, {1, 4, 0, 0}});
    CHECK(to.joints == std::vector<std::array<std::uint16_t, 4>>{{3, 5, 0, 0}, {1, 5, 0, 0}});
    REQUIRE(to.uvs.size() == 2);
    CHECK(to.uvs[1] == std::vector<Vec2f>{{3, 16}, {1, 16}});
    REQUIRE(to.morph_targets.size() == 2);
    CHECK(to.morph_targets[0].positions == std::vector<Vec3f>{{3, 7, 0}, {1, 7, 0}});
    CHECK(to.morph_targets[1].normals == std::vector<Vec3f>{{3, 18, 0}, {1, 18, 0}});
    REQUIRE(to.custom_attributes.size() == 2);
    CHECK(to.custom_attributes[0].name == "_A");
    CHECK(to.custom_attributes[0].components == 1);
    CHECK(to.custom_attributes[0].component_type == 5123);
    CHECK(to.custom_attributes[0].normalized);
    CHECK(to.custom_attributes[1].values == std::vector<std::array<double, 4>>{{3, 19, 0, 0}, {1, 19, 0, 0}});
    CHECK(to.triangles.empty());
}

TEST_CASE("faces have only the names that they use") {
    Part part;
    part.face_group = {7};
    part.group_names = {"old"};
    set_face_names(part, group_array, {2, no_index, 0, 2}, {"a", "unused", "c"});
    CHECK(part.face_group == std::vector<Index>{0, no_index, 1, 0});
    CHECK(part.group_names == std::vector<std::string>{"c", "a"});
    set_objects(part, {1, 0}, {"a", "b"});
    CHECK(part.face_object == std::vector<Index>{0, 1});
    CHECK(part.object_names == std::vector<std::string>{"b", "a"});
    set_objects(part, {1, 1}, {"a", "b"});  // a single object is the part itself
    CHECK(part.face_object.empty());
    CHECK(part.object_names.empty());
}

TEST_CASE("corners are numbered by the vertices that the faces use") {
    const Part part = full_part();
    std::vector<Index> scratch(full_part_vertices, no_index), used, corners;
    number_corners(part, {1}, scratch, used, corners);
    CHECK(used == std::vector<Index>{1, 2, 3});
    CHECK(corners == std::vector<Index>{1, 0, 2});
    CHECK(scratch == std::vector<Index>(full_part_vertices, no_index));
}

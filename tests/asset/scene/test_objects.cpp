#include "asset/scene/flatten.hpp"

#include "faqem/save_levels.hpp"
#include "support/catch.hpp"
#include "support/format_support.hpp"

using namespace faqem;
using namespace faqem::detail;
using namespace faqem::testing;

namespace {

// Two quads that share the edge between vertices 1 and 2; the right one is an object of its own.
Asset two_quads() {
    Asset asset = one_part({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0, 0}, {2, 1, 0}},
                           {{0, 1, 2}, {1, 4, 5}, {0, 2, 3}, {1, 5, 2}});
    Part& part = asset.parts[0];
    part.name = "all";
    part.face_object = {0, 1, 0, 1};
    part.object_names = {"left", "right"};
    part.uvs = {{{0, 0}, {1, 0}, {2, 0}, {3, 0}, {4, 0}, {5, 0}}};
    part.file_order = FileOrder::for_gpu;
    return asset;
}

std::vector<std::string> names(const Asset& asset) {
    std::vector<std::string> result;
    for (const Part& part : asset.parts) result.push_back(part.name);
    return result;
}

}  // namespace

TEST_CASE("parts are divided into their objects") {
    CHECK(!divided_into_objects(one_part({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}, {{0, 1, 2}})));
    const auto divided = divided_into_objects(two_quads());
    REQUIRE(divided);
    const Asset& asset = divided->asset;
    CHECK(names(asset) == std::vector<std::string>{"left", "right"});
    CHECK(divided->part == std::vector<std::size_t>{0, 0});
    CHECK(asset.parts[0].triangles == std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}});
    CHECK(asset.parts[1].triangles == std::vector<Triangle>{{0, 2, 3}, {0, 3, 1}});
    CHECK(asset.parts[1].positions == std::vector<Vec3>{{1, 0, 0}, {1, 1, 0}, {2, 0, 0}, {2, 1, 0}});
    CHECK(asset.parts[1].uvs.at(0) == std::vector<Vec2f>{{1, 0}, {2, 0}, {4, 0}, {5, 0}});
    CHECK(asset.parts[1].face_material == std::vector<Index>{no_index, no_index});
    CHECK(asset.parts[1].file_order == FileOrder::for_gpu);
    CHECK(asset.parts[1].face_object.empty());
}

TEST_CASE("objects have the groups of their faces only") {
    Asset source = two_quads();
    source.parts[0].face_group = {2, 1, no_index, 2};
    source.parts[0].group_names = {"unused", "b", "c"};
    const auto divided = divided_into_objects(source);
    REQUIRE(divided);
    CHECK(divided->asset.parts[0].group_names == std::vector<std::string>{"c"});
    CHECK(divided->asset.parts[0].face_group == std::vector<Index>{0, no_index});
    CHECK(divided->asset.parts[1].group_names == std::vector<std::string>{"b", "c"});
    CHECK(divided->asset.parts[1].face_group == std::vector<Index>{0, 1});
}

TEST_CASE("faces without an object stay in the part, and objects without faces stay empty") {
    Asset source = two_quads();
    source.parts[0].face_object = {no_index, 1, no_index, 1};
    source.parts.push_back(source.parts[0]);
    source.parts[1].face_object.clear();
    const auto divided = divided_into_objects(source);
    REQUIRE(divided);
    CHECK(names(divided->asset) == std::vector<std::string>{"left", "right", "all", "all"});
    CHECK(divided->part == std::vector<std::size_t>{0, 0, 0, 1});
    CHECK(divided->asset.parts[0].triangles.empty());
    CHECK(divided->asset.parts[2].triangles.size() == 2);
    CHECK(divided->asset.parts[3].positions.size() == 6);
}

TEST_CASE("objects are saved as meshes of glTF and objects of OBJ") {
    const TemporaryFolder folder;
    const Asset source = two_quads();
    CHECK(save(source, folder / "a.glb").empty());
    CHECK(names(load(folder / "a.glb")) == std::vector<std::string>{"left", "right"});
    CHECK(contains(get(folder / "a.glb"), R"("nodes":[{"mesh":0,"name":"left"},{"mesh":1,"name":"right"}])"));
    save(source, folder / "a.obj");
    const Part part = load(folder / "a.obj").parts.at(0);
    CHECK(part.object_names == source.parts[0].object_names);
    CHECK(part.face_object == std::vector<Index>{0, 0, 1, 1});
    CHECK(part.positions.size() == 6);
    save(source, folder / "a.ply");
    CHECK(load(folder / "a.ply").parts.at(0).triangles.size() == 4);
}

TEST_CASE("levels of detail of objects are levels of their meshes") {
    const TemporaryFolder folder;
    SavedLevel fine, coarse;
    fine.asset = coarse.asset = two_quads();
    Part& part = coarse.asset.parts[0];
    part.triangles = {{0, 1, 2}};
    part.face_material = {no_index};
    part.face_object = {0};  // of the right object nothing is left
    fine.coverage = coarse.coverage = {0.5};
    save_levels({fine, coarse}, folder / "a.glb");
    const std::string text = get(folder / "a.glb");
    CHECK(contains(text, R"("name":"left_LOD1")"));
    CHECK(contains(text, R"({"name":"right_LOD1"})"));  // a node without a mesh
}

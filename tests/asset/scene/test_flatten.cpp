#include "asset/scene/flatten.hpp"

#include <cmath>

#include "faqem/save_levels.hpp"
#include "support/catch.hpp"
#include "support/format_support.hpp"

using namespace faqem;
using namespace faqem::detail;
using namespace faqem::testing;

namespace {

Matrix4 scaled(double x, double y, double z) { return {x, 0, 0, 0, 0, y, 0, 0, 0, 0, z, 0, 0, 0, 0, 1}; }

/// A triangle in the plane x + y + z = 1, facing away from the origin, with its normal.
Asset slope() {
    Asset asset = one_part({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 1, 2}});
    const float n = 1 / std::sqrt(3.0f);
    asset.parts[0].normals.assign(3, {n, n, n});
    return asset;
}

Vec3 face_normal(const Part& part) {
    const Triangle& t = part.triangles[0];
    const Vec3 &a = part.positions[t[0]], &b = part.positions[t[1]], &c = part.positions[t[2]];
    Vec3 n;
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
        n[k] = (b[i] - a[i]) * (c[j] - a[j]) - (b[j] - a[j]) * (c[i] - a[i]);
    }
    const double length = std::hypot(n[0], n[1], n[2]);
    return {n[0] / length, n[1] / length, n[2] / length};
}

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

TEST_CASE("an instance with the identity transform is copied bit for bit", "[flatten]") {
    Asset asset = slope();
    asset.parts[0].name = "slope";
    asset.parts[0].positions[0] = {0.1, -0.0, 1e-300};
    asset.parts[0].normals[0] = {0, 0, 5};
    const Part flat = flatten(asset, {{0, identity_transform}});
    CHECK(flat.positions == asset.parts[0].positions);
    CHECK(std::signbit(flat.positions[0][1]));
    CHECK(flat.normals == asset.parts[0].normals);
    CHECK(flat.name == "slope");
}

TEST_CASE("transformed normals match the face normals, also under mirroring", "[flatten]") {
    const Matrix4 shear = {1, 0, 0, 0, 0.5, 2, 0, 0, -0.25, 0.5, 3, 0, 7, 8, 9, 1};
    for (const Matrix4& m : {identity_transform, scaled(2, 1, 0.25), scaled(-1, 1, 1), scaled(-2, -1, 1),
                             scaled(-1, -1, -1), shear}) {
        const Part flat = flatten(slope(), {{0, m}});
        const Vec3 expected = face_normal(flat);
        for (std::size_t k = 0; k < 3; ++k) CHECK(flat.normals[0][k] == Approx(expected[k]).margin(1e-6));
    }
}

TEST_CASE("positions are transformed by the column-major matrix", "[flatten]") {
    // u = x + 2 y + 10, v = 3 y + 20, w = z + 30
    const Matrix4 m = {1, 0, 0, 0, 2, 3, 0, 0, 0, 0, 1, 0, 10, 20, 30, 1};
    const Part flat = flatten(slope(), {{0, m}});
    CHECK(flat.positions == std::vector<Vec3>{{11, 20, 30}, {12, 23, 30}, {10, 20, 31}});
}

TEST_CASE("the winding of mirrored instances is reversed", "[flatten]") {
    CHECK(flatten(slope(), {{0, scaled(1, 1, 1)}}).triangles[0] == Triangle{0, 1, 2});
    CHECK(flatten(slope(), {{0, scaled(-1, 1, 1)}}).triangles[0] == Triangle{0, 2, 1});
    CHECK(flatten(slope(), {{0, scaled(-1, -1, 1)}}).triangles[0] == Triangle{0, 1, 2});
}

TEST_CASE("a singular transform gives finite normals", "[flatten]") {
    const Part planar = flatten(slope(), {{0, scaled(1, 1, 0)}});
    CHECK(planar.normals[0] == Vec3f{0, 0, 1});
    const Part point = flatten(slope(), {{0, scaled(0, 0, 0)}});
    CHECK(point.normals[0] == Vec3f{0, 0, 0});
    CHECK(point.triangles.size() == 1);
}

TEST_CASE("attributes that some parts lack get neutral values", "[flatten]") {
    Asset asset = slope();
    asset.parts.push_back(one_part({{5, 0, 0}, {6, 0, 0}, {5, 1, 0}}, {{2, 1, 0}}).parts[0]);
    asset.parts[1].colors.assign(3, {0.5f, 0, 0, 1});
    asset.parts[1].uvs = {std::vector<Vec2f>(3, {0.25f, 0.75f})};
    asset.parts[1].face_material = {3};
    const Part flat =
        flatten(asset, {{0, identity_transform}, {1, identity_transform}, {0, scaled(-1, 1, 1)}});
    CHECK(flat.positions.size() == 9);
    CHECK(flat.triangles == std::vector<Triangle>{{0, 1, 2}, {5, 4, 3}, {6, 8, 7}});
    CHECK(flat.face_material == std::vector<Index>{no_index, 3, no_index});
    CHECK(flat.normals[3] == Vec3f{0, 0, 0});
    CHECK(flat.colors[0] == Vec4f{1, 1, 1, 1});
    CHECK(flat.colors[4] == Vec4f{0.5f, 0, 0, 1});
    CHECK(flat.uvs.at(0)[0] == Vec2f{0, 0});
    CHECK(flat.uvs[0][5] == Vec2f{0.25f, 0.75f});
    CHECK(flat.name.empty());
}

TEST_CASE("is_float_representable is true only if all coordinates are floats", "[flatten]") {
    CHECK(is_float_representable({{0.5, -3, 1e30f}, {0.1f, 0, 0}}));
    CHECK(!is_float_representable({{0.5, -3, 0.1}}));
    CHECK(!is_float_representable({{0.5, -3, 1e300}}));
}

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

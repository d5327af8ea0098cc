#include "render/rasterizer.hpp"
#include "support/catch.hpp"
#include "support/gltf_builder.hpp"

using namespace faqem;
using namespace faqem::render;
using namespace faqem::testing;

TEST_CASE("pictures show meshes with their default morph weights") {
    GltfBuilder builder = square_gltf();
    const std::vector<Vec3f> lift(4, {0, 0, 4});
    builder.json["meshes"][0]["primitives"][0]["targets"] = {
        {{"POSITION", builder.accessor(lift, f32, "VEC3")}}};
    builder.json["meshes"][0]["weights"] = {0.5};
    builder.json["nodes"][0]["translation"] = {0, 0, 1};
    const Scene scene = make_scene(load_glb(builder));
    const Eigen::AlignedBox3d box = bounding_box(placed_meshes(scene));
    CHECK(box.min() == Vector3(0, 0, 3));
    CHECK(box.max() == Vector3(1, 1, 3));
    CHECK(scene.faces == 2);
}

TEST_CASE("pictures show skinned meshes in their pose") {
    GltfBuilder builder = square_gltf();
    Json& attributes = builder.json["meshes"][0]["primitives"][0]["attributes"];
    attributes["JOINTS_0"] = builder.accessor(std::vector<std::array<std::uint8_t, 4>>(4), u8, "VEC4");
    attributes["WEIGHTS_0"] =
        builder.accessor(std::vector<std::array<float, 4>>(4, {1, 0, 0, 0}), f32, "VEC4");
    const auto joint = builder.add("nodes", {{"scale", {-1, 1, 1}}, {"translation", {0, 0, 7}}});
    builder.add("skins", {{"joints", {joint}}});
    builder.json["nodes"][0]["skin"] = 0;
    builder.json["nodes"][0]["translation"] = {50, 0, 0};
    const Scene scene = make_scene(load_glb(builder));
    const Eigen::AlignedBox3d box = bounding_box(placed_meshes(scene));
    CHECK(box.min() == Vector3(-1, 0, 7));
    CHECK(box.max() == Vector3(0, 1, 7));
    REQUIRE(scene.parts.size() == 1);
    CHECK_FALSE(scene.parts[0].mirrored);
    CHECK(scene.asset.parts[scene.parts[0].part].triangles[0] == Triangle{0, 2, 1});
}

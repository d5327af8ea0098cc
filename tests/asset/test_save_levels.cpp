#include "faqem/save_levels.hpp"

#include "support/catch.hpp"
#include "support/gltf_builder.hpp"

using namespace faqem;
using namespace faqem::testing;

namespace {

std::string saved_levels(std::vector<SavedLevel> levels, const std::string& name = "out.glb") {
    const TemporaryFolder folder;
    save_levels(std::move(levels), folder / name);
    return get(folder / name);
}

/// The asset as the first level, and two levels with one face per part.
std::vector<SavedLevel> three_levels(const Asset& asset, double coverage = 0.5) {
    std::vector<SavedLevel> levels = {{asset, std::vector<double>(asset.parts.size(), 9)}};
    for (int i = 1; i < 3; ++i) {
        levels.push_back({levels.back().asset, std::vector<double>(asset.parts.size(), coverage / i)});
        for (Part& part : levels.back().asset.parts) {
            part.triangles.resize(1);
            part.face_material.resize(1);
        }
    }
    return levels;
}

}  // namespace

TEST_CASE("levels of a plain node are separate nodes and the scene has the first level only") {
    const std::string glb = saved_levels(three_levels(load_glb(square_gltf())));
    const Json json = json_of(glb);
    REQUIRE(json["nodes"].size() == 3);
    CHECK(json["scenes"][0]["nodes"] == Json::array({0}));
    CHECK(json["nodes"][0]["mesh"] == 0);
    CHECK(json["nodes"][0]["extensions"]["MSFT_lod"]["ids"] == Json({1, 2}));
    CHECK(json["nodes"][0]["extras"]["MSFT_screencoverage"] == Json({0.5, 0.25, 0.0}));
    CHECK(json["nodes"][1] == Json({{"mesh", 1}}));
    CHECK(json["nodes"][2] == Json({{"mesh", 2}}));
    CHECK(json["extensionsUsed"] == Json::array({"MSFT_lod"}));
    const Asset back = load_glb(glb);
    REQUIRE(back.parts.size() == 3);
    CHECK(back.parts[0].triangles.size() == 2);
    CHECK(back.parts[1].triangles.size() == 1);
    CHECK(instances(back).size() == 1);
}

TEST_CASE("the mesh of a node with a transform or an animation is moved to a child node") {
    GltfBuilder builder = square_gltf();
    builder.json["nodes"] =
        Json::parse(R"([{"name":"a","mesh":0,"translation":[1,2,3]},{"name":"b","mesh":0}])");
    builder.json["scenes"] = Json::parse(R"([{"nodes":[0,1]}])");
    const auto times = builder.accessor(std::vector<float>{0, 1}, f32, "SCALAR");
    const auto moves = builder.accessor(std::vector<Vec3f>{{1, 2, 3}, {4, 5, 6}}, f32, "VEC3");
    builder.json["animations"] = {
        {{"channels", {{{"sampler", 0}, {"target", {{"node", 1}, {"path", "translation"}}}}}},
         {"samplers", {{{"input", times}, {"output", moves}}}}}};
    const Json json = json_of(saved_levels(three_levels(load_glb(builder))));
    const Json& nodes = json["nodes"];
    REQUIRE(nodes.size() == 8);
    CHECK(nodes[0]["translation"] == Json({1, 2, 3}));
    for (const std::size_t n : {0u, 1u}) {
        CHECK_FALSE(nodes[n].contains("mesh"));
        REQUIRE(nodes[n]["children"].size() == 1);
        const Json& child = nodes[nodes[n]["children"][0].get<std::size_t>()];
        CHECK(child["mesh"] == 0);
        CHECK_FALSE(child.contains("translation"));
        const Json& ids = child["extensions"]["MSFT_lod"]["ids"];
        REQUIRE(ids.size() == 2);
        for (const std::size_t i : {0u, 1u}) CHECK(nodes[ids[i].get<std::size_t>()]["mesh"] == i + 1);
    }
    CHECK(nodes[2]["name"] == "a_mesh");
    CHECK(nodes[3]["name"] == "a_mesh_LOD1");
    CHECK(json["animations"][0]["channels"][0]["target"]["node"] == 1);
    CHECK(json["scenes"][0]["nodes"] == Json({0, 1}));
}

TEST_CASE("animations of morph weights move every level that has the morph targets") {
    GltfBuilder builder = square_gltf();
    const auto moved = builder.accessor(std::vector<Vec3f>(4, Vec3f{0, 0, 1}), f32, "VEC3");
    builder.json["meshes"][0]["primitives"][0]["targets"] = {{{"POSITION", moved}}};
    const auto times = builder.accessor(std::vector<float>{0, 1}, f32, "SCALAR");
    const auto weights = builder.accessor(std::vector<float>{0, 1}, f32, "SCALAR");
    builder.json["animations"] = {
        {{"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "weights"}}}}}},
         {"samplers", {{{"input", times}, {"output", weights}}}}}};
    std::vector<SavedLevel> levels = three_levels(load_glb(builder));
    levels[2].asset.parts[0].morph_targets.clear();
    const Json json = json_of(saved_levels(std::move(levels)));
    std::vector<std::size_t> meshes;
    for (const Json& channel : json["animations"][0]["channels"]) {
        CHECK(channel["sampler"] == 0);
        CHECK(channel["target"]["path"] == "weights");
        meshes.push_back(json["nodes"][channel["target"]["node"].get<std::size_t>()]["mesh"]);
    }
    CHECK(meshes == std::vector<std::size_t>{0, 1});
}

TEST_CASE("levels of a new asset share equal images and have separate materials") {
    Asset asset = one_part({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {{0, 1, 2}, {2, 1, 3}});
    asset.parts[0].uvs = {{{0, 0}, {1, 0}, {0, 1}, {1, 1}}};
    asset.parts[0].face_material = {0, 0};
    asset.images = {small_png(1)};
    asset.materials.resize(1);
    asset.materials[0].base_color_texture.image = 0;
    std::vector<SavedLevel> levels = three_levels(asset, 4);
    levels[2].asset.images = {small_png(2)};
    const std::string glb = saved_levels(levels);
    const Json json = json_of(glb);
    CHECK(json["images"].size() == 2);
    CHECK(json["materials"].size() == 3);
    CHECK(json["nodes"][0]["extras"]["MSFT_screencoverage"] == Json({1.0, 1.0, 0.0}));
    CHECK(saved_levels(levels) == glb);
    const Asset back = load_glb(glb);
    CHECK(instances(back).size() == 1);
}

TEST_CASE("the extension textures of each level refer to the images of that level") {
    Asset asset = one_part({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {{0, 1, 2}, {2, 1, 3}});
    asset.parts[0].uvs = {{{0, 0}, {1, 0}, {0, 1}, {1, 1}}};
    asset.parts[0].face_material = {0, 0};
    asset.images = {small_png(1), small_png(2)};
    asset.materials.resize(1);
    asset.materials[0].base_color_texture.image = 0;
    asset.materials[0].extension_textures = {{"KHR_materials_sheen", "sheenColorTexture", {.image = 1}, 1}};
    std::vector<SavedLevel> levels = three_levels(asset);
    for (std::uint8_t i = 1; i < 3; ++i) {
        const auto shade = static_cast<std::uint8_t>(10 * i);
        levels[i].asset.images = {small_png(shade), small_png(static_cast<std::uint8_t>(shade + 1))};
    }
    const Asset back = load_glb(saved_levels(levels));
    REQUIRE(back.materials.size() == 3);
    for (std::size_t i = 0; i < 3; ++i) {
        const Material& material = back.materials[back.parts[i].face_material[0]];
        REQUIRE(material.extension_textures.size() == 1);
        const Index image = material.extension_textures[0].texture.image;
        CHECK(back.images.at(image).encoded == levels[i].asset.images[1].encoded);
    }
}

TEST_CASE("extras that are not an object are kept without MSFT_screencoverage") {
    GltfBuilder builder = square_gltf();
    builder.json["nodes"][0]["extras"] = 7;
    const Json json = json_of(saved_levels(three_levels(load_glb(builder))));
    CHECK(json["nodes"][0]["extras"] == 7);
    CHECK(json["nodes"][0]["extensions"]["MSFT_lod"]["ids"].size() == 2);
}

TEST_CASE("inconsistent levels and formats without levels are rejected") {
    const Asset asset = load_glb(square_gltf());
    CHECK_THROWS_AS(saved_levels({}), InputError);
    CHECK_THROWS_AS(saved_levels({{asset, {}}}), InputError);
    CHECK_THROWS_AS(saved_levels({{asset, {1}}, {Asset(), {}}}), InputError);
    CHECK_THROWS_AS(saved_levels(three_levels(asset), "out.ply"), UnsupportedError);
    CHECK(json_of(saved_levels({{asset, {1}}}))["nodes"].size() == 1);
}

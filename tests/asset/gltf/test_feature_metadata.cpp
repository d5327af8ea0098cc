#include <array>
#include <cstring>
#include <string>

#include "faqem/save_levels.hpp"
#include "support/catch.hpp"
#include "support/gltf_builder.hpp"

using namespace faqem;
using namespace faqem::testing;

namespace {

// The square with UVs, a texture, feature ids of all kinds, and properties of three features in a table and a texture.
GltfBuilder square_with_features() {
    GltfBuilder builder = square_gltf();
    add_texture(builder, 1);  // not used
    add_texture(builder, 2);
    Json& primitive = builder.primitive();
    builder.attribute<Vec2f>("TEXCOORD_0", {{0, 0}, {1, 0}, {0, 1}, {1, 1}}, f32, "VEC2");
    builder.attribute<float>("_FEATURE_ID_0", {0, 1, 2, 2}, f32, "SCALAR");
    const Json texture = {{"index", 1}, {"texCoord", 0}, {"channels", {0}}};
    primitive["extensions"]["EXT_mesh_features"]["featureIds"] = {
        {{"featureCount", 3}, {"attribute", 0}, {"propertyTable", 0}},
        {{"featureCount", 3}, {"texture", texture}},
        {{"featureCount", 4}}};
    primitive["extensions"]["EXT_structural_metadata"]["propertyTextures"] = {0};
    const auto heights = builder.view(std::vector<float>{1.5f, 2.5f, 3.5f});
    builder.json["extensions"]["EXT_structural_metadata"] = {
        {"schema", {{"id", "city"}}},
        {"propertyTables",
         {{{"name", "houses"},
           {"class", "house"},
           {"count", 3},
           {"properties", {{"height", {{"values", heights}}}}}}}},
        {"propertyTextures", {{{"class", "house"}, {"properties", {{"age", texture}}}}}}};
    return builder;
}

}  // namespace

TEST_CASE("feature ids and their properties are kept for unchanged meshes, with remapped references") {
    const WrittenGltf written = write_gltf_of(load_glb(square_with_features()));
    CHECK(written.warnings == std::vector<std::string>{"1 image that no mesh uses: left out"});
    const Json& ids = written.primitive()["extensions"]["EXT_mesh_features"]["featureIds"];
    REQUIRE(ids.size() == 3);
    CHECK(ids[0]["propertyTable"] == 0);
    CHECK(ids[1]["texture"]["index"] == 0);
    CHECK(written.primitive()["extensions"]["EXT_structural_metadata"]["propertyTextures"] == Json({0}));
    const Json& metadata = written.json["extensions"]["EXT_structural_metadata"];
    CHECK(metadata["schema"]["id"] == "city");
    CHECK(metadata["propertyTextures"][0]["properties"]["age"]["index"] == 0);
    CHECK(written.json["textures"].size() == 1);
    const Json& view =
        written.json["bufferViews"]
                    [metadata["propertyTables"][0]["properties"]["height"]["values"].get<Index>()];
    CHECK(view["byteOffset"].get<std::size_t>() % 8 == 0);
    REQUIRE(view["byteLength"] == 12);
    const std::size_t binary = written.glb.find("BIN") + 4;
    std::array<float, 3> heights;
    std::memcpy(heights.data(), written.glb.data() + binary + view["byteOffset"].get<std::size_t>(), 12);
    CHECK(heights == std::array<float, 3>{1.5f, 2.5f, 3.5f});
}

TEST_CASE("properties that refer to nothing are left out with a warning") {
    GltfBuilder builder = square_with_features();
    Json& metadata = builder.json["extensions"]["EXT_structural_metadata"];
    SECTION("a view") { metadata["propertyTables"][0]["properties"]["height"]["values"] = 99; }
    SECTION("a texture") { metadata["propertyTextures"][0]["properties"]["age"]["index"] = 2; }
    SECTION("no list") { metadata["propertyTables"] = {{"a", 1}}; }
    SECTION("no property") { metadata["propertyTables"][0]["properties"]["height"] = 3; }
    const WrittenGltf written = write_gltf_of(load_glb(builder));
    CHECK_FALSE(written.json.contains("extensions"));
    CHECK(written.warns("EXT_structural_metadata refers to buffer views or textures that do not exist"));
}

TEST_CASE("all levels in one file have the feature ids") {
    const Asset asset = load_glb(square_with_features());
    const TemporaryFolder folder;
    save_levels({{asset, {1}}, {asset, {0.5}}}, folder / "out.glb");
    const Json json = json_of(get(folder / "out.glb"));
    REQUIRE(json["meshes"].size() == 2);
    for (const Json& mesh : json["meshes"])
        CHECK(mesh["primitives"][0]["extensions"]["EXT_mesh_features"]["featureIds"].size() == 3);
}

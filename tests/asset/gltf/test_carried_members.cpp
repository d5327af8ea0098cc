// Extensions of primitives that describe vertices and triangles by their numbers, and feature ids.

#include <array>
#include <cstring>
#include <string>

#include "asset/gltf/accessor.hpp"
#include "faqem/save_levels.hpp"
#include "support/catch.hpp"
#include "support/gltf_builder.hpp"

using namespace faqem;
using namespace faqem::testing;

namespace {

// The square of two triangles after a vertex that no triangle uses, so that its vertices get other numbers.
GltfBuilder numbered_square() {
    GltfBuilder builder;
    std::vector<Vec3f> positions = {{9, 9, 9}};
    positions.insert(positions.end(), square.begin(), square.end());
    std::vector<std::uint16_t> corners = square_corners;
    for (std::uint16_t& corner : corners) ++corner;
    builder.triangles(positions, corners);
    return builder;
}

// The numbers in an accessor of a GLB file.
std::vector<Index> numbers(const std::string& glb, const Json& accessor) {
    const Asset asset = load_glb(glb);
    return detail::read_indices(*asset.source, accessor.get<Index>());
}

GltfBuilder outlined_square() {
    GltfBuilder builder = numbered_square();
    const auto outline = builder.accessor(std::vector<std::uint8_t>{1, 2, 2, 4}, u8, "SCALAR");
    builder.primitive()["extensions"] = {{"CESIUM_primitive_outline", {{"indices", outline}}},
                                         {"FB_ngon_encoding", Json::object()}};
    return builder;
}

// A square whose triangles share no vertices, and the manifold that joins them.
GltfBuilder manifold_square() {
    GltfBuilder builder;
    const std::vector<Vec3f> positions = {square[0], square[1], square[2], square[2], square[1], square[3]};
    const auto vertices = builder.accessor(positions, f32, "VEC3");
    builder.mesh({{"attributes", {{"POSITION", vertices}}}});
    const auto joined = builder.accessor(std::vector<std::uint16_t>{0, 1, 2, 2, 1, 5}, u16, "SCALAR");
    const auto moved = builder.accessor(std::vector<std::uint16_t>{3, 4}, u16, "SCALAR");
    const auto values = builder.accessor(std::vector<std::uint16_t>{2, 1}, u16, "SCALAR");
    builder.json["meshes"][0]["extensions"]["EXT_mesh_manifold"] = {
        {"manifoldPrimitive", {{"indices", joined}, {"attributes", {{"POSITION", vertices}}}}},
        {"mergeIndices", moved},
        {"mergeValues", values}};
    return builder;
}

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

TEST_CASE("the outline of unchanged triangles gets the new numbers of the vertices") {
    const WrittenGltf written = write_gltf_of(load_glb(outlined_square()));
    const Json& extensions = written.primitive()["extensions"];
    CHECK(numbers(written.glb, extensions["CESIUM_primitive_outline"]["indices"]) ==
          std::vector<Index>{0, 1, 1, 3});
    CHECK(extensions.contains("FB_ngon_encoding"));
    CHECK(written.json["extensionsUsed"] == Json({"CESIUM_primitive_outline", "FB_ngon_encoding"}));
    CHECK(written.warnings.empty());
}

TEST_CASE("the outline of other triangles is left out with a warning") {
    Asset asset = load_glb(outlined_square());
    SECTION("in another order") { std::swap(asset.parts[0].triangles[0], asset.parts[0].triangles[1]); }
    SECTION("fewer") {
        asset.parts[0].triangles.pop_back();
        asset.parts[0].face_material.pop_back();
    }
    SECTION("moved") { asset.parts[0].positions[4][2] = 1; }
    SECTION("in the order of a simplified mesh") { asset.parts[0].file_order = FileOrder::for_gpu; }
    const WrittenGltf written = write_gltf_of(asset);
    CHECK_FALSE(written.json["meshes"][0]["primitives"][0].contains("extensions"));
    CHECK_FALSE(written.json.contains("extensionsUsed"));
    CHECK(written.warns("CESIUM_primitive_outline does not fit"));
    CHECK(written.warns("FB_ngon_encoding does not fit"));
}

TEST_CASE("an outline with a vertex that no triangle uses is left out") {
    GltfBuilder builder = outlined_square();
    builder.bin[builder.bin.size() - 1] = 0;
    const WrittenGltf written = write_gltf_of(load_glb(builder));
    CHECK(written.warns("CESIUM_primitive_outline does not fit"));
    CHECK(written.json["extensionsUsed"] == Json({"FB_ngon_encoding"}));
}

TEST_CASE("the manifold of an unchanged mesh is kept, with the accessors of the output") {
    const WrittenGltf written = write_gltf_of(load_glb(manifold_square()));
    CHECK(written.warnings.empty());
    const Json& mesh = written.json["meshes"][0];
    const Json& manifold = mesh["extensions"]["EXT_mesh_manifold"];
    CHECK(manifold["manifoldPrimitive"]["attributes"] == mesh["primitives"][0]["attributes"]);
    CHECK(numbers(written.glb, manifold["manifoldPrimitive"]["indices"]) ==
          std::vector<Index>{0, 1, 2, 2, 1, 5});
    CHECK(numbers(written.glb, manifold["mergeIndices"]) == std::vector<Index>{3, 4});
    CHECK(numbers(written.glb, manifold["mergeValues"]) == std::vector<Index>{2, 1});
}

TEST_CASE("a manifold that does not fit is left out with a warning") {
    GltfBuilder builder = manifold_square();
    Json& manifold = builder.json["meshes"][0]["extensions"]["EXT_mesh_manifold"];
    SECTION("an accessor does not exist") { manifold["mergeValues"] = 99; }
    SECTION("an accessor has no integers") { manifold["mergeIndices"] = 0; }
    SECTION("lists of different sizes") {
        manifold["mergeValues"] = manifold["manifoldPrimitive"]["indices"];
    }
    SECTION("an attribute that the mesh does not have") {
        manifold["manifoldPrimitive"]["attributes"]["NORMAL"] = 0;
    }
    const WrittenGltf written = write_gltf_of(load_glb(builder));
    CHECK_FALSE(written.json["meshes"][0].contains("extensions"));
    CHECK(written.warns("EXT_mesh_manifold does not fit"));
}

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

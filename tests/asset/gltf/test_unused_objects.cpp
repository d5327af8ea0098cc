#include "asset/gltf/source_document.hpp"

#include <algorithm>

#include "support/catch.hpp"
#include "support/gltf_builder.hpp"

using namespace faqem;
using namespace faqem::testing;
using detail::unused_objects;

namespace {

/// The square with material 0, which has texture 0 with image 0.
GltfBuilder textured_square() {
    GltfBuilder builder = square_gltf();
    add_texture(builder, 10);
    builder.add("materials", {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
    builder.primitive()["material"] = 0;
    return builder;
}

}  // namespace

TEST_CASE("a document whose materials and images are all in use has no unused objects") {
    CHECK(unused_objects(square_gltf().json).empty());
    GltfBuilder builder = textured_square();
    CHECK(unused_objects(builder.json).empty());
    for (std::uint8_t shade = 20; shade < 80; shade += 10) add_texture(builder, shade);
    for (int m = 1; m < 4; ++m) builder.add("materials", {{"normalTexture", {{"index", m}}}});
    Json& primitive = builder.primitive();
    primitive["extensions"]["KHR_materials_variants"]["mappings"] = {{{"material", 1}, {"variants", {0}}}};
    builder.json["materials"][0]["extensions"]["MSFT_lod"]["ids"] = {2};
    builder.json["materials"][2]["extensions"]["MSFT_lod"]["ids"] = {3, 0};
    primitive["extensions"]["EXT_mesh_features"]["featureIds"] = {{{"texture", {{"index", 4}}}}};
    builder.json["extensions"]["EXT_structural_metadata"]["propertyTextures"] = {
        {{"properties", {{"p", {{"index", 5}}}}}}};
    builder.json["extensions"]["EXT_lights_image_based"]["lights"] = {{{"specularImages", {{6}}}}};
    CHECK(unused_objects(builder.json).empty());
    primitive.erase("extensions");
    CHECK(unused_objects(builder.json) == "1 material and 2 images that no mesh uses");
}

TEST_CASE("materials and images that no mesh uses are counted, and saving warns of them") {
    GltfBuilder builder = textured_square();
    add_texture(builder, 20);
    CHECK(unused_objects(builder.json) == "1 image that no mesh uses");
    builder.add("materials", {{"emissiveTexture", {{"index", 1}}}});
    builder.add("materials", {{"emissiveTexture", {{"index", 0}}}});
    CHECK(unused_objects(builder.json) == "2 materials and 1 image that no mesh uses");
    CHECK(write_gltf_of(load_glb(write_gltf_of(load_glb(builder)).glb)).warnings.empty());
}

TEST_CASE("what VRM and VRMC extensions name by number keeps its number, also if no mesh uses it") {
    const std::string name = GENERATE("VRM", "VRMC_vrm");
    GltfBuilder builder = square_gltf();
    for (std::uint8_t shade = 10; shade < 50; shade += 10) add_texture(builder, shade);
    std::reverse(builder.json["textures"].begin(), builder.json["textures"].end());
    for (int m : {3, 1, 2})
        builder.add("materials", {{"name", std::to_string(m)},
                                  {"pbrMetallicRoughness", {{"baseColorTexture", {{"index", m}}}}}});
    builder.primitive()["material"] = 1;
    builder.json["extensions"][name] = {{"meta", {{"texture", 0}}}, {"materials", {2, 1}}};
    builder.json["extensionsUsed"] = {name};
    CHECK(unused_objects(builder.json).empty());
    Asset asset = load_glb(builder);
    CHECK(asset.not_understood.empty());
    const auto check = [&](const WrittenGltf& written) {
        CHECK(written.warnings.empty());
        REQUIRE(written.json["textures"].size() >= 4);
        for (std::size_t t = 0; t < 4; ++t) CHECK(written.json["textures"][t] == builder.json["textures"][t]);
        CHECK(written.json["extensions"] == builder.json["extensions"]);
        REQUIRE(written.json["materials"].size() >= 3);
        for (std::size_t m = 0; m < 3; ++m)
            CHECK(written.json["materials"][m] == builder.json["materials"][m]);
        REQUIRE(written.json["images"].size() >= 4);
        return load_glb(written.glb);
    };
    CHECK(check(write_gltf_of(asset)).parts[0].face_material[0] == 1);

    // Texture 1 has image 2, which is encoded again; an unused material has it, too, but by the image of the source.
    const Index image = asset.materials[1].base_color_texture.image;
    asset.images[image] = encode_jpeg(decode(asset.images[image]), "", 100, Content::color);
    const WrittenGltf again = write_gltf_of(asset);
    for (std::size_t i = 0; i < 4; ++i)
        CHECK(again.json["images"][i]["mimeType"] == (i == 2 ? "image/jpeg" : "image/png"));
    check(again);
}

TEST_CASE("a warning tells that an extension which names meshes by number may be wrong where one is gone") {
    GltfBuilder builder = square_gltf();
    builder.json["extensions"]["VRM"]["mesh"] = 1;
    builder.json["extensionsUsed"] = {"VRM"};
    builder.mesh(builder.primitive());
    Asset asset = load_glb(builder);
    CHECK(write_gltf_of(asset).warnings.empty());
    asset.parts[0].triangles.clear();
    asset.parts[0].face_material.clear();
    CHECK(write_gltf_of(asset).warns("the extension VRM is unknown"));
}

#include "asset/gltf/unused_objects.hpp"

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
    builder.json["meshes"][0]["primitives"][0]["material"] = 0;
    return builder;
}

}  // namespace

TEST_CASE("a document whose materials and images are all in use has no unused objects") {
    CHECK(unused_objects(square_gltf().json).empty());
    GltfBuilder builder = textured_square();
    CHECK(unused_objects(builder.json).empty());
    for (std::uint8_t shade = 20; shade < 80; shade += 10) add_texture(builder, shade);
    for (int m = 1; m < 4; ++m) builder.add("materials", {{"normalTexture", {{"index", m}}}});
    Json& primitive = builder.json["meshes"][0]["primitives"][0];
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
    const Asset asset = load_glb(builder);
    CHECK(asset.warnings.empty());
    const WrittenGltf written = write_gltf_of(asset);
    CHECK(written.warnings ==
          std::vector<std::string>{"2 materials and 1 image that no mesh uses: left out"});
    CHECK(written.json["materials"].size() == 1);
    CHECK(write_gltf_of(load_glb(written.glb)).warnings.empty());
}

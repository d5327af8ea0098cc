// The materials of a source on another mesh.

#include "faqem/bake_onto.hpp"
#include "support/catch.hpp"
#include "support/gltf_builder.hpp"
#include "support/scenes.hpp"

using namespace faqem;
using namespace faqem::testing;

namespace {

/// A square with UVs, whose coat has a texture of the shade 99.
GltfBuilder coated_square() {
    GltfBuilder builder = square_gltf();
    builder.attribute("TEXCOORD_0", std::vector<Vec2f>{{0, 0}, {1, 0}, {0, 1}, {1, 1}}, f32, "VEC2");
    add_texture(builder, 99);
    builder.material(R"({"name":"coat","extras":{"a":1},"extensions":{
        "KHR_materials_clearcoat":{"clearcoatFactor":0.9,"clearcoatTexture":{"index":0}},
        "KHR_materials_ior":{"ior":1.3}}})");
    return builder;
}

}  // namespace

TEST_CASE("material extensions of the source are on another mesh, with baked textures and their factors") {
    const Asset source = load_glb(coated_square());
    GltfBuilder other = square_gltf();
    other.json["nodes"][0]["name"] = "own node";
    other.material(R"({"name":"own","extensions":{"KHR_materials_ior":{"ior":2}}})");
    const bool has_document = GENERATE(false, true);
    const SimplifiedAsset baked = bake_onto(source, has_document ? load_glb(other) : new_square());
    const WrittenGltf written = write_gltf_of(baked.asset);
    REQUIRE(written.json["materials"].size() == 1);
    const Json& material = written.json["materials"][0];
    CHECK(material["name"] == "coat");
    CHECK(material["extras"]["a"] == 1);
    CHECK(material["extensions"]["KHR_materials_ior"]["ior"] == 1.3);
    const Json& coat = material["extensions"]["KHR_materials_clearcoat"];
    CHECK(coat["clearcoatFactor"] == 0.9);
    CHECK(coat["clearcoatTexture"]["index"] == 0);
    REQUIRE(written.json["images"].size() == 1);
    CHECK(decode(load_glb(written.glb).images[0]).rgba[0] == 99);
    REQUIRE(written.json["nodes"].size() == 1);
    CHECK(written.json["nodes"][0]["name"] == (has_document ? "own node" : "square"));
    CHECK(written.warnings.empty());
    CHECK(baked.report.warnings.empty());
}

TEST_CASE("a format without extensions of materials loses them with a warning") {
    Options options;
    options.format = ModelFormat::obj;
    const SimplifiedAsset baked = bake_onto(load_glb(coated_square()), new_square(), options);
    CHECK(any_contains(baked.report.warnings, "material 'coat': KHR_materials_clearcoat was left out"));
    CHECK_FALSE(baked.asset.source);
}

TEST_CASE("a face without a material is metal if its file is glTF") {
    const SimplifiedAsset from_gltf = bake_onto(load_glb(square_gltf()), new_square());
    CHECK(from_gltf.asset.materials.at(0).metallic == 1);
    CHECK(bake_onto(new_square(), new_square()).asset.materials.at(0).metallic == 0);
}

TEST_CASE("a target of several materials has those of the source, with its masks and its two sides") {
    Asset source = test::textured_square(test::paint(64, 64, [](std::uint32_t x, std::uint32_t) {
        return x < 32 ? test::Rgba{40, 200, 40, 255} : test::Rgba{0, 0, 0, 0};
    }));
    source.materials[0].alpha_mode = AlphaMode::mask;
    source.materials[0].alpha_cutoff = 0.3f;
    source.materials[0].double_sided = true;
    Asset target = test::textured_square(test::ramp(4));
    target.materials.push_back(target.materials[0]);
    target.materials[1].alpha_mode = AlphaMode::blend;
    target.parts[0].face_material = {0, 1};
    const SimplifiedAsset baked = bake_onto(source, target, test::lossless());
    REQUIRE(baked.asset.materials.size() == 1);
    CHECK(baked.asset.parts[0].face_material == std::vector<Index>{0, 0});
    CHECK(baked.asset.materials[0].alpha_mode == AlphaMode::mask);
    CHECK(baked.asset.materials[0].alpha_cutoff == 0.3f);
    CHECK(baked.asset.materials[0].double_sided);
    const Pixels pixels = test::base_color_image(baked.asset);
    CHECK(test::read(pixels, 0.25, 0.5) == std::array<double, 4>{40, 200, 40, 255});
    CHECK(test::read(pixels, 0.75, 0.5)[3] == 0);
}

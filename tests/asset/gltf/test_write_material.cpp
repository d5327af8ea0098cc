// Writing of materials as glTF.

#include "support/catch.hpp"
#include "support/gltf_builder.hpp"

using namespace faqem;
using namespace faqem::testing;

TEST_CASE("an unmodified material keeps its digits, extras, extensions and textures") {
    GltfBuilder builder = square_gltf();
    for (std::uint8_t shade = 1; shade <= 3; ++shade) add_texture(builder, shade);
    builder.material(R"({"name":"m","alphaMode":"BLEND",
        "pbrMetallicRoughness":{"baseColorFactor":[0.1,0.2,0.3,0.7],"roughnessFactor":0.123456789012,
            "baseColorTexture":{"index":2,"extras":"slot","extensions":{"KHR_texture_transform":{"scale":[2,2]}}}},
        "extras":{"a":1},
        "extensions":{"KHR_materials_clearcoat":{"clearcoatFactor":0.9,"clearcoatTexture":{"index":1}}}})");
    const Json json = through(builder);
    Json expected = builder.json["materials"][0];
    expected["pbrMetallicRoughness"]["baseColorTexture"]["index"] = 0;
    expected["extensions"]["KHR_materials_clearcoat"]["clearcoatTexture"]["index"] = 1;
    CHECK(json["materials"][0] == expected);
    REQUIRE(json["images"].size() == 2);
    CHECK(json["extensionsUsed"] == Json({"KHR_materials_clearcoat", "KHR_texture_transform"}));
}

TEST_CASE("a texture of which only the image changed keeps its transform, to which an animation may point") {
    GltfBuilder builder = square_gltf();
    add_texture(builder, 1);
    builder.material(R"({"name":"m","pbrMetallicRoughness":{"baseColorTexture":
        {"index":0,"extras":"slot","extensions":{"KHR_texture_transform":{"offset":[0,0]}}}}})");
    Asset asset = load_glb(builder);
    asset.images = {small_png(99)};
    const WrittenGltf written = write_gltf_of(asset);
    CHECK(written.json["materials"] == builder.json["materials"]);
    CHECK(written.json["extensionsUsed"] == Json({"KHR_texture_transform"}));
    CHECK(load_glb(written.glb).images[0].encoded == small_png(99).encoded);
}

TEST_CASE("textures of unknown members are kept unless the material is rebaked") {
    GltfBuilder builder = square_gltf();
    for (std::uint8_t shade = 1; shade <= 3; ++shade) add_texture(builder, shade);
    builder.material(R"({"name":"m","teapotTexture":{"index":2,"lid":true},
        "pbrMetallicRoughness":{"baseColorTexture":{"index":1},"spoutTexture":{"index":2}}})");
    Json expected = builder.json["materials"][0];
    expected["pbrMetallicRoughness"]["baseColorTexture"]["index"] = 0;
    expected["pbrMetallicRoughness"]["spoutTexture"]["index"] = expected["teapotTexture"]["index"] = 1;
    CHECK(through(builder)["materials"][0] == expected);

    Asset asset = load_glb(builder);
    asset.materials[0].rebaked = true;
    const WrittenGltf written = write_gltf_of(asset);
    CHECK(written.warns("material 'm': the textures of teapotTexture do not fit"));
    CHECK(written.warns("material 'm': the textures of spoutTexture do not fit"));
    CHECK_FALSE(written.json["materials"][0].contains("teapotTexture"));
    CHECK_FALSE(written.json["materials"][0]["pbrMetallicRoughness"].contains("spoutTexture"));
}

TEST_CASE("a material that only lines have keeps its textures, also without pbrMetallicRoughness") {
    GltfBuilder builder = square_gltf();
    add_texture(builder, 1);
    add_texture(builder, 2);
    builder.json["materials"] = Json::parse(R"([{},{"name":"wire","emissiveTexture":{"index":1}}])");
    Json& primitives = builder.json["meshes"][0]["primitives"];
    primitives.push_back(primitives[0]);
    primitives[0]["material"] = 0;
    primitives[1]["material"] = primitives[1]["mode"] = 1;
    Asset asset = load_glb(builder);
    asset.materials.resize(1);
    const WrittenGltf written = write_gltf_of(asset);
    CHECK(written.json["materials"][1]["emissiveTexture"]["index"] == 0);
    REQUIRE(written.json["images"].size() == 1);
    CHECK(load_glb(written.glb).images[0].encoded == small_png(2).encoded);
}

TEST_CASE("a rebaked material loses textures that were not baked, with a warning") {
    GltfBuilder builder = square_gltf();
    add_texture(builder, 1);
    builder.material(R"({"name":"m","extras":5,
        "pbrMetallicRoughness":{"baseColorTexture":{"index":0,"extensions":{"KHR_texture_transform":{"scale":[2,2]}}}},
        "extensions":{"KHR_materials_clearcoat":
            {"clearcoatFactor":0.9,"clearcoatRoughnessFactor":0.5,"clearcoatTexture":{"index":0}}}})");
    Asset asset = load_glb(builder);
    asset.images = {small_png(99)};
    Material& material = asset.materials[0];
    material.rebaked = true;
    material.extension_textures.clear();
    material.base_color_texture = {};
    material.base_color_texture.image = 0;
    material.roughness = 0.3f;
    const WrittenGltf written = write_gltf_of(asset);
    CHECK(written.warns("material 'm': the textures of KHR_materials_clearcoat"));
    // Without the texture, the factor would apply the clearcoat to the whole surface.
    CHECK(written.json["materials"][0] == Json::parse(R"({"name":"m","extras":5,
        "extensions":{"KHR_materials_clearcoat":{"clearcoatRoughnessFactor":0.5}},
        "pbrMetallicRoughness":{"baseColorTexture":{"index":0},"roughnessFactor":0.3}})"));
    CHECK(written.json["images"].size() == 1);
    CHECK(load_glb(written.glb).images[0].encoded == asset.images[0].encoded);
}

TEST_CASE("equal textures of new materials are written once") {
    Asset asset = new_square();
    asset.images = {small_png(1), small_png(2)};
    asset.materials.resize(2);
    for (Material& material : asset.materials) {
        material.base_color_texture.image = 1;
        material.base_color_texture.wrap_u = Wrap::clamp;
        material.base_color_texture.uv_set = 1;
        material.base_color_texture.offset = {0.1f, 0};
    }
    asset.materials[1].unlit = true;
    asset.materials[1].alpha_mode = AlphaMode::mask;
    asset.materials[1].alpha_cutoff = 0.25f;
    asset.parts[0].face_material = {0, 1};
    const std::string glb = saved(asset);
    const Json json = json_of(glb);
    CHECK(json["images"].size() == 1);
    CHECK(json["textures"].size() == 1);
    CHECK(json["samplers"].size() == 1);
    CHECK(json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["extensions"] ==
          Json::parse(R"({"KHR_texture_transform":{"offset":[0.1,0.0]}})"));
    const Asset back = load_glb(glb);
    CHECK(back.materials[0].base_color_texture.wrap_u == Wrap::clamp);
    CHECK(back.materials[0].base_color_texture.uv_set == 1);
    CHECK(back.materials[1].unlit);
    CHECK(back.materials[1].alpha_mode == AlphaMode::mask);
    CHECK(back.materials[1].alpha_cutoff == 0.25f);
}

TEST_CASE("textures of known extensions are read, and written after they change") {
    GltfBuilder builder = square_gltf();
    for (std::uint8_t shade = 1; shade <= 3; ++shade) add_texture(builder, shade);
    builder.json["samplers"] = Json::parse(R"([{"wrapS":33071}])");
    builder.json["textures"][2]["sampler"] = 0;
    builder.material(R"({"name":"m","extensions":{
        "KHR_materials_sheen":{"sheenColorFactor":[0.5,0.5,0.5],"sheenRoughnessTexture":{"index":1},
            "sheenColorTexture":{"index":1,"texCoord":1,"extensions":{"KHR_texture_transform":{"offset":[0.5,0]}}}},
        "KHR_materials_clearcoat":{"clearcoatNormalTexture":{"index":2,"scale":0.5}},
        "VENDOR_teapot":{"lidTexture":{"index":0}}}})");
    Asset asset = load_glb(builder);
    std::vector<ExtensionTexture>& textures = asset.materials[0].extension_textures;
    REQUIRE(textures.size() == 3);
    CHECK(textures[0].extension == "KHR_materials_clearcoat");
    CHECK(textures[0].name == "clearcoatNormalTexture");
    CHECK(textures[0].normal_scale == 0.5f);
    CHECK(textures[0].texture.wrap_u == Wrap::clamp);
    CHECK(textures[1].name == "sheenColorTexture");
    CHECK(textures[1].texture.uv_set == 1);
    CHECK(textures[1].texture.offset == Vec2f{0.5f, 0});
    CHECK(textures[2].name == "sheenRoughnessTexture");
    CHECK(textures[2].texture.image == textures[1].texture.image);
    CHECK(asset.images.size() == 2);

    asset.materials[0].rebaked = true;
    asset.images.push_back(small_png(99));
    for (ExtensionTexture& texture : textures) {
        texture.texture = {};
        texture.texture.image = 2;
        texture.normal_scale = 1;
    }
    const WrittenGltf written = write_gltf_of(asset);
    CHECK(written.warnings.size() == 1);
    CHECK(written.warns("the textures of VENDOR_teapot do not fit"));
    CHECK(written.json["materials"][0]["extensions"] == Json::parse(R"({
        "KHR_materials_sheen":{"sheenColorFactor":[0.5,0.5,0.5],"sheenRoughnessTexture":{"index":0},
            "sheenColorTexture":{"index":0}},
        "KHR_materials_clearcoat":{"clearcoatNormalTexture":{"index":0}},
        "VENDOR_teapot":{}})"));
    CHECK(written.json["images"].size() == 1);
    const Asset back = load_glb(written.glb);
    CHECK(back.materials[0].extension_textures.size() == 3);
    CHECK(back.images[0].encoded == asset.images[2].encoded);
}

TEST_CASE("textures of extensions are preserved if their image cannot be decoded") {
    GltfBuilder builder = square_gltf();
    const std::string ktx = "\xABKTX 20\xBB\r\n\x1A\n";
    builder.add("images", {{"bufferView", builder.view(std::vector<char>(ktx.begin(), ktx.end()))},
                           {"mimeType", "image/ktx2"}});
    builder.add("textures", {{"source", 0}});
    builder.material(R"({"extensions":{"KHR_materials_sheen":{"sheenColorTexture":{"index":0}}}})");
    const Asset asset = load_glb(builder);
    CHECK(asset.materials[0].extension_textures.empty());
    CHECK(json_of(saved(asset))["materials"] == builder.json["materials"]);
}

TEST_CASE("textures of extensions of a new asset are written") {
    Asset asset = new_square();
    asset.images = {small_png(1)};
    asset.materials.resize(1);
    TextureRef use;
    use.image = 0;
    asset.materials[0].extension_textures = {{"KHR_materials_sheen", "sheenColorTexture", use}};
    asset.parts[0].face_material = {0, 0};
    const Json json = json_of(saved(asset));
    CHECK(json["materials"][0]["extensions"] ==
          Json::parse(R"({"KHR_materials_sheen":{"sheenColorTexture":{"index":0}}})"));
    CHECK(json["extensionsUsed"] == Json({"KHR_materials_sheen"}));
}

TEST_CASE("a texture keeps its sampler, name and extras if its image is encoded again, not for a new page") {
    GltfBuilder builder = square_gltf();
    add_texture(builder, 1);
    add_texture(builder, 2);
    builder.json["samplers"] = Json::parse(R"([{},{"magFilter":9728,"minFilter":9728,"wrapS":33071}])");
    builder.json["textures"][0]["sampler"] = 1;
    builder.json["textures"][0]["name"] = "pixels";
    builder.json["textures"][0]["extras"] = 7;
    builder.json["textures"][0]["extensions"]["EXT_texture_webp"]["source"] = 1;
    builder.json["textures"][0]["extensions"]["EXT_other"]["a"] = "b";
    builder.json["extensionsUsed"] = {"EXT_texture_webp", "EXT_other"};
    builder.json["materials"] = Json::parse(R"([{"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}},
        {"pbrMetallicRoughness":{"baseColorTexture":{"index":1}}}])");
    Json& primitives = builder.json["meshes"][0]["primitives"];
    primitives.push_back(primitives[0]);
    for (int i : {0, 1}) primitives[i]["material"] = i;
    Asset asset = load_glb(builder);
    for (Image& image : asset.images) image = encode_jpeg(decode(image), image.name, 90, Content::color);
    const Json kept = json_of(saved(asset));
    CHECK(kept["textures"][0] == Json::parse(R"({"source":0,"sampler":0,"name":"pixels","extras":7,
        "extensions":{"EXT_other":{"a":"b"}}})"));
    CHECK(kept["textures"][1] == Json::parse(R"({"source":1})"));
    CHECK(kept["samplers"] == Json::array({builder.json["samplers"][1]}));
    CHECK(kept["images"][0]["mimeType"] == "image/jpeg");
    CHECK(kept["images"].size() == 2);

    for (Material& material : asset.materials) material.rebaked = true;
    const Json baked = json_of(saved(asset));
    CHECK(baked["samplers"][0]["minFilter"] == 9984);
    CHECK_FALSE(baked["textures"][0].contains("name"));
}

TEST_CASE("faces without a material are no metal, except those of a glTF file, which get none") {
    Asset asset = new_square();
    asset.parts[0].face_material = {no_index, no_index};
    const Json json = json_of(saved(asset));
    CHECK(json["materials"] == Json::parse(R"([{"pbrMetallicRoughness":{"metallicFactor":0}}])"));
    CHECK(json["meshes"][0]["primitives"][0]["material"] == 0);

    const Json again = through(square_gltf());
    CHECK_FALSE(again.contains("materials"));
    CHECK_FALSE(again["meshes"][0]["primitives"][0].contains("material"));
}

// What a document tells of its motion, of objects that no mesh uses, and of its buffer views.

#include <algorithm>
#include <map>

#include "asset/gltf/source_document.hpp"
#include "asset/scene/source_traits.hpp"
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

TEST_CASE("motion is as exact as the integers of the file, and exact for floats") {
    GltfBuilder builder = square_gltf();
    const auto add = [&](const auto& values, int type, const char* kind, bool normalized) {
        const auto accessor = builder.accessor(values, type, kind);
        builder.json["accessors"][accessor]["normalized"] = normalized;
        return accessor;
    };
    const std::vector<std::array<std::uint8_t, 4>> bytes(4, {1, 1, 1, 1});
    const std::vector<std::array<std::int16_t, 4>> shorts(4, {1, 1, 1, 1});
    Json& primitive = builder.primitive();
    primitive["attributes"]["JOINTS_0"] = add(bytes, u8, "VEC4", false);
    primitive["attributes"]["WEIGHTS_0"] = add(bytes, u8, "VEC4", true);
    primitive["targets"] = {{{"POSITION", add(shorts, i16, "VEC3", true)}},
                            {{"POSITION", add(shorts, i16, "VEC3", false)}},
                            {{"POSITION", 0}}};
    for (const std::size_t accessor : {4u, 5u}) builder.json["bufferViews"][accessor]["byteStride"] = 8;
    const Asset asset = load_glb(builder);
    const detail::MotionSteps steps = detail::motion_steps(asset, asset.parts[0]);
    CHECK(steps.weight == 1.0 / 255);
    CHECK(steps.shift == std::vector<double>{1.0 / 32767, 1, 0});
    Asset bare = asset;
    bare.source = nullptr;
    CHECK(detail::motion_steps(bare, bare.parts[0]).shift == std::vector<double>{0, 0, 0});
}

TEST_CASE("variants and moved textures need the UVs of the parts that show them") {
    GltfBuilder builder = square_gltf();
    builder.json["meshes"].push_back(builder.json["meshes"][0]);
    builder.json["meshes"].push_back(builder.json["meshes"][0]);
    for (int m = 0; m < 12; ++m) builder.add("materials", Json::object());
    const auto primitive = [&](int mesh) -> Json& { return builder.json["meshes"][mesh]["primitives"][0]; };
    for (const auto& [mesh, material] : {std::pair(0, 1), std::pair(1, 11), std::pair(2, 2)})
        primitive(mesh)["material"] = material;
    primitive(2)["extensions"]["KHR_materials_variants"]["mappings"] = {{{"material", 7}, {"variants", {0}}},
                                                                        {{"material", 3}, {"variants", {1}}},
                                                                        {{"material", 7}, {"variants", {2}}}};
    const auto times = builder.accessor(std::vector<float>{0, 1}, f32, "SCALAR");
    const auto output = builder.accessor(std::vector<Vec2f>{{0, 0}, {1, 0}}, f32, "VEC2");
    const Json moved = {{"path", "pointer"},
                        {"extensions",
                         {{"KHR_animation_pointer",
                           {{"pointer",
                             "/materials/11/pbrMetallicRoughness/baseColorTexture/extensions/"
                             "KHR_texture_transform/offset"}}}}}};
    builder.add("animations", {{"samplers", {{{"input", times}, {"output", output}}}},
                               {"channels", {{{"sampler", 0}, {"target", moved}}}}});
    const Asset asset = load_glb(builder);
    CHECK(detail::variant_materials(asset, asset.parts[2]) == std::vector<Index>{3, 7});
    std::vector<std::uint8_t> moving(12, 0);
    moving[11] = 1;  // and not material 1
    CHECK(detail::materials_with_moving_textures(asset) == moving);
    CHECK(detail::parts_that_need_uvs(asset) == std::vector<std::uint8_t>{0, 1, 1});
}

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

TEST_CASE("the buffer views of a document are listed with what they store, without images") {
    GltfBuilder builder;
    const auto indices = builder.accessor(std::vector<std::uint16_t>{0, 1, 2}, u16, "SCALAR");
    const auto positions = builder.accessor(std::vector<std::array<float, 3>>(3), f32, "VEC3");
    const auto shared =
        builder.add("accessors", {{"bufferView", builder.json["accessors"][positions]["bufferView"]},
                                  {"componentType", f32},
                                  {"type", "VEC3"},
                                  {"count", 3}});
    const auto moved = builder.accessor(std::vector<std::array<float, 3>>(3), f32, "VEC3");
    const auto times = builder.accessor(std::vector<float>{0, 1}, f32, "SCALAR");
    const auto unused = builder.view(std::vector<std::uint8_t>(10));
    builder.add("images", {{"bufferView", builder.view(std::vector<std::uint8_t>(100))}});
    builder.json["animations"] =
        Json::array({{{"samplers", Json::array({{{"input", times}, {"output", times}}})}}});
    builder.json["meshes"] = Json::array(
        {{{"primitives", Json::array({{{"indices", indices},
                                       {"attributes", {{"POSITION", positions}, {"NORMAL", shared}}},
                                       {"targets", Json::array({{{"POSITION", moved}}})}}})}}});
    Json& compressed = builder.json["bufferViews"][unused]["extensions"]["EXT_meshopt_compression"];
    compressed = {{"byteLength", 7}};

    std::map<std::string, std::uint64_t> views;
    for (const ResultView& view : detail::buffer_views(builder.json)) views[view.content] += view.bytes;
    CHECK(views == std::map<std::string, std::uint64_t>{{"indices", 6},
                                                        {"NORMAL, POSITION", 36},
                                                        {"target POSITION", 36},
                                                        {"animation", 8},
                                                        {"other", 7}});
}
